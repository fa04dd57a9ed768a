//! `MessengerLoop.ssp`: Guidance and the controlled plant, each with the other's outputs at every step.

use loader::Value;
use systems::System;

use crate::attitude::{Attitude, Vector};
use crate::case::{Case, Recorded, Row, at_start};
use crate::settings::{Settings, elements};
use crate::{Options, StudyError};

/// Between samples, in s, a whole number of steps: Guidance samples once a second.
const SAMPLE_S: f64 = 1.0;

/// What is recorded, in the order of [`Sample`].
const OUTPUTS: [&str; 17] = [
    "plant.position",
    "plant.sun.positionInertial",
    "plant.earth.positionInertial",
    "plant.attitude.q",
    "plant.attitude.rate",
    "plant.estimate.q",
    "plant.estimate.valid",
    "plant.sun.sensedValid",
    "plant.control.saturated",
    "plant.dump.count",
    "guidance.command.q",
    "guidance.command.rate",
    "guidance.command.kind",
    "guidance.mode.active",
    "guidance.link.available",
    "guidance.mdis.angle",
    "guidance.constraint.sunKeepIn",
];

/// Where the plant is and what it does, and what is commanded, at one second.
#[derive(Clone, Debug)]
pub struct Sample {
    /// In s.
    pub time_s: f64,
    /// From the spacecraft to the planet's centre, EME2000, in m.
    pub to_planet_m: Vector,
    /// To the Sun.
    pub to_sun_m: Vector,
    /// To the Earth.
    pub to_earth_m: Vector,
    /// True attitude: EME2000 to body, scalar last.
    pub q: Attitude,
    /// True rate, body frame, in rad/s.
    pub rate_rad_s: Vector,
    /// Estimated attitude.
    pub estimate_q: Attitude,
    /// `estimate.valid`.
    pub is_attitude_known: bool,
    /// `sun.sensedValid`.
    pub is_sun_sensed: bool,
    /// `control.saturated`.
    pub is_torque_limited: bool,
    /// `dump.count`.
    pub dumps: f64,
    /// Commanded attitude.
    pub command_q: Attitude,
    /// Commanded rate, body frame, in rad/s.
    pub command_rate_rad_s: Vector,
    /// `command.kind`.
    pub command_kind: i32,
    /// `mode.active`.
    pub mode: i32,
    /// `link.available`.
    pub has_link: bool,
    /// `mdis.angle`, in rad.
    pub mdis_angle_rad: f64,
    /// `constraint.sunKeepIn`.
    pub is_constrained: bool,
}

impl Sample {
    fn of(mut row: Row<'_>) -> Self {
        let position_m: Vector = row.vector();
        Self {
            time_s: row.time_s,
            to_planet_m: -position_m,
            to_sun_m: row.vector() - position_m,
            to_earth_m: row.vector() - position_m,
            q: row.attitude(),
            rate_rad_s: row.vector(),
            estimate_q: row.attitude(),
            is_attitude_known: row.flag(),
            is_sun_sensed: row.flag(),
            is_torque_limited: row.flag(),
            dumps: row.real(),
            command_q: row.attitude(),
            command_rate_rad_s: row.vector(),
            command_kind: row.real() as i32,
            mode: row.real() as i32,
            has_link: row.flag(),
            mdis_angle_rad: row.real(),
            is_constrained: row.flag(),
        }
    }

    /// The Sun in the true body frame, in m.
    pub fn sun_body_m(&self) -> Vector {
        self.q.inverse_transform_vector(&self.to_sun_m)
    }
}

/// What is simulated in the loop.
pub struct Flight<'a> {
    /// For messages and tables.
    pub label: &'a str,
    /// Past J2000 TDB, in s.
    pub epoch_s: f64,
    /// Where on the orbit it starts, in deg from periapsis.
    pub true_anomaly_deg: f64,
    /// Length, in s.
    pub stop_s: f64,
    /// Values besides, by `component.variable`.
    pub settings: Settings,
    /// What is set at a second.
    pub inputs: &'a (dyn Fn(&Sample) -> Settings + Sync),
}

/// The system.
pub struct Loop(System);

impl Loop {
    /// Opens it in the folder `options` names.
    pub fn open(options: &Options) -> Result<Self, StudyError> {
        options.system("MessengerLoop.ssp").map(Self)
    }

    /// Parameters that nobody sets.
    pub fn parameters<const N: usize>(&self, names: [impl AsRef<str>; N]) -> Result<[f64; N], StudyError> {
        Ok(at_start(&self.0, &names)?.row(0, 0).vector::<N>().into())
    }

    /// The number of an item of an Enumeration.
    pub fn number(&self, name: &str, item: &str) -> Result<i32, StudyError> {
        let description = self.0.description();
        let read = || -> Result<i32, loader::Error> {
            let position = loader::select(description, name)?[0];
            match loader::parse_value(description, &description.variables[position], item)? {
                Value::Integer(number) => Ok(number),
                other => Err(loader::Error::Value { variable: name.to_owned(), what: other.to_string() }),
            }
        };
        read().map_err(|error| StudyError::Simulation { case: name.to_owned(), source: error.into() })
    }

    /// Simulates from what Guidance alone starts with; recorded once a second.
    pub fn simulate(
        &self,
        case: Case,
        names: &[&str],
        inputs: &mut dyn FnMut(Row<'_>) -> Settings,
    ) -> Result<Recorded, StudyError> {
        let identity = Attitude::identity();
        let held = Case::elements(case, "guidance.start.q", identity.coords.iter().copied());
        held.item("guidance.ephemeris.source", "inputs").every(SAMPLE_S).steer(&self.0, names, inputs)
    }

    /// Flies it in steps of `step_s`, otherwise of a second; a sample a second. It begins in the attitude and at the rate
    /// that is commanded first.
    pub fn fly(&self, flight: &Flight<'_>, step_s: Option<f64>) -> Result<Vec<Sample>, StudyError> {
        let step_s = whole_part_of_a_second(step_s)?;
        let samples = |case: Case| -> Result<Vec<Sample>, StudyError> {
            let case = ["guidance", "plant"]
                .into_iter()
                .fold(case, |case, component| case.real(&format!("{component}.start.epoch"), flight.epoch_s));
            let case = case
                .real("plant.orbit.trueAnomaly", flight.true_anomaly_deg.to_radians())
                .with(flight.settings.clone());
            let mut inputs = |row: Row<'_>| (flight.inputs)(&Sample::of(row));
            Ok(self.simulate(case, &OUTPUTS, &mut inputs)?.rows().map(Sample::of).collect())
        };
        let first = samples(Case::new(flight.label, SAMPLE_S, SAMPLE_S))?;
        let start = first.last().map_or(Settings::new(), |last| {
            start_settings(&last.command_q, &last.command_rate_rad_s, SAMPLE_S)
        });
        samples(Case::new(flight.label, flight.stop_s, step_s).with(start))
    }
}

/// The plant's attitude and rate at the start from the command that stands `time_s` later.
pub fn start_settings(q: &Attitude, rate_rad_s: &Vector, time_s: f64) -> Settings {
    let mut start = elements(
        "plant.start.q",
        (q * Attitude::from_scaled_axis(rate_rad_s * -time_s)).coords.iter().copied(),
    );
    start.extend(elements("plant.start.rate", rate_rad_s.iter().copied()));
    start
}

/// The step that is requested, otherwise a second.
pub fn whole_part_of_a_second(step_s: Option<f64>) -> Result<f64, StudyError> {
    let step_s = step_s.unwrap_or(SAMPLE_S);
    if ((SAMPLE_S / step_s).round() * step_s - SAMPLE_S).abs() > 1e-9 {
        return Err(StudyError::Step { found_s: step_s, allowed: "a second or a whole part of it" });
    }
    Ok(step_s)
}

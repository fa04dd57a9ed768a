//! `MessengerLoop.ssp`: Guidance and the controlled plant, each with the other's outputs at every step.

use systems::System;

use crate::attitude::{Attitude, Vector};
use crate::case::{Case, Recordable, Recorded, RowReader, at_start, recorded};
use crate::settings::{Settings, set};
use crate::{Options, StudyError};

/// Between samples, in s, a whole number of steps: Guidance samples once a second.
const SAMPLE_S: f64 = 1.0;

recorded! {
    /// Where the plant is and what it does, and what is commanded, at one second; directions and attitudes from EME2000.
    pub(super) struct LoopSample {
        @time_s,
        /// From the planet's centre, in m.
        position_m: Vector = "plant.position",
        /// From there to the Sun.
        sun_m: Vector = "plant.sun.positionInertial",
        /// From there to the Earth.
        earth_m: Vector = "plant.earth.positionInertial",
        /// True attitude.
        pub q: Attitude = "plant.attitude.q",
        /// True rate, body frame, in rad/s.
        pub rate_rad_s: Vector = "plant.attitude.rate",
        /// Estimated attitude.
        pub estimate_q: Attitude = "plant.estimate.q",
        /// Whether the estimate is good.
        pub is_attitude_known: bool = "plant.estimate.valid",
        /// Whether a sensor sees the Sun.
        pub is_sun_sensed: bool = "plant.sun.sensedValid",
        /// Whether more torque is requested than there is.
        pub is_torque_limited: bool = "plant.control.saturated",
        /// Dumps so far.
        pub dumps: i32 = "plant.dump.count",
        /// Commanded attitude.
        pub command_q: Attitude = "guidance.command.q",
        /// Commanded rate, body frame, in rad/s.
        pub command_rate_rad_s: Vector = "guidance.command.rate",
        /// What the command is.
        pub command_kind: i32 = "guidance.command.kind",
        /// Mode of Guidance.
        pub mode: i32 = "guidance.mode.active",
        /// Whether there is a link with the Earth.
        pub has_link: bool = "guidance.link.available",
        /// The camera's angle.
        pub mdis_angle_rad: f64 = "guidance.gimbal.angle",
        /// Whether the keep-in zone holds the attitude.
        pub is_constrained: bool = "guidance.constraint.sunKeepIn",
    }
}

impl LoopSample {
    /// From the spacecraft to the planet's centre, EME2000, in m.
    pub(super) fn to_planet_m(self) -> Vector {
        -self.position_m
    }

    /// To the Sun.
    pub(super) fn to_sun_m(self) -> Vector {
        self.sun_m - self.position_m
    }

    /// To the Earth.
    pub(super) fn to_earth_m(self) -> Vector {
        self.earth_m - self.position_m
    }

    /// The Sun in the true body frame, in m.
    pub(super) fn sun_body_m(&self) -> Vector {
        self.q.inverse_transform_vector(&self.to_sun_m())
    }
}

/// What is simulated in the loop.
pub(super) struct LoopCase<'a> {
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
    pub inputs: &'a (dyn Fn(&LoopSample) -> Settings + Sync),
}

/// The system.
pub(super) struct Loop(System);

impl Loop {
    /// Opens it in the folder `options` names.
    pub(super) fn open(options: &Options) -> Result<Self, StudyError> {
        options.system("MessengerLoop.ssp").map(Self)
    }

    /// Parameters that nobody sets.
    pub(super) fn parameters<T: Recordable>(&self, names: &[impl AsRef<str>]) -> Result<T, StudyError> {
        Ok(at_start(&self.0, names)?.first())
    }

    /// The number of an item of an Enumeration.
    pub(super) fn number(&self, name: &str, item: &str) -> Result<i32, StudyError> {
        let description = self.0.description();
        let value = loader::select(description, name)
            .and_then(|at| loader::parse_value(description, &description.variables[at[0]], item));
        let failed = |error| StudyError::Simulation { case: name.to_owned(), source: Box::new(error) };
        Ok(value.map_err(failed)?.to_f64() as i32)
    }

    /// Simulates from what Guidance alone starts with; recorded once a second.
    pub(super) fn simulate(
        &self,
        case: Case,
        names: &[&str],
        inputs: &mut dyn FnMut(RowReader<'_>) -> Settings,
    ) -> Result<Recorded, StudyError> {
        let held = case.set("guidance.start.q", Attitude::identity());
        held.set("guidance.ephemeris.source", "inputs").every(SAMPLE_S).steer(&self.0, names, inputs)
    }

    /// Simulates it in steps of `step_s`, otherwise of a second; a sample a second. It begins in the attitude and at the rate
    /// that is commanded first.
    pub(super) fn simulated(
        &self,
        flight: &LoopCase<'_>,
        step_s: Option<f64>,
    ) -> Result<Vec<LoopSample>, StudyError> {
        let step_s = whole_part_of_a_second(step_s)?;
        let samples = |case: Case| -> Result<Vec<LoopSample>, StudyError> {
            let case = case
                .set("guidance.start.epoch", flight.epoch_s)
                .set("plant.start.epoch", flight.epoch_s)
                .set("plant.orbit.trueAnomaly", flight.true_anomaly_deg.to_radians())
                .with(flight.settings.clone());
            let mut inputs = |mut row: RowReader<'_>| (flight.inputs)(&row.read());
            Ok(self.simulate(case, LoopSample::NAMES, &mut inputs)?.all(0))
        };
        let first = samples(Case::new(flight.label, SAMPLE_S, SAMPLE_S))?;
        let start = first.last().map_or(Settings::new(), |last| {
            start_settings(&last.command_q, &last.command_rate_rad_s, SAMPLE_S)
        });
        samples(Case::new(flight.label, flight.stop_s, step_s).with(start))
    }
}

/// The plant's attitude and rate at the start from the command that stands `time_s` later.
pub(super) fn start_settings(q: &Attitude, rate_rad_s: &Vector, time_s: f64) -> Settings {
    let start_q = q * Attitude::from_scaled_axis(rate_rad_s * -time_s);
    [set("plant.start.q", start_q), set("plant.start.rate", *rate_rad_s)].concat()
}

/// The step that is requested, otherwise a second.
pub(super) fn whole_part_of_a_second(step_s: Option<f64>) -> Result<f64, StudyError> {
    let step_s = step_s.unwrap_or(SAMPLE_S);
    if ((SAMPLE_S / step_s).round() * step_s - SAMPLE_S).abs() > 1e-9 {
        return Err(StudyError::Step { found_s: step_s, allowed: "a second or a whole part of it" });
    }
    Ok(step_s)
}

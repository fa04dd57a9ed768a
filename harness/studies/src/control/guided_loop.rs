//! `Guidance` and the controlled `MomentumPlant` in a loop: each gets the other's outputs at every step.

use loader::{Error, Fmu};

use super::cosimulation::{Grid, Row, Unit, Wires, fly};
use crate::settings::{Settings, number, quaternion_setting, real, vector_setting};
use crate::vector::{Vector, difference, rotated, scaled, turn};
use crate::{Options, StudyError};

/// Number of the plant among the units.
pub const PLANT: usize = 0;
/// Number of Guidance.
pub const GUIDANCE: usize = 1;

/// `attitude.source` controlled.
const CONTROLLED: i32 = 3;
/// `ephemeris.source` inputs.
const EPHEMERIS_INPUTS: i32 = 3;
/// Steps that a sample of Guidance holds a whole number of: it samples once a second.
const SAMPLE_S: f64 = 1.0;

const TO_GUIDANCE: [(&str, &str); 11] = [
    ("position", "position"),
    ("velocity", "velocity"),
    ("sun.positionInertial", "sun.position"),
    ("sun.velocityInertial", "sun.velocity"),
    ("earth.positionInertial", "earth.position"),
    ("earth.velocityInertial", "earth.velocity"),
    ("estimate.q", "estimate.q"),
    ("estimate.rate", "estimate.rate"),
    ("estimate.valid", "estimate.valid"),
    ("sun.sensed", "sun.sensed"),
    ("sun.sensedValid", "sun.sensedValid"),
];

const TO_PLANT: [(&str, &str); 4] = [
    ("command.kind", "command.kind"),
    ("command.q", "command.q"),
    ("command.rate", "command.rate"),
    ("command.error", "command.error"),
];

const PLANT_OUTPUTS: [&str; 10] = [
    "position",
    "sun.positionInertial",
    "earth.positionInertial",
    "attitude.q",
    "attitude.rate",
    "estimate.q",
    "estimate.valid",
    "sun.sensedValid",
    "control.saturated",
    "dump.count",
];

const GUIDANCE_OUTPUTS: [&str; 7] = [
    "command.q",
    "command.rate",
    "command.kind",
    "mode.active",
    "link.available",
    "mdis.angle",
    "constraint.sunKeepIn",
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
    pub q: [f64; 4],
    /// True rate, body frame, in rad/s.
    pub rate_rad_s: Vector,
    /// Estimated attitude.
    pub estimate_q: [f64; 4],
    /// `estimate.valid`.
    pub is_attitude_known: bool,
    /// `sun.sensedValid`.
    pub is_sun_sensed: bool,
    /// `control.saturated`.
    pub is_torque_limited: bool,
    /// `dump.count`.
    pub dumps: f64,
    /// Commanded attitude.
    pub command_q: [f64; 4],
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
    fn of(time_s: f64, rows: &[Vec<f64>]) -> Self {
        let (mut plant, mut guidance) = (Row::of(&rows[PLANT]), Row::of(&rows[GUIDANCE]));
        let position_m = plant.vector();
        let [to_sun_m, to_earth_m] = [plant.vector(), plant.vector()].map(|it| difference(&it, &position_m));
        Self {
            time_s,
            to_planet_m: scaled(&position_m, -1.0),
            to_sun_m,
            to_earth_m,
            q: plant.vector(),
            rate_rad_s: plant.vector(),
            estimate_q: plant.vector(),
            is_attitude_known: plant.flag(),
            is_sun_sensed: plant.flag(),
            is_torque_limited: plant.flag(),
            dumps: plant.real(),
            command_q: guidance.vector(),
            command_rate_rad_s: guidance.vector(),
            command_kind: guidance.real() as i32,
            mode: guidance.real() as i32,
            has_link: guidance.flag(),
            mdis_angle_rad: guidance.real(),
            is_constrained: guidance.flag(),
        }
    }

    /// The Sun in the true body frame, in m.
    pub fn sun_body_m(&self) -> Vector {
        turn(&self.q, &self.to_sun_m)
    }
}

/// What is flown in the loop.
pub struct Flight<'a> {
    /// For messages and tables.
    pub label: &'a str,
    /// Past J2000 TDB, in s.
    pub epoch_s: f64,
    /// Where on the orbit it starts, in deg from periapsis.
    pub true_anomaly_deg: f64,
    /// Length, in s.
    pub stop_s: f64,
    /// Parameters of the plant besides.
    pub plant: Settings,
    /// Parameters of Guidance besides.
    pub guidance: Settings,
    /// What is set on which unit from a second on.
    pub inputs: &'a (dyn Fn(&Sample) -> Vec<(usize, Settings)> + Sync),
}

/// Both FMUs.
pub struct Loop {
    plant: Fmu,
    guidance: Fmu,
}

impl Loop {
    /// Opens both in the folder `options` names.
    pub fn open(options: &Options) -> Result<Self, StudyError> {
        Ok(Self { plant: options.fmu("MessengerFull.fmu")?, guidance: options.fmu("Guidance.fmu")? })
    }

    /// A parameter of Guidance that nobody sets.
    pub fn guidance_parameters<const N: usize>(&self, names: [&str; N]) -> Result<[f64; N], StudyError> {
        Self::parameters(&self.guidance, names)
    }

    /// A parameter of the plant that nobody sets.
    pub fn plant_parameters<const N: usize>(&self, names: [&str; N]) -> Result<[f64; N], StudyError> {
        Self::parameters(&self.plant, names)
    }

    fn parameters<const N: usize>(fmu: &Fmu, names: [&str; N]) -> Result<[f64; N], StudyError> {
        let read = || Unit::start(fmu, &Vec::new(), &Vec::new(), &names)?.read();
        let row = read().map_err(|error| StudyError::Simulation {
            case: format!("parameters of {}", fmu.name()),
            source: error.into(),
        })?;
        Ok(Row::of(&row).vector())
    }

    /// Flies it in steps of `step_s`, otherwise of a second; a sample a second. It begins in the attitude and at the rate
    /// that is commanded first.
    pub fn fly(&self, flight: &Flight<'_>, step_s: Option<f64>) -> Result<Vec<Sample>, StudyError> {
        let step_s = step_s.unwrap_or(SAMPLE_S);
        if ((SAMPLE_S / step_s).round() * step_s - SAMPLE_S).abs() > 1e-9 {
            return Err(StudyError::Step { found_s: step_s, allowed: "a second or a whole part of it" });
        }
        let failed =
            |error: Error| StudyError::Simulation { case: flight.label.to_owned(), source: error.into() };
        let (q, rate_rad_s) = self.first_command(flight).map_err(failed)?;
        let mut start = vec![number("attitude.source", CONTROLLED), number("command.source", 1)];
        start.extend(quaternion_setting("start.q", &q));
        start.extend(vector_setting("start.rate", &rate_rad_s));
        let grid = Grid { stop_s: flight.stop_s, step_s, sample_s: SAMPLE_S };
        self.samples(flight, &start, grid).map_err(failed)
    }

    /// What Guidance commands at the start.
    fn first_command(&self, flight: &Flight<'_>) -> Result<([f64; 4], Vector), Error> {
        let grid = Grid { stop_s: SAMPLE_S, step_s: SAMPLE_S, sample_s: SAMPLE_S };
        let samples = self.samples(flight, &Vec::new(), grid)?;
        let command = samples.last().map(|last| (last.command_q, last.command_rate_rad_s));
        let (q, rate_rad_s) = command.unwrap_or(([0.0, 0.0, 0.0, 1.0], [0.0; 3]));
        Ok((rotated(&q, &rate_rad_s, -SAMPLE_S), rate_rad_s))
    }

    fn samples(&self, flight: &Flight<'_>, start: &Settings, grid: Grid) -> Result<Vec<Sample>, Error> {
        let epoch = real("start.epoch", flight.epoch_s);
        let anomaly = real("orbit.trueAnomaly", flight.true_anomaly_deg.to_radians());
        let plant = [start, &flight.plant, &vec![epoch.clone(), anomaly]].map(Clone::clone).concat();
        let guidance = [vec![epoch, number("ephemeris.source", EPHEMERIS_INPUTS)], flight.guidance.clone()];
        let mut units = [
            Unit::start(&self.plant, &plant, &Vec::new(), &PLANT_OUTPUTS)?,
            Unit::start(&self.guidance, &guidance.concat(), &Vec::new(), &GUIDANCE_OUTPUTS)?,
        ];
        let (plant, guidance) = ((PLANT, &self.plant), (GUIDANCE, &self.guidance));
        let wires =
            [Wires::connect(plant, guidance, &TO_GUIDANCE)?, Wires::connect(guidance, plant, &TO_PLANT)?];
        let inputs = |time_s: f64, rows: &[Vec<f64>]| (flight.inputs)(&Sample::of(time_s, rows));
        fly(&mut units, &wires, grid, inputs, Sample::of)
    }
}

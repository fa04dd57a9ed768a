//! One burn: `Guidance` steers, the controlled plant thrusts with what its thrusters and accelerometers are wrong by.

use super::guided_loop::{Loop, start_settings, whole_part_of_a_second};
use crate::StudyError;
use crate::attitude::{Attitude, Vector};
use crate::case::{Case, Row};
use crate::settings::Settings;

/// Velocity to add, in m/s.
pub const DELTA_V_M_S: f64 = 10.0;
/// When thrust begins, in s: the estimate has settled.
pub const START_S: f64 = 20.0;
/// Length of a flight, in s: the burn takes 114 s.
const STOP_S: f64 = 160.0;
/// Mass at which four thrusters of 22 N give 0.088 m/s2, in kg.
const MASS_KG: f64 = 1000.0;
const ACCELERATION_M_S2: f64 = 0.088;
/// Angle between the thrust and its nominal direction.
const MISALIGNMENT_DEG: f64 = 0.75;
/// How far it moves over the burn.
const DRIFT_DEG: f64 = 0.1;
/// How long that takes, in s.
const BURN_S: f64 = 114.0;
const JITTER_DEG: f64 = 0.1;
const SCALE: f64 = 1e-4;
const NOISE_M_S2: f64 = 1e-4;
const SAMPLE_S: f64 = 1.0;

/// What is recorded, in the order of [`Sample`].
const OUTPUTS: [&str; 10] = [
    "plant.deltaV",
    "plant.estimate.q",
    "plant.position",
    "plant.sun.positionInertial",
    "guidance.command.q",
    "guidance.command.rate",
    "guidance.thrust.command",
    "guidance.burn.thrustEstimate",
    "guidance.burn.timedOut",
    "guidance.constraint.sunKeepIn",
];

/// Which corrections are made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Corrections {
    /// theta.
    pub predictive: bool,
    /// beta.
    pub reactive: bool,
}

/// A burn to fly.
#[derive(Clone, Copy, Debug)]
pub struct Burn {
    pub corrections: Corrections,
    /// Standard deviation of the accelerometers' bias, in m/s2.
    pub bias_m_s2: f64,
    pub seed: i32,
}

/// What is kept of a second.
#[derive(Clone, Copy, Debug)]
pub struct Sample {
    /// In s.
    pub time_s: f64,
    /// True velocity added, EME2000, in m/s.
    pub delta_v_m_s: Vector,
    /// Estimated attitude.
    pub estimate_q: Attitude,
    /// Commanded attitude.
    pub command_q: Attitude,
    /// Commanded rate, body frame, in rad/s.
    pub command_rate_rad_s: Vector,
    /// Whether they are to.
    pub is_commanded: bool,
    /// Estimated thrust direction in the body frame.
    pub thrust_body: Vector,
    /// Whether the burn's time was up.
    pub is_timed_out: bool,
    /// Whether the keep-in zone holds the attitude.
    pub is_constrained: bool,
    /// From the planet's centre, in m.
    position_m: Vector,
    sun_m: Vector,
}

/// A burn's samples.
#[derive(Clone, Debug)]
pub struct Simulated {
    /// One a second.
    pub samples: Vec<Sample>,
    /// Velocity to add, EME2000, in m/s.
    pub wanted_m_s: Vector,
}

impl Sample {
    fn of(mut row: Row<'_>) -> Self {
        Self {
            time_s: row.time_s,
            delta_v_m_s: row.vector(),
            estimate_q: row.attitude(),
            position_m: row.vector(),
            sun_m: row.vector(),
            command_q: row.attitude(),
            command_rate_rad_s: row.vector(),
            is_commanded: row.flag(),
            thrust_body: row.vector(),
            is_timed_out: row.flag(),
            is_constrained: row.flag(),
        }
    }
}

impl Burn {
    /// Flies it from the attitude that is commanded first, in steps of `step_s`, otherwise of a second.
    pub fn fly(&self, both: &Loop, label: &str, step_s: Option<f64>) -> Result<Simulated, StudyError> {
        let step_s = whole_part_of_a_second(step_s)?;
        let samples = |case: Case, wanted_m_s: &Vector| -> Result<Vec<Sample>, StudyError> {
            let case = self.set(case).elements("guidance.burn.deltaV", wanted_m_s.iter().copied());
            let recorded = both.simulate(case, &OUTPUTS, &mut |_| Settings::new())?;
            Ok(recorded.rows().map(Sample::of).collect())
        };
        let short = Case::new(label, SAMPLE_S, SAMPLE_S);
        // Along the orbit's plane or across it makes no difference; the Sun has to stand on -Y, so across the Sun line.
        let first = samples(short.clone(), &Vector::z())?;
        let wanted_m_s = first.first().map_or(Vector::z(), |sample| {
            let to_sun = sample.sun_m - sample.position_m;
            to_sun.cross(&Vector::new(0.3, 0.0, 1.0)).normalize() * DELTA_V_M_S
        });
        let start = samples(short, &wanted_m_s)?.last().map_or(Settings::new(), |last| {
            start_settings(&last.command_q, &last.command_rate_rad_s, last.time_s)
        });
        let samples = samples(Case::new(label, STOP_S, step_s).with(start), &wanted_m_s)?;
        Ok(Simulated { samples, wanted_m_s })
    }

    fn set(&self, case: Case) -> Case {
        case.integer("plant.noise.seed", self.seed)
            .real("plant.spacecraft.mass", MASS_KG)
            .real("plant.thrust.misalignment", MISALIGNMENT_DEG.to_radians())
            .real("plant.thrust.drift", DRIFT_DEG.to_radians() / BURN_S)
            .real("plant.thrust.jitter", JITTER_DEG.to_radians())
            .real("plant.accelerometer.bias", self.bias_m_s2)
            .real("plant.accelerometer.scale", SCALE)
            .real("plant.accelerometer.noise", NOISE_M_S2)
            .item("guidance.pointing.scenario", "burn")
            .item("guidance.burn.thrusters", "c22")
            .real("guidance.burn.start", START_S)
            .real("guidance.burn.acceleration", ACCELERATION_M_S2)
            .boolean("guidance.burn.predictive", self.corrections.predictive)
            .boolean("guidance.burn.reactive", self.corrections.reactive)
    }
}

//! One burn: `Guidance` steers, the controlled plant thrusts with what its thrusters and accelerometers are wrong by.

use super::guided_loop::{Loop, start_settings, whole_part_of_a_second};
use crate::StudyError;
use crate::attitude::{Attitude, Vector};
use crate::case::{Case, recorded};
use crate::settings::Settings;

/// Velocity to add, in m/s.
pub(super) const DELTA_V_M_S: f64 = 10.0;
/// When thrust begins, in s: the estimate has settled.
pub(super) const START_S: f64 = 20.0;
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

/// Burns with the same corrections and accelerometers.
#[derive(Clone, Copy, Debug)]
pub(super) struct BurnKind {
    /// For messages and tables.
    pub label: &'static str,
    /// Whether theta is corrected.
    pub predictive: bool,
    /// Whether beta is.
    pub reactive: bool,
    /// Standard deviation of the accelerometers' bias, in m/s2.
    pub bias_m_s2: f64,
}

recorded! {
    /// What is kept of a second.
    pub(super) struct BurnSample {
        @time_s,
        /// True velocity added, EME2000, in m/s.
        pub delta_v_m_s: Vector = "plant.deltaV",
        /// Estimated attitude.
        pub estimate_q: Attitude = "plant.estimate.q",
        /// From the planet's centre, in m.
        position_m: Vector = "plant.position",
        sun_m: Vector = "plant.sun.positionInertial",
        /// Commanded attitude.
        pub command_q: Attitude = "guidance.command.q",
        /// Commanded rate, body frame, in rad/s.
        pub command_rate_rad_s: Vector = "guidance.command.rate",
        /// Whether the thrusters are to fire.
        pub is_commanded: bool = "guidance.thrust.command",
        /// Estimated thrust direction in the body frame.
        pub thrust_body: Vector = "guidance.burn.thrustEstimate",
        /// Whether the burn's time was up.
        pub is_timed_out: bool = "guidance.burn.timedOut",
        /// Whether the keep-in zone holds the attitude.
        pub is_constrained: bool = "guidance.constraint.sunKeepIn",
    }
}

/// A burn's samples.
#[derive(Clone, Debug)]
pub(super) struct Simulated {
    /// One a second.
    pub samples: Vec<BurnSample>,
    /// Velocity to add, EME2000, in m/s.
    pub commanded_m_s: Vector,
}

impl BurnKind {
    /// Simulates one from the attitude that is commanded first, in steps of `step_s`, otherwise of a second.
    pub(super) fn simulated(
        &self,
        both: &Loop,
        seed: i32,
        step_s: Option<f64>,
    ) -> Result<Simulated, StudyError> {
        let step_s = whole_part_of_a_second(step_s)?;
        let label = format!("{}, seed {seed}", self.label);
        let samples = |case: Case, commanded_m_s: &Vector| -> Result<Vec<BurnSample>, StudyError> {
            let case = self.set(case, seed).set("guidance.burn.deltaV", *commanded_m_s);
            Ok(both.simulate(case, BurnSample::NAMES, &mut |_| Settings::new())?.all(0))
        };
        let short = Case::new(label.as_str(), SAMPLE_S, SAMPLE_S);
        // Along the orbit's plane or across it makes no difference; the Sun has to stand on -Y, so across the Sun line.
        let first = samples(short.clone(), &Vector::z())?;
        let commanded_m_s = first.first().map_or(Vector::z(), |sample| {
            let to_sun = sample.sun_m - sample.position_m;
            to_sun.cross(&Vector::new(0.3, 0.0, 1.0)).normalize() * DELTA_V_M_S
        });
        let start = samples(short, &commanded_m_s)?.last().map_or(Settings::new(), |last| {
            start_settings(&last.command_q, &last.command_rate_rad_s, last.time_s)
        });
        let samples = samples(Case::new(label, STOP_S, step_s).with(start), &commanded_m_s)?;
        Ok(Simulated { samples, commanded_m_s })
    }

    fn set(&self, case: Case, seed: i32) -> Case {
        case.set("plant.noise.seed", seed)
            .set("plant.spacecraft.mass", MASS_KG)
            .set("plant.thrust.misalignment", MISALIGNMENT_DEG.to_radians())
            .set("plant.thrust.drift", DRIFT_DEG.to_radians() / BURN_S)
            .set("plant.thrust.jitter", JITTER_DEG.to_radians())
            .set("plant.accelerometer.bias", self.bias_m_s2)
            .set("plant.accelerometer.scale", SCALE)
            .set("plant.accelerometer.noise", NOISE_M_S2)
            .set("guidance.pointing.scenario", "burn")
            .set("guidance.burn.thrusters", "c22")
            .set("guidance.burn.start", START_S)
            .set("guidance.burn.acceleration", ACCELERATION_M_S2)
            .set("guidance.burn.predictive", self.predictive)
            .set("guidance.burn.reactive", self.reactive)
    }
}

//! One burn: `Guidance` steers, the controlled plant thrusts with what its thrusters and accelerometers are wrong by.

use loader::{Error, Fmu};

use super::cosimulation::{Grid, Row, Unit, Wires, fly};
use crate::settings::{Settings, flag, number, quaternion_setting, real, vector_setting};
use crate::vector::{Vector, cross, difference, rotated, scaled, unit};
use crate::{Options, StudyError};

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

/// Numbers of the units.
const PLANT: usize = 0;
const GUIDANCE: usize = 1;

const TO_GUIDANCE: [(&str, &str); 11] = [
    ("position", "position"),
    ("velocity", "velocity"),
    ("sun.positionInertial", "sun.position"),
    ("sun.velocityInertial", "sun.velocity"),
    ("earth.positionInertial", "earth.position"),
    ("earth.velocityInertial", "earth.velocity"),
    ("estimate.q", "estimate.q"),
    ("estimate.valid", "estimate.valid"),
    ("sun.sensed", "sun.sensed"),
    ("sun.sensedValid", "sun.sensedValid"),
    ("accelerometer.deltaV", "accelerometer.deltaV"),
];

const TO_PLANT: [(&str, &str); 7] = [
    ("command.kind", "command.kind"),
    ("command.q", "command.q"),
    ("command.rate", "command.rate"),
    ("command.error", "command.error"),
    ("thrust.request", "thrust.request"),
    ("thrust.command", "thrust.command"),
    ("thrust.stop", "thrust.stop"),
];

const PLANT_OUTPUTS: [&str; 4] = ["deltaV", "estimate.q", "position", "sun.positionInertial"];

const GUIDANCE_OUTPUTS: [&str; 6] = [
    "command.q",
    "command.rate",
    "thrust.command",
    "burn.thrustEstimate",
    "burn.timedOut",
    "constraint.sunKeepIn",
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
    pub estimate_q: [f64; 4],
    /// Commanded attitude.
    pub command_q: [f64; 4],
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
pub struct Flown {
    /// One a second.
    pub samples: Vec<Sample>,
    /// Velocity to add, EME2000, in m/s.
    pub wanted_m_s: Vector,
}

impl Sample {
    fn of(time_s: f64, rows: &[Vec<f64>]) -> Self {
        let (mut plant, mut guidance) = (Row::of(&rows[PLANT]), Row::of(&rows[GUIDANCE]));
        Self {
            time_s,
            delta_v_m_s: plant.vector(),
            estimate_q: plant.vector(),
            position_m: plant.vector(),
            sun_m: plant.vector(),
            command_q: guidance.vector(),
            command_rate_rad_s: guidance.vector(),
            is_commanded: guidance.flag(),
            thrust_body: guidance.vector(),
            is_timed_out: guidance.flag(),
            is_constrained: guidance.flag(),
        }
    }
}

/// Both FMUs.
pub struct BurnLoop {
    plant: Fmu,
    guidance: Fmu,
}

impl BurnLoop {
    /// Opens both in the folder `options` names; the plant is one with thrusters.
    pub fn open(options: &Options) -> Result<Self, StudyError> {
        Ok(Self { plant: options.fmu("MessengerFull.fmu")?, guidance: options.fmu("Guidance.fmu")? })
    }

    /// Flies it from the attitude that is commanded first, in steps of `step_s`, otherwise of a second.
    pub fn fly(&self, burn: &Burn, label: &str, step_s: Option<f64>) -> Result<Flown, StudyError> {
        let step_s = step_s.unwrap_or(SAMPLE_S);
        if ((SAMPLE_S / step_s).round() * step_s - SAMPLE_S).abs() > 1e-9 {
            return Err(StudyError::Step { found_s: step_s, allowed: "a second or a whole part of it" });
        }
        self.flown(burn, step_s)
            .map_err(|error| StudyError::Simulation { case: label.to_owned(), source: error.into() })
    }

    fn flown(&self, burn: &Burn, step_s: f64) -> Result<Flown, Error> {
        // Along the orbit's plane or across it makes no difference; the Sun has to stand on -Y, so across the Sun line.
        let first = self.samples(burn, &Vec::new(), [0.0, 0.0, 1.0], SAMPLE_S, SAMPLE_S)?;
        let wanted_m_s = first.first().map_or([0.0, 0.0, 1.0], |sample| {
            let to_sun = difference(&sample.sun_m, &sample.position_m);
            scaled(&unit(&cross(&to_sun, &[0.3, 0.0, 1.0])), DELTA_V_M_S)
        });
        let pointed = self.samples(burn, &Vec::new(), wanted_m_s, SAMPLE_S, SAMPLE_S)?;
        let mut start = Vec::new();
        if let Some(last) = pointed.last() {
            let q = rotated(&last.command_q, &last.command_rate_rad_s, -last.time_s);
            start.extend(quaternion_setting("start.q", &q));
            start.extend(vector_setting("start.rate", &last.command_rate_rad_s));
        }
        let samples = self.samples(burn, &start, wanted_m_s, STOP_S, step_s)?;
        Ok(Flown { samples, wanted_m_s })
    }

    fn samples(
        &self,
        burn: &Burn,
        start: &Settings,
        wanted_m_s: Vector,
        stop_s: f64,
        step_s: f64,
    ) -> Result<Vec<Sample>, Error> {
        let plant = [
            vec![
                // controlled
                number("attitude.source", 3),
                number("command.source", 1),
                number("noise.seed", burn.seed),
                real("spacecraft.mass", MASS_KG),
                real("thrust.misalignment", MISALIGNMENT_DEG.to_radians()),
                real("thrust.drift", DRIFT_DEG.to_radians() / BURN_S),
                real("thrust.jitter", JITTER_DEG.to_radians()),
                real("accelerometer.bias", burn.bias_m_s2),
                real("accelerometer.scale", SCALE),
                real("accelerometer.noise", NOISE_M_S2),
            ],
            start.clone(),
        ];
        let guidance = [
            vec![
                // inputs
                number("ephemeris.source", 3),
                // c22
                number("burn.thrusters", 2),
                real("burn.start", START_S),
                real("burn.acceleration", ACCELERATION_M_S2),
                flag("burn.predictive", burn.corrections.predictive),
                flag("burn.reactive", burn.corrections.reactive),
            ],
            vector_setting("burn.deltaV", &wanted_m_s),
        ];
        // burn
        let scenario = vec![number("pointing.scenario", 9)];
        let mut units = [
            Unit::start(&self.plant, &plant.concat(), &Vec::new(), &PLANT_OUTPUTS)?,
            Unit::start(&self.guidance, &guidance.concat(), &scenario, &GUIDANCE_OUTPUTS)?,
        ];
        let (plant, guidance) = ((PLANT, &self.plant), (GUIDANCE, &self.guidance));
        let wires =
            [Wires::connect(plant, guidance, &TO_GUIDANCE)?, Wires::connect(guidance, plant, &TO_PLANT)?];
        let grid = Grid { stop_s, step_s, sample_s: SAMPLE_S };
        fly(&mut units, &wires, grid, |_, _| Vec::new(), Sample::of)
    }
}

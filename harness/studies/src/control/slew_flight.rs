//! Slews of the controlled plant: a commanded attitude that jumps, with wheels that start near capacity or fail.

use loader::{Error, Fmu};

use super::cosimulation::{Grid, Row, Unit, fly};
use super::slew_limits::SlewLimits;
use crate::settings::{Settings, flag, number, quaternion_setting, real, vector_setting};
use crate::vector::{Vector, dot, rotated, rotation_vector, scaled};
use crate::{Options, StudyError};

/// The command jumps then, in s.
pub const SLEW_S: f64 = 10.0;
/// Between two samples, in s.
pub const SAMPLE_S: f64 = 0.5;
/// A component of momentum that is never reached: no dumps by themselves.
const NEVER_N_M_S: f64 = 1e6;

/// What happens besides the slew.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Event {
    /// Nothing.
    None,
    /// Every wheel starts at this share of its capacity, in the sense that the slew adds to; a dump to zero is requested
    /// at a time, in s.
    Dumped(f64, f64),
    /// The same, and the threshold is put back to the default then.
    Threshold(f64, f64),
    /// The motor of a wheel, from 1, fails after this share of the slew's ideal duration.
    Failed(usize, f64),
}

/// One slew.
#[derive(Clone, Debug)]
pub struct Slew {
    /// For messages and tables.
    pub label: &'static str,
    /// Body axis of the slew: a unit vector.
    pub axis: Vector,
    /// In rad.
    pub angle_rad: f64,
    /// What else happens.
    pub event: Event,
    /// How long is flown, in s; otherwise what a slew takes.
    pub stop_s: Option<f64>,
}

/// Limits of slew and wheels, as the FMU has them.
#[derive(Clone, Debug)]
pub struct Limits {
    /// `control.slewRate` and `control.slewAcceleration`.
    pub slew: SlewLimits,
    /// `control.bandwidth`, in rad/s.
    pub bandwidth_rad_s: f64,
    /// `wheel[k].maxTorque`, in N m.
    pub torque_n_m: Vec<f64>,
    /// `wheel[k].capacity`, in N m s.
    pub capacity_n_m_s: Vec<f64>,
    /// `wheel[k].axis`: unit vectors.
    pub axes: Vec<Vector>,
}

impl Limits {
    fn read(fmu: &Fmu) -> Result<Self, Error> {
        let wheels = (1..).take_while(|k| fmu.find(&format!("wheel[{k}].torque")).is_some()).count();
        let each = |name: &str| (1..=wheels).map(|k| format!("wheel[{k}].{name}")).collect::<Vec<_>>();
        let read = |names: &[String]| Unit::start(fmu, &Vec::new(), &Vec::new(), names)?.read();
        let control =
            read(&[SlewLimits::NAMES[0], SlewLimits::NAMES[1], "control.bandwidth"].map(str::to_owned))?;
        let mut control = Row::of(&control);
        let axes = read(&each("axis"))?;
        Ok(Self {
            slew: SlewLimits::of(&mut control),
            bandwidth_rad_s: control.real(),
            torque_n_m: read(&each("maxTorque"))?,
            capacity_n_m_s: read(&each("capacity"))?,
            axes: axes.chunks_exact(3).map(|a| crate::vector::unit(&[a[0], a[1], a[2]])).collect(),
        })
    }
}

/// One wheel at one time.
#[derive(Clone, Copy, Debug)]
pub struct WheelSample {
    /// Of the motor, in N m.
    pub torque_n_m: f64,
    /// Relative to the body, in N m s.
    pub momentum_n_m_s: f64,
    /// `wheel[k].saturated`.
    pub is_saturated: bool,
}

/// Everything at one time.
#[derive(Clone, Debug)]
pub struct Sample {
    /// In s.
    pub time_s: f64,
    /// True attitude: EME2000 to body, scalar last.
    pub q: [f64; 4],
    /// True rate, body frame, in rad/s.
    pub rate_rad_s: Vector,
    /// Rotation from the attitude to the one after the slew, body frame, in rad.
    pub left_rad: Vector,
    /// `control.saturated`.
    pub is_torque_limited: bool,
    /// `dump.active`.
    pub is_dumping: bool,
    /// `dump.count`.
    pub dumps: f64,
    /// `momentum.body`, in N m s.
    pub momentum_n_m_s: Vector,
    /// Wheel by wheel.
    pub wheels: Vec<WheelSample>,
}

impl Sample {
    /// How far the body still is from the commanded attitude along the slew's axis, in rad; negative beyond it.
    pub fn ahead_rad(&self, slew: &Slew) -> f64 {
        dot(&self.left_rad, &slew.axis)
    }
}

/// A slew and its samples.
pub struct Flown {
    /// What was flown.
    pub slew: Slew,
    /// By the FMU's parameters.
    pub limits: Limits,
    /// Every [`SAMPLE_S`].
    pub samples: Vec<Sample>,
}

/// The plant and what of it every slew needs.
pub struct Plant {
    fmu: Fmu,
    limits: Limits,
    /// Attitude that the plant's own guidance has at the start.
    q: [f64; 4],
    /// Body rows of the start values of `dump.threshold`.
    threshold_n_m_s: Vector,
}

impl Plant {
    /// Of the folder that `options` names.
    pub fn open(options: &Options) -> Result<Self, StudyError> {
        let fmu = options.fmu("MessengerFull.fmu")?;
        let read = || -> Result<_, Error> {
            let names = ["attitude.q", "dump.threshold"];
            let row = Unit::start(&fmu, &Vec::new(), &Vec::new(), &names)?.read()?;
            let mut row = Row::of(&row);
            Ok((Limits::read(&fmu)?, row.vector(), row.vector()))
        };
        let (limits, q, threshold_n_m_s) = read().map_err(|error| StudyError::Simulation {
            case: "parameters of MessengerFull".to_owned(),
            source: error.into(),
        })?;
        Ok(Self { fmu, limits, q, threshold_n_m_s })
    }

    /// Flies it.
    pub fn fly(&self, slew: &Slew, step_s: Option<f64>) -> Result<Flown, StudyError> {
        let failed =
            |error: Error| StudyError::Simulation { case: slew.label.to_owned(), source: error.into() };
        let samples = self.samples(slew, step_s.unwrap_or(SAMPLE_S)).map_err(failed)?;
        Ok(Flown { slew: slew.clone(), limits: self.limits.clone(), samples })
    }

    fn samples(&self, slew: &Slew, step_s: f64) -> Result<Vec<Sample>, Error> {
        let target = rotated(&self.q, &scaled(&slew.axis, slew.angle_rad), 1.0);
        let wheels = self.limits.axes.len();
        let outputs = ["attitude.q", "attitude.rate", "control.saturated", "dump.active", "dump.count"];
        let mut outputs: Vec<String> = outputs.map(str::to_owned).to_vec();
        outputs.push("momentum.body".to_owned());
        for k in 1..=wheels {
            outputs.extend(["torque", "momentum", "saturated"].map(|name| format!("wheel[{k}].{name}")));
        }
        let plant = Unit::start(
            &self.fmu,
            &self.parameters(slew),
            &quaternion_setting("command.q", &self.q),
            &outputs,
        )?;
        let ideal_s = self.limits.slew.least_s(slew.angle_rad.abs());
        let grid = Grid {
            stop_s: slew.stop_s.unwrap_or_else(|| (SLEW_S + 1.4 * ideal_s + 100.0).ceil()),
            step_s,
            sample_s: SAMPLE_S,
        };
        let mut events = self.events(slew, &target, ideal_s).into_iter().peekable();
        let inputs = |time_s: f64, _: &[Vec<f64>]| {
            let mut due = Vec::new();
            while let Some((_, settings)) = events.next_if(|(at_s, _)| *at_s <= time_s + 1e-9) {
                due.push((0, settings));
            }
            due
        };
        fly(&mut [plant], &[], grid, inputs, |time_s, rows| {
            let mut row = Row::of(&rows[0]);
            let q = row.vector();
            Sample {
                time_s,
                q,
                rate_rad_s: row.vector(),
                left_rad: rotation_vector(&q, &target),
                is_torque_limited: row.flag(),
                is_dumping: row.flag(),
                dumps: row.real(),
                momentum_n_m_s: row.vector(),
                wheels: (0..wheels)
                    .map(|_| WheelSample {
                        torque_n_m: row.real(),
                        momentum_n_m_s: row.real(),
                        is_saturated: row.flag(),
                    })
                    .collect(),
            }
        })
    }

    /// At rest in the start attitude, which is held until the command jumps.
    fn parameters(&self, slew: &Slew) -> Settings {
        let mut parameters = vec![number("attitude.source", 3), number("command.source", 1)];
        parameters.extend(quaternion_setting("start.q", &self.q));
        if let Event::Dumped(share, _) | Event::Threshold(share, _) = slew.event {
            parameters.extend(vector_setting("dump.threshold", &[NEVER_N_M_S; 3]));
            for (k, (capacity, axis)) in self.limits.capacity_n_m_s.iter().zip(&self.limits.axes).enumerate()
            {
                // The wheels take up the opposite of the body's momentum.
                let sense = -dot(axis, &slew.axis).signum() * slew.angle_rad.signum();
                parameters.push(real(&format!("wheel[{}].startMomentum", k + 1), sense * share * capacity));
            }
        }
        parameters
    }

    fn events(&self, slew: &Slew, target: &[f64; 4], ideal_s: f64) -> Vec<(f64, Settings)> {
        let jump = (SLEW_S, quaternion_setting("command.q", target));
        match slew.event {
            Event::None => vec![jump],
            Event::Dumped(_, at_s) => vec![jump, (at_s, vec![flag("dump.request", true)])],
            Event::Threshold(_, at_s) => {
                vec![jump, (at_s, vector_setting("dump.threshold", &self.threshold_n_m_s))]
            }
            Event::Failed(wheel, share) => {
                let failure = vec![flag(&format!("wheel[{wheel}].failed"), true)];
                vec![jump, (SLEW_S + share * ideal_s, failure)]
            }
        }
    }
}

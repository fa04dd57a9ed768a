//! Slews of the controlled plant: a commanded attitude that jumps, with wheels that start near capacity or fail.

use loader::Fmu;

use super::slew_limits::SlewLimits;
use crate::attitude::{Attitude, Vector};
use crate::case::{Case, Row, at_start};
use crate::settings::{Settings, elements, flag};
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
    /// How long is simulated, in s; otherwise what a slew takes.
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
    fn read(fmu: &Fmu) -> Result<Self, StudyError> {
        let wheels = (1..).take_while(|k| fmu.find(&format!("wheel[{k}].torque")).is_some()).count();
        let read = |name: &str| {
            let each: Vec<String> = (1..=wheels).map(|k| format!("wheel[{k}].{name}")).collect();
            Ok::<_, StudyError>(
                at_start(fmu, &each)?.columns.iter().map(|column| column[0]).collect::<Vec<_>>(),
            )
        };
        let control = at_start(fmu, &[SlewLimits::NAMES[0], SlewLimits::NAMES[1], "control.bandwidth"])?;
        let mut control = control.row(0, 0);
        let axes = read("axis")?;
        Ok(Self {
            slew: SlewLimits::from([control.real(), control.real()]),
            bandwidth_rad_s: control.real(),
            torque_n_m: read("maxTorque")?,
            capacity_n_m_s: read("capacity")?,
            axes: axes.chunks_exact(3).map(|axis| Vector::from_row_slice(axis).normalize()).collect(),
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
    pub q: Attitude,
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
        self.left_rad.dot(&slew.axis)
    }
}

/// A slew and its samples.
pub struct Simulated {
    /// What was simulated.
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
    q: Attitude,
    /// Body rows of the start values of `dump.threshold`.
    threshold_n_m_s: Vector,
}

impl Plant {
    /// Of the folder that `options` names.
    pub fn open(options: &Options) -> Result<Self, StudyError> {
        let fmu = options.fmu("MessengerFull.fmu")?;
        let start = at_start(&fmu, &["attitude.q", "dump.threshold"])?;
        let mut start = start.row(0, 0);
        let limits = Limits::read(&fmu)?;
        Ok(Self { limits, q: start.attitude(), threshold_n_m_s: start.vector(), fmu })
    }

    /// Flies it.
    pub fn fly(&self, slew: &Slew, step_s: Option<f64>) -> Result<Simulated, StudyError> {
        let target = self.q * Attitude::from_scaled_axis(slew.axis * slew.angle_rad);
        let wheels = self.limits.axes.len();
        let mut outputs = OUTPUTS.map(str::to_owned).to_vec();
        for k in 1..=wheels {
            outputs.extend(["torque", "momentum", "saturated"].map(|name| format!("wheel[{k}].{name}")));
        }
        let ideal_s = self.limits.slew.least_s(slew.angle_rad.abs());
        let stop_s = slew.stop_s.unwrap_or_else(|| (SLEW_S + 1.4 * ideal_s + 100.0).ceil());
        let mut events = self.events(slew, &target, ideal_s).into_iter().peekable();
        let mut inputs = |row: Row<'_>| {
            let mut due = Settings::new();
            while let Some((_, settings)) = events.next_if(|(at_s, _)| *at_s <= row.time_s + 1e-9) {
                due.extend(settings);
            }
            due
        };
        let case = Case::new(slew.label, stop_s, step_s.unwrap_or(SAMPLE_S)).every(SAMPLE_S);
        let recorded = self.start(case, slew).steer(&self.fmu, &outputs, &mut inputs)?;
        let sample = |mut row: Row<'_>| {
            let q = row.attitude();
            Sample {
                time_s: row.time_s,
                q,
                rate_rad_s: row.vector(),
                left_rad: (q.inverse() * target).scaled_axis(),
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
        };
        let samples = recorded.rows().map(sample).collect();
        Ok(Simulated { slew: slew.clone(), limits: self.limits.clone(), samples })
    }

    /// At rest in the start attitude, which is held until the command jumps.
    fn start(&self, case: Case, slew: &Slew) -> Case {
        let mut case = case
            .item("attitude.source", "controlled")
            .item("command.source", "inputs")
            .elements("start.q", self.q.coords.iter().copied())
            .elements("command.q", self.q.coords.iter().copied());
        if let Event::Dumped(share, _) | Event::Threshold(share, _) = slew.event {
            case = case.elements("dump.threshold", [NEVER_N_M_S; 3]);
            for (k, (capacity, axis)) in self.limits.capacity_n_m_s.iter().zip(&self.limits.axes).enumerate()
            {
                // The wheels take up the opposite of the body's momentum.
                let sense = -axis.dot(&slew.axis).signum() * slew.angle_rad.signum();
                case = case.real(&format!("wheel[{}].startMomentum", k + 1), sense * share * capacity);
            }
        }
        case
    }

    fn events(&self, slew: &Slew, target: &Attitude, ideal_s: f64) -> Vec<(f64, Settings)> {
        let jump = (SLEW_S, elements("command.q", target.coords.iter().copied()));
        let other = match slew.event {
            Event::None => None,
            Event::Dumped(_, at_s) => Some((at_s, vec![flag("dump.request", true)])),
            Event::Threshold(_, at_s) => {
                Some((at_s, elements("dump.threshold", self.threshold_n_m_s.iter().copied())))
            }
            Event::Failed(wheel, share) => {
                let failure = vec![flag(&format!("wheel[{wheel}].failed"), true)];
                Some((SLEW_S + share * ideal_s, failure))
            }
        };
        [jump].into_iter().chain(other).collect()
    }
}

/// What is recorded of the body, in the order of [`Sample`].
const OUTPUTS: [&str; 6] =
    ["attitude.q", "attitude.rate", "control.saturated", "dump.active", "dump.count", "momentum.body"];

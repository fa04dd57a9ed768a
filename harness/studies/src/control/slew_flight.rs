//! Slews of the controlled plant: a commanded attitude that jumps, with wheels that start near capacity or fail.

use loader::Fmu;

use super::slew_limits::SlewLimits;
use crate::attitude::{Attitude, Vector};
use crate::case::{Case, Row, at_start, numbered, recorded};
use crate::settings::{Settings, set};
use crate::{Options, StudyError};

/// The command jumps then, in s.
pub(super) const SLEW_S: f64 = 10.0;
/// Between two samples, in s.
pub(super) const SAMPLE_S: f64 = 0.5;
/// A component of momentum that is never reached: no dumps by themselves.
const NEVER_N_M_S: f64 = 1e6;

/// What happens besides the slew.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Event {
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
pub(super) struct Slew {
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

recorded! {
    /// Limits of a wheel.
    pub(super) struct Wheel {
        /// In N m.
        pub torque_n_m: f64 = "maxTorque",
        /// In N m s.
        pub capacity_n_m_s: f64 = "capacity",
        /// A unit vector.
        pub axis: Vector = "axis",
    }
}

/// Limits of slew and wheels, as the FMU has them.
#[derive(Clone, Debug)]
pub(super) struct Limits {
    /// `control.slewRate` and `control.slewAcceleration`.
    pub slew: SlewLimits,
    /// `control.bandwidth`, in rad/s.
    pub bandwidth_rad_s: f64,
    /// `wheel[k]`.
    pub wheels: Vec<Wheel>,
}

impl Limits {
    fn read(fmu: &Fmu) -> Result<Self, StudyError> {
        let mut wheels: Vec<Wheel> = at_start(fmu, &numbered(fmu, "wheel", Wheel::NAMES))?.first();
        wheels.iter_mut().for_each(|wheel| wheel.axis = wheel.axis.normalize());
        Ok(Self {
            slew: at_start(fmu, SlewLimits::NAMES)?.first(),
            bandwidth_rad_s: at_start(fmu, &["control.bandwidth"])?.first(),
            wheels,
        })
    }
}

recorded! {
    /// One wheel at one time.
    pub(super) struct WheelSample {
        /// Of the motor, in N m.
        pub torque_n_m: f64 = "torque",
        /// Relative to the body, in N m s.
        pub momentum_n_m_s: f64 = "momentum",
        /// Whether it holds as much as it can.
        pub is_saturated: bool = "saturated",
    }
}

recorded! {
    /// The body at one time.
    pub(super) struct BodySample {
        @time_s,
        /// True attitude: EME2000 to body, scalar last.
        pub q: Attitude = "attitude.q",
        /// True rate, body frame, in rad/s.
        pub rate_rad_s: Vector = "attitude.rate",
        /// Whether more torque is requested than there is.
        pub is_torque_limited: bool = "control.saturated",
        /// Whether a dump is under way.
        pub is_dumping: bool = "dump.active",
        /// Dumps so far.
        pub dumps: i32 = "dump.count",
        /// In N m s.
        pub momentum_n_m_s: Vector = "momentum.body",
    }
}

/// Everything at one time.
#[derive(Clone, Debug)]
pub(super) struct Sample {
    /// The body.
    pub body: BodySample,
    /// Rotation from the attitude to the one after the slew, body frame, in rad.
    pub left_rad: Vector,
    /// Wheel by wheel.
    pub wheels: Vec<WheelSample>,
}

impl Sample {
    /// How far the body still is from the commanded attitude along the slew's axis, in rad; negative beyond it.
    pub(super) fn ahead_rad(&self, slew: &Slew) -> f64 {
        self.left_rad.dot(&slew.axis)
    }
}

/// A slew and its samples.
pub(super) struct Simulated {
    /// What was simulated.
    pub slew: Slew,
    /// By the FMU's parameters.
    pub limits: Limits,
    /// Every [`SAMPLE_S`].
    pub samples: Vec<Sample>,
}

/// The plant and what of it every slew needs.
pub(super) struct Plant {
    fmu: Fmu,
    limits: Limits,
    /// Attitude that the plant's own guidance has at the start.
    q: Attitude,
    /// Body rows of the start values of `dump.threshold`.
    threshold_n_m_s: Vector,
}

impl Plant {
    /// Of the folder that `options` names.
    pub(super) fn open(options: &Options) -> Result<Self, StudyError> {
        let fmu = options.fmu("MessengerFull.fmu")?;
        let (q, threshold_n_m_s) = at_start(&fmu, &["attitude.q", "dump.threshold"])?.first();
        Ok(Self { limits: Limits::read(&fmu)?, q, threshold_n_m_s, fmu })
    }

    /// Simulates it.
    pub(super) fn simulated(&self, slew: &Slew, step_s: Option<f64>) -> Result<Simulated, StudyError> {
        let target = self.q * Attitude::from_scaled_axis(slew.axis * slew.angle_rad);
        let mut outputs: Vec<String> = BodySample::NAMES.iter().map(|name| (*name).to_owned()).collect();
        outputs.extend(numbered(&self.fmu, "wheel", WheelSample::NAMES));
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
        let sample = |(body, wheels): (BodySample, Vec<WheelSample>)| Sample {
            body,
            left_rad: (body.q.inverse() * target).scaled_axis(),
            wheels,
        };
        let samples = recorded.all(0).into_iter().map(sample).collect();
        Ok(Simulated { slew: slew.clone(), limits: self.limits.clone(), samples })
    }

    /// At rest in the start attitude, which is held until the command jumps.
    fn start(&self, case: Case, slew: &Slew) -> Case {
        let mut case = case
            .set("attitude.source", "controlled")
            .set("command.source", "inputs")
            .set("start.q", self.q)
            .set("command.q", self.q);
        if let Event::Dumped(share, _) | Event::Threshold(share, _) = slew.event {
            case = case.set("dump.threshold", [NEVER_N_M_S; 3]);
            for (k, Wheel { capacity_n_m_s, axis, .. }) in (1..).zip(&self.limits.wheels) {
                // The wheels take up the opposite of the body's momentum.
                let sense = -axis.dot(&slew.axis).signum() * slew.angle_rad.signum();
                case = case.set(&format!("wheel[{k}].startMomentum"), sense * share * capacity_n_m_s);
            }
        }
        case
    }

    fn events(&self, slew: &Slew, target: &Attitude, ideal_s: f64) -> Vec<(f64, Settings)> {
        let jump = (SLEW_S, set("command.q", *target));
        let other = match slew.event {
            Event::None => None,
            Event::Dumped(_, at_s) => Some((at_s, set("dump.request", true))),
            Event::Threshold(_, at_s) => Some((at_s, set("dump.threshold", self.threshold_n_m_s))),
            Event::Failed(wheel, share) => {
                Some((SLEW_S + share * ideal_s, set(&format!("wheel[{wheel}].failed"), true)))
            }
        };
        [jump].into_iter().chain(other).collect()
    }
}

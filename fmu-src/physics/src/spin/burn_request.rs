//! Burn as it is requested, and what is refused of it.

use core::f64::consts::PI;

use nalgebra::Vector3;

use super::{
    burn_error::{BurnError, ParameterError},
    forecast::{ForecastCase, Range, Timing},
    sizing::sized,
    spinner::Spinner,
    train::{Pulses, Shape, Train, TrainError},
};
use crate::attitude::angle_between_rad;

/// Cosine of the greatest angle by which "opposite" may be off.
const OPPOSITE: f64 = -0.996;
/// Relative difference up to which opposite torques are of one size: every pulse of a train counts alike.
const ONE_SIZE: f64 = 1e-3;
/// A target closer than this to the momentum's line has no direction across it but rounding, in rad.
const ALONG_RAD: f64 = 1e-6;

/// Burn as it is requested. A number that is 0 where the field says so is not given.
#[derive(Clone, Debug, PartialEq)]
pub struct BurnRequest {
    /// Shape of the train.
    pub shape: Shape,
    /// Timing.
    pub timing: Timing,
    /// Earliest time of the first pulse, in s.
    pub start_s: f64,
    /// Thruster number from 1.
    pub thruster: i32,
    /// Opposite thruster number from 1; 0 for none.
    pub opposite_thruster: i32,
    /// Named group or thruster instead of the numbers; empty for none.
    pub group: String,
    /// Width of a pulse (of the outermost of a taper) at full thrust, in s.
    pub pulse_width_s: f64,
    /// Turns from pulse to pulse.
    pub turns_per_pulse: f64,
    /// Number of pulses; used where `angle_rad` is 0.
    pub count: i32,
    /// Angle by which the momentum shall move, in rad; 0 to use `count`.
    pub angle_rad: f64,
    /// Smallest step of pulse width, in s: tapers of whole steps stay whole; 0 for none.
    pub resolution_s: f64,
    /// Direction toward which the momentum moves, inertial.
    pub target_inertial: Vector3<f64>,
    /// (assumed - true) / true spin rate.
    pub spin_rate_error: f64,
    /// (assumed - true) / true inertia ratio: the train is made for the assumed one.
    pub ratio_error: f64,
    /// Half width of the range of inertia ratios for which limits shall hold.
    pub ratio_uncertainty: f64,
    /// Limit on nutation at any time, in rad; 0 for none.
    pub max_nutation_rad: f64,
    /// Limit on the time from first to last edge, in s; 0 for none.
    pub max_duration_s: f64,
}

/// Tells whether two torques (body components, in N m) push opposite ways across the spin axis and equally hard: within 5 deg
/// and a thousandth.
pub fn opposes(torque_body_n_m: &Vector3<f64>, other_body_n_m: &Vector3<f64>) -> bool {
    cosine_across(torque_body_n_m, other_body_n_m) <= OPPOSITE
        && are_of_one_size(torque_body_n_m, other_body_n_m)
}

/// Cosine of the angle between the parts across the spin axis; NaN where one has none.
fn cosine_across(one: &Vector3<f64>, other: &Vector3<f64>) -> f64 {
    one.xy().dot(&other.xy()) / (one.xy().norm() * other.xy().norm())
}

fn are_of_one_size(one: &Vector3<f64>, other: &Vector3<f64>) -> bool {
    (other.xy().norm() / one.xy().norm() - 1.0).abs() <= ONE_SIZE
}

/// Refusal of a parameter.
pub(super) fn parameter(name: &'static str, found: impl ToString, allowed: &str) -> BurnError {
    ParameterError::new(name, found, allowed).into()
}

impl BurnRequest {
    /// Refuses errors and a start that cannot be.
    ///
    /// # Errors
    /// The first parameter that is refused.
    pub(super) fn check_numbers(&self) -> Result<(), BurnError> {
        for (name, error) in
            [("burn.spinRateError", self.spin_rate_error), ("burn.ratioError", self.ratio_error)]
        {
            if !(error > -0.5 && error < 0.5) {
                return Err(parameter(name, error, "allowed is -0.5 to 0.5"));
            }
        }
        if !self.start_s.is_finite() {
            return Err(parameter("burn.start", self.start_s, "it must be a time"));
        }
        Ok(())
    }

    /// Refuses thrusters that alternate and do not push opposite ways equally hard.
    ///
    /// # Errors
    /// [`TrainError::Cancels`], or the parameter that names the thrusters.
    pub(super) fn check_opposite(
        &self,
        train: &Train,
        torque_body_n_m: &Vector3<f64>,
        opposite_body_n_m: &Vector3<f64>,
        across_n_m: f64,
    ) -> Result<(), BurnError> {
        let cosine = cosine_across(torque_body_n_m, opposite_body_n_m);
        if cosine.is_nan() || cosine > OPPOSITE {
            return Err(TrainError::Cancels { turns: train.turns_per_pulse() }.into());
        }
        if are_of_one_size(torque_body_n_m, opposite_body_n_m) {
            return Ok(());
        }
        let name = if self.group.is_empty() { "burn.oppositeThruster" } else { "burn.group" };
        let opposite_n_m = opposite_body_n_m.xy().norm();
        let found = format!("a pair of {across_n_m:.6} and {opposite_n_m:.6} N m across the spin axis");
        Err(parameter(name, found, "thrusters that alternate must have one torque, within 0.1 %"))
    }

    /// Thrusters of even half turns, and of odd ones if they are named.
    ///
    /// # Errors
    /// A thruster or group that the spacecraft does not have.
    pub(super) fn masks(&self, spinner: &Spinner) -> Result<(u32, Option<u32>), BurnError> {
        if !self.group.is_empty() {
            return spinner.named(&self.group).ok_or_else(|| {
                let names: Vec<&str> = spinner
                    .groups
                    .iter()
                    .map(|group| group.name.as_str())
                    .chain(spinner.thrusters.iter().map(|thruster| thruster.name.as_str()))
                    .collect();
                let allowed = format!("this spacecraft has {}", names.join(", "));
                parameter("burn.group", format!("\"{}\"", self.group), &allowed)
            });
        }
        let count = spinner.thrusters.len();
        let bit = |name: &'static str, number: i32| match usize::try_from(number) {
            Ok(k) if (1..=count).contains(&k) => Ok(1_u32 << (k - 1)),
            _ => Err(parameter(name, number, &format!("this spacecraft has thrusters 1 to {count}"))),
        };
        let main = bit("burn.thruster", self.thruster)?;
        let opposite = match self.opposite_thruster {
            0 => None,
            number => Some(bit("burn.oppositeThruster", number)?),
        };
        Ok((main, opposite))
    }

    /// Unit vector toward which the momentum moves. It is moved toward a point: there must be a way to it, and no plan goes beyond.
    ///
    /// # Errors
    /// A target that is no direction, on the line of the momentum, or nearer than the angle.
    pub(super) fn target(&self, momentum_inertial: &Vector3<f64>) -> Result<Vector3<f64>, BurnError> {
        let norm = self.target_inertial.norm();
        if !(norm.is_finite() && norm > 0.0) {
            let found = format!("{:?}", self.target_inertial.as_slice());
            return Err(parameter("burn.targetDirection", found, "it must be a direction"));
        }
        let target_inertial = self.target_inertial / norm;
        let apart_rad = angle_between_rad(momentum_inertial, &target_inertial);
        let apart_deg = apart_rad.to_degrees();
        // Written so that a NaN is refused.
        if !(apart_rad > ALONG_RAD && apart_rad < PI - ALONG_RAD) {
            let found = format!(
                "{:?}, {apart_deg:.6} deg from the angular momentum",
                self.target_inertial.as_slice()
            );
            let allowed = "it needs a part across the angular momentum";
            return Err(parameter("burn.targetDirection", found, allowed));
        }
        if self.angle_rad > apart_rad * (1.0 + 1e-9) {
            let found = format!("{} rad ({:.4} deg)", self.angle_rad, self.angle_rad.to_degrees());
            let allowed = format!(
                "burn.targetDirection is {apart_deg:.4} deg from the angular momentum, and a burn goes no farther than its \
                 target: allowed is up to {apart_rad} rad, or a target farther away"
            );
            return Err(parameter("burn.angle", found, &allowed));
        }
        Ok(target_inertial)
    }

    /// Train of pulses for a flight; `points` where it moves the momentum.
    ///
    /// # Errors
    /// Pulses that cannot be.
    pub(super) fn train(&self, flight: &ForecastCase, points: bool) -> Result<Train, BurnError> {
        if self.angle_rad.is_nan() || self.angle_rad < 0.0 {
            return Err(parameter("burn.angle", self.angle_rad, "allowed is 0 (use burn.count) or an angle"));
        }
        let pulses = Pulses {
            shape: self.shape,
            unit_width_s: self.pulse_width_s,
            turns_per_pulse: self.turns_per_pulse,
            resolution_s: self.resolution_s,
        };
        if self.angle_rad == 0.0 || !points {
            let count = u32::try_from(self.count)
                .map_err(|_| parameter("burn.count", self.count, "allowed is 1 or more"))?;
            return Ok(Train::new(&pulses, count, &flight.spin)?);
        }
        sized(&pulses, flight, self.angle_rad)
    }

    /// Refuses a train beyond the limits of the request.
    ///
    /// # Errors
    /// [`BurnError`].
    pub(super) fn check_limits(&self, flight: &ForecastCase, train: &Train) -> Result<(), BurnError> {
        for (name, value) in [
            ("burn.maxDuration", self.max_duration_s),
            ("burn.maxNutation", self.max_nutation_rad),
            ("burn.ratioUncertainty", self.ratio_uncertainty),
        ] {
            if value.is_nan() || value < 0.0 {
                return Err(parameter(name, value, "allowed is 0 or a positive number"));
            }
        }
        let duration_s = train.duration_s(flight.spin.period_s());
        if self.max_duration_s > 0.0 && duration_s > self.max_duration_s {
            return Err(BurnError::Limit {
                what: "its duration",
                found: format!("{duration_s:.3} s"),
                limit: format!("burn.maxDuration = {} s", self.max_duration_s),
            });
        }
        if self.max_nutation_rad > 0.0 {
            let range = Range { ratio: self.ratio_uncertainty, rate_rad_s: 0.0 };
            let peak_rad = range.worst(flight, train).peak_nutation_rad;
            if peak_rad > self.max_nutation_rad {
                return Err(BurnError::Limit {
                    what: "its greatest nutation",
                    found: format!("{:.6} deg", peak_rad.to_degrees()),
                    limit: format!("burn.maxNutation = {:.6} deg", self.max_nutation_rad.to_degrees()),
                });
            }
        }
        Ok(())
    }

    /// Refusal of the width of a pulse.
    pub(super) fn refused_width(&self, allowed: &str) -> BurnError {
        parameter("burn.pulseWidth", format!("{} s", self.pulse_width_s), allowed)
    }
}

//! Reference attitude that follows a command within a slew rate and an acceleration limit.
//!
//! At each sample the motion relative to the command, a rotation vector e and a rate v, is turned toward the command
//! about the eigenaxis: with p = e + v dt/2 (where half of the motion already under way leads), the requested relative rate
//! is -p/|p| times min(slew rate, a (sqrt(T^2 + 2|p|/a) - T)), which solves v^2/2a + v T = |p|: braking never needs more
//! than a, and near the end the rate is |p|/T. The rate follows the requested one with a lag of T/5 (overdamped, no
//! overshoot), so that the small jumps of a command that is itself sampled ask for little torque. What the command's own
//! rotation takes of the acceleration (rate x relative rate) is set aside beforehand.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::settings::ControllerSettings;
use crate::attitude::rotation::Attitude;

/// Angle from the command below which the reference becomes the command, in rad.
const CAUGHT_RAD: f64 = 1e-9;
/// Angle and rate from the command, in rad and rad/s, below which the reference counts as settled.
const SETTLED: f64 = 1e-5;
/// Time constant T of the approach, in samples.
const APPROACH_SAMPLES: f64 = 50.0;
/// Time constant of the rate, in samples; below a fourth of the approach's for no overshoot.
const LAG_SAMPLES: f64 = 10.0;

/// Target of the controller.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ControlTarget {
    /// An attitude that turns at a rate.
    Attitude {
        /// EME2000 to commanded frame, at the sample.
        attitude: Attitude,
        /// Its rate in its own axes, in rad/s.
        rate_body_rad_s: Vector3<f64>,
    },
    /// A rate in body axes; the attitude is free.
    RateOnly {
        /// In rad/s.
        rate_body_rad_s: Vector3<f64>,
    },
}

/// The reference at a sample, and its acceleration up to the next.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReferenceSample {
    /// EME2000 to reference frame.
    pub attitude: Attitude,
    /// In the reference's axes, in rad/s.
    pub rate_body_rad_s: Vector3<f64>,
    /// Derivative of the rate in the reference's axes, in rad/s2.
    pub acceleration_body_rad_s2: Vector3<f64>,
}

/// The reference attitude at the next sample.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Reference {
    /// EME2000 to reference frame.
    pub attitude: Attitude,
    /// In the reference's axes, in rad/s.
    pub rate_body_rad_s: Vector3<f64>,
    /// Whether it has reached the command, within 1e-5 rad and 1e-5 rad/s.
    pub is_settled: bool,
}

impl Reference {
    /// At an attitude and a rate, on the way to whatever is commanded.
    pub fn new(attitude: Attitude, rate_body_rad_s: Vector3<f64>) -> Self {
        Self { attitude, rate_body_rad_s, is_settled: false }
    }

    /// Rejects decoded states that no simulation can produce.
    pub fn is_valid(&self) -> bool {
        self.attitude.is_rotation()
    }

    /// The reference at this sample; moves on to the next.
    pub fn step(&mut self, target: &ControlTarget, settings: &ControllerSettings) -> ReferenceSample {
        let interval_s = settings.interval_s();
        let [slew_rad_s, acceleration_rad_s2] = [settings.slew_rate_rad_s, settings.slew_acceleration_rad_s2]
            .map(|limit| if limit > 0.0 { limit } else { f64::INFINITY });
        let change_rad_s = match target {
            ControlTarget::RateOnly { rate_body_rad_s } => {
                let requested = rate_body_rad_s - self.rate_body_rad_s;
                let greatest = acceleration_rad_s2 * interval_s;
                self.is_settled = requested.norm() <= greatest;
                if self.is_settled { requested } else { requested * (greatest / requested.norm()) }
            }
            ControlTarget::Attitude { attitude, rate_body_rad_s } => {
                let from_command = attitude.rotation_vector_to(&self.attitude);
                let command_rate = self.attitude.to_body(&attitude.to_inertial(rate_body_rad_s));
                let relative_rate = self.rate_body_rad_s - command_rate;
                let has_no_limit = slew_rad_s.is_infinite() && acceleration_rad_s2.is_infinite();
                let (angle, rate) = (from_command.norm(), relative_rate.norm());
                let caught_rad_s = CAUGHT_RAD / (APPROACH_SAMPLES * interval_s);
                let is_caught =
                    angle <= CAUGHT_RAD && rate <= caught_rad_s.min(acceleration_rad_s2 * interval_s);
                self.is_settled = has_no_limit || is_caught || (angle <= SETTLED && rate <= SETTLED);
                if has_no_limit || is_caught {
                    self.attitude = *attitude;
                    self.rate_body_rad_s = *rate_body_rad_s;
                    Vector3::zeros()
                } else {
                    RelativeMotion { from_command, relative_rate, command_rate, interval_s }
                        .change_rad_s(slew_rad_s, acceleration_rad_s2)
                }
            }
        };
        let now = ReferenceSample {
            attitude: self.attitude,
            rate_body_rad_s: self.rate_body_rad_s,
            acceleration_body_rad_s2: change_rad_s / interval_s,
        };
        let mean_rate = self.rate_body_rad_s + change_rad_s * 0.5;
        self.attitude = self.attitude.propagated(mean_rate, interval_s).normalized();
        self.rate_body_rad_s += change_rad_s;
        now
    }
}

/// Motion of the reference relative to the command, in the reference's axes.
struct RelativeMotion {
    /// Rotation vector from the command to the reference, in rad.
    from_command: Vector3<f64>,
    /// In rad/s.
    relative_rate: Vector3<f64>,
    /// In rad/s.
    command_rate: Vector3<f64>,
    interval_s: f64,
}

impl RelativeMotion {
    /// Change of the reference's rate over the interval, in rad/s.
    fn change_rad_s(&self, slew_rad_s: f64, acceleration_rad_s2: f64) -> Vector3<f64> {
        let dt = self.interval_s;
        let turning = self.command_rate.norm();
        let (slew_rad_s, braking_rad_s2) = if turning > 0.0 && acceleration_rad_s2.is_finite() {
            let half = 0.5 * acceleration_rad_s2;
            (slew_rad_s.min(half / turning), acceleration_rad_s2 - half.min(turning * slew_rad_s))
        } else {
            (slew_rad_s, acceleration_rad_s2)
        };
        // Without a limit of the acceleration there is nothing to spread.
        let (approach_s, part) = if acceleration_rad_s2.is_finite() {
            (APPROACH_SAMPLES * dt, LAG_SAMPLES.recip())
        } else {
            (dt, 1.0)
        };
        let ahead = self.from_command + self.relative_rate * (0.5 * dt);
        let distance = ahead.norm();
        // a (sqrt(T^2 + 2 d/a) - T), which also serves a = infinity.
        let root_s = (approach_s * approach_s + 2.0 * distance / braking_rad_s2).sqrt();
        let stopping = 2.0 * distance / (approach_s + root_s);
        let requested =
            if distance > 0.0 { ahead * (-stopping.min(slew_rad_s) / distance) } else { Vector3::zeros() };
        let change = (requested - self.relative_rate) * part;
        // The command's rate, fixed in its own frame, moves in the reference's axes.
        let carried = self.command_rate.cross(&self.relative_rate) * dt;
        limited_sum(&change, &carried, acceleration_rad_s2 * dt)
    }
}

/// `carried` plus as much of `change` as keeps the sum within `greatest`.
fn limited_sum(change: &Vector3<f64>, carried: &Vector3<f64>, greatest: f64) -> Vector3<f64> {
    let sum = change + carried;
    if sum.norm() <= greatest {
        return sum;
    }
    let room = greatest * greatest - carried.norm_squared();
    if room <= 0.0 {
        return sum * (greatest / sum.norm());
    }
    let (square, cross) = (change.norm_squared(), change.dot(carried));
    let part = ((cross * cross + square * room).sqrt() - cross) / square;
    carried + change * part.min(1.0)
}

//! Quaternion feedback with rate and integral terms, at a fixed sample rate.
//!
//! Torque on the body over the interval that begins at a sample:
//! T = J a + w x (J w + h) - known external torque, with the acceleration
//! a = reference's - kd rate error - kp 2 sgn(q4) q - ki integral of 2 sgn(q4) q (Wie, "Space Vehicle Dynamics and
//! Control", quaternion feedback), q from the reference to the estimate, h the wheels' momentum, and w and the total
//! momentum in the middle of the interval, so that what a sample holds is its mean to second order.

use nalgebra::{Matrix3, Vector3};
use serde::{Deserialize, Serialize};

use super::estimator::Estimate;
use super::reference::{ControlTarget, Reference};
use super::settings::ControllerSettings;
use crate::attitude::rotation::Attitude;

/// The reference begins anew at the estimate where the error asks for this many times the slew acceleration.
const LOST_REFERENCE: f64 = 2.0;

/// State of the controller from one sample to the next.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ControllerState {
    reference: Reference,
    /// Integral of the angle error, in rad s, body frame.
    integral_rad_s: Vector3<f64>,
    /// Integral of the rate error while only a rate is commanded, in rad.
    drift_rad: Vector3<f64>,
    /// Rate error of the last sample with only a rate commanded, in rad/s.
    last_rate_error_rad_s: Vector3<f64>,
    /// Torque that the last sample requested, in N m, body frame.
    requested_body_n_m: Vector3<f64>,
    /// Part of it that the wheels could not give, in N m, body frame.
    missing_body_n_m: Vector3<f64>,
    /// Whether the reference continues from the last sample.
    has_reference: bool,
    was_valid: bool,
    was_rate_only: bool,
    attitude_error_rad: f64,
}

/// Error of the estimate against the reference, and the reference's motion, in estimated body axes.
struct Tracking {
    angle_rad: Vector3<f64>,
    rate_rad_s: Vector3<f64>,
    acceleration_rad_s2: Vector3<f64>,
}

impl ControllerState {
    /// Before the first sample, with the reference where the body is.
    pub fn new(attitude: Attitude, rate_body_rad_s: Vector3<f64>) -> Self {
        Self {
            reference: Reference::new(attitude, rate_body_rad_s),
            has_reference: true,
            was_valid: true,
            ..Self::default()
        }
    }

    /// Rejects decoded states that no simulation can produce.
    pub fn is_valid(&self) -> bool {
        self.reference.is_valid()
    }

    /// One sample: the torque that the wheels are to exert on the body over the interval that begins now, in N m, body
    /// frame. Without a rate in the estimate it is zero and the integral is kept.
    ///
    /// `wheels_body_n_m_s` is the wheels' momentum relative to the body, `external_body_n_m` an external torque that is
    /// known beforehand. What the body feels of motors is exact with the inertia without the rotors' axial parts and the
    /// wheels' momentum with theirs; with the inertia of the body and its rotors the acceleration is off by their ratio.
    #[allow(clippy::too_many_arguments, reason = "what a sample reads: settings, command, measurements")]
    pub fn sample(
        &mut self,
        settings: &ControllerSettings,
        inertia_body_kg_m2: &Matrix3<f64>,
        target: &ControlTarget,
        estimate: &Estimate,
        wheels_body_n_m_s: &Vector3<f64>,
        external_body_n_m: &Vector3<f64>,
    ) -> Vector3<f64> {
        let missing_body_n_m = core::mem::take(&mut self.missing_body_n_m);
        self.requested_body_n_m = Vector3::zeros();
        let Some(rate) = estimate.rate_body_rad_s else {
            self.has_reference = false;
            return Vector3::zeros();
        };
        self.keep_reference(target, estimate, &rate);
        let gains = settings.gains();
        let is_limited = missing_body_n_m != Vector3::zeros();
        let mut tracking = self.track(settings, target, estimate, &rate, is_limited);
        let greatest_rad = LOST_REFERENCE * settings.slew_acceleration_rad_s2 / gains.proportional_1_s2;
        let may_begin_anew = settings.slew_acceleration_rad_s2 > 0.0 && !settings.keeps_reference;
        if may_begin_anew && tracking.angle_rad.norm() > greatest_rad {
            self.begin_reference(&estimate.attitude, &rate);
            tracking = self.track(settings, target, estimate, &rate, is_limited);
        }
        // More of the integral would ask for more of what is missing.
        if !is_limited || (inertia_body_kg_m2 * tracking.angle_rad).dot(&missing_body_n_m) > 0.0 {
            self.integrate(settings, &tracking.angle_rad);
        }
        let acceleration = tracking.acceleration_rad_s2
            - tracking.rate_rad_s * gains.rate_1_s
            - tracking.angle_rad * gains.proportional_1_s2
            - self.integral_rad_s * gains.integral_1_s3;
        let gyroscopic = {
            let half_s = 0.5 * settings.interval_s();
            let middle_rate = rate + tracking.acceleration_rad_s2 * half_s;
            let momentum = inertia_body_kg_m2 * rate + wheels_body_n_m_s;
            middle_rate.cross(&(momentum - rate.cross(&momentum) * half_s))
        };
        self.requested_body_n_m = inertia_body_kg_m2 * acceleration + gyroscopic - external_body_n_m;
        self.requested_body_n_m
    }

    /// Other actuators give the torque from the next sample on: what the integral holds against the old ones is void.
    pub fn change_actuators(&mut self) {
        self.integral_rad_s = Vector3::zeros();
        self.missing_body_n_m = Vector3::zeros();
    }

    /// Tells that of the last torque only this could be given: at the next sample the integral does not grow toward
    /// what is missing.
    pub fn limited(&mut self, given_body_n_m: &Vector3<f64>) {
        self.missing_body_n_m = self.requested_body_n_m - given_body_n_m;
    }

    /// Measures the error of the estimate at the last sample, which only a report needs.
    pub fn measure_error(&mut self, target: &ControlTarget, estimated: &Attitude) {
        self.attitude_error_rad = match target {
            ControlTarget::Attitude { attitude, .. } => attitude.rotation_vector_to(estimated).norm(),
            ControlTarget::RateOnly { .. } => 0.0,
        };
    }

    /// Angle between the estimated and the commanded attitude where it was measured last, in rad; 0 where only a rate is commanded.
    pub fn attitude_error_rad(&self) -> f64 {
        self.attitude_error_rad
    }

    /// Whether the reference has reached the command.
    pub fn is_settled(&self) -> bool {
        self.reference.is_settled
    }

    /// Begins the reference anew where it does not lead on from the last sample.
    fn keep_reference(&mut self, target: &ControlTarget, estimate: &Estimate, rate: &Vector3<f64>) {
        let is_rate_only = matches!(target, ControlTarget::RateOnly { .. });
        let is_regained = estimate.is_valid && !self.was_valid;
        let is_new_kind = is_rate_only != self.was_rate_only;
        if !self.has_reference || (is_regained && !is_rate_only) || (is_new_kind && !is_rate_only) {
            self.begin_reference(&estimate.attitude, rate);
        }
        if is_new_kind {
            self.drift_rad = Vector3::zeros();
            self.last_rate_error_rad_s = rate - self.reference.rate_body_rad_s;
        }
        self.has_reference = true;
        self.was_valid = estimate.is_valid;
        self.was_rate_only = is_rate_only;
    }

    fn begin_reference(&mut self, attitude: &Attitude, rate_rad_s: &Vector3<f64>) {
        self.reference = Reference::new(*attitude, *rate_rad_s);
        self.drift_rad = Vector3::zeros();
        self.last_rate_error_rad_s = Vector3::zeros();
    }

    /// Moves the reference on and compares the estimate with it.
    fn track(
        &mut self,
        settings: &ControllerSettings,
        target: &ControlTarget,
        estimate: &Estimate,
        rate: &Vector3<f64>,
        is_limited: bool,
    ) -> Tracking {
        let reference = self.reference.step(target, settings);
        match target {
            ControlTarget::Attitude { .. } => {
                let relative = reference.attitude.inverse().then(&estimate.attitude);
                let [x, y, z, _] = relative.quaternion(None);
                let requested = relative.to_body(&reference.rate_body_rad_s);
                let rate_rad_s = rate - requested;
                let acceleration_rad_s2 =
                    relative.to_body(&reference.acceleration_body_rad_s2) - rate_rad_s.cross(&requested);
                Tracking { angle_rad: Vector3::new(x, y, z) * 2.0, rate_rad_s, acceleration_rad_s2 }
            }
            ControlTarget::RateOnly { .. } => {
                let error = rate - reference.rate_body_rad_s;
                if !is_limited {
                    // The angle that a constant acceleration over the last interval leaves, without an attitude.
                    self.drift_rad += (self.last_rate_error_rad_s + error) * (0.5 * settings.interval_s());
                }
                self.last_rate_error_rad_s = error;
                Tracking {
                    angle_rad: self.drift_rad,
                    rate_rad_s: error,
                    acceleration_rad_s2: reference.acceleration_body_rad_s2,
                }
            }
        }
    }

    /// Adds to the integral of the angle, which asks for no more than the slew acceleration.
    fn integrate(&mut self, settings: &ControllerSettings, angle_rad: &Vector3<f64>) {
        let gain = settings.gains().integral_1_s3;
        if gain == 0.0 {
            return;
        }
        self.integral_rad_s += angle_rad * settings.interval_s();
        let greatest = settings.slew_acceleration_rad_s2 / gain;
        let size = self.integral_rad_s.norm();
        if greatest > 0.0 && size > greatest {
            self.integral_rad_s *= greatest / size;
        }
    }
}

//! The passive nutation damper as an energy sink that conserves angular momentum.
//!
//! Paper 002 gives one number: the nutation angle falls to 1/e in 9.5 h. A torque D between body and damper,
//! perpendicular to the momentum H, turns H in the body toward the spin axis; what the damper's fluid stores then
//! moves the body so that H stays where it is in inertial space:
//!
//! ```text
//! dh/dt = h x w + T + D,    D = G (e3 |h|^2 - h h3),    w_body = J^-1 h + G (e3 x h)
//! ```
//!
//! About the axis of greatest inertia the angle phi from the nearest pole obeys phi' = -phi/tau exactly. About any
//! other axis it grows, phi' = sin(phi) cos(phi)/tau, and ends in a flat spin: the form of a damper driven by the
//! accelerations of nutation, smooth at 90 deg.

use crate::attitude::Inertia;
use crate::math;
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

/// Least 1/e time of a damper, in s.
pub const SHORTEST_TIME_CONSTANT_S: f64 = 1.0;

/// A nutation damper on a given body.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Damper {
    /// 1/tau, 0 without a damper.
    pub rate_1_s: f64,
    grows: bool,
}

impl Damper {
    /// A damper of 1/e time `time_constant_s` of the nutation angle; 0 means none.
    pub fn new(time_constant_s: f64, inertia: &Inertia) -> Self {
        let rate_1_s = if time_constant_s > 0.0 { time_constant_s.recip() } else { 0.0 };
        Self { rate_1_s, grows: !inertia.spins_about_major_axis() }
    }

    /// The same damper on another body.
    #[must_use]
    pub fn on(&self, inertia: &Inertia) -> Self {
        Self { grows: !inertia.spins_about_major_axis(), ..*self }
    }

    /// Whether a decoded damper can be one.
    pub fn is_valid(&self) -> bool {
        (0.0..=SHORTEST_TIME_CONSTANT_S.recip()).contains(&self.rate_1_s)
    }

    /// Whether there is one.
    pub fn acts(&self) -> bool {
        self.rate_1_s != 0.0
    }

    /// G of the module's equation, in 1/(N m s2), for the momentum `h` in body components.
    pub fn gain(&self, h: &Vector3<f64>) -> f64 {
        let across = math::hypot(h.x, h.y);
        let norm = math::hypot(across, h.z);
        if self.rate_1_s == 0.0 || norm == 0.0 {
            return 0.0;
        }
        if self.grows {
            return -self.rate_1_s * h.z / (norm * norm);
        }
        let pole_angle = math::atan2(across, h.z.abs());
        let sine = across / norm;
        let shape = if sine < 1e-4 { 1.0 + sine * sine / 6.0 } else { pole_angle / sine };
        (self.rate_1_s * shape / norm).copysign(h.z)
    }

    /// Angle from the nearest pole, `dt_s` after it was `angle_rad`, with no torque on an axisymmetric body.
    pub fn angle_after_rad(&self, angle_rad: f64, dt_s: f64) -> f64 {
        let x = self.rate_1_s * dt_s;
        if self.grows {
            let (sine, cosine) = math::sin_cos(angle_rad);
            // e^-x on the cosine instead of e^x on the sine: no overflow, and exact at both ends.
            return math::atan2(sine, cosine * math::exp(-x));
        }
        angle_rad * math::exp(-x)
    }

    /// Integral of cos(angle) over `dt_s` from `angle_rad`, in s, with no torque on an axisymmetric body.
    pub fn cosine_integral_s(&self, angle_rad: f64, dt_s: f64) -> f64 {
        if self.rate_1_s == 0.0 {
            return dt_s * math::cos(angle_rad);
        }
        let x = self.rate_1_s * dt_s;
        if self.grows {
            return growing_integral(angle_rad, x) / self.rate_1_s;
        }
        // cos(a u) with u = e^-s, s from 0 to x: sum over k of (-1)^k a^2k (1 - u^2k) / ((2k)! 2k).
        let square = angle_rad * angle_rad;
        let first = -math::exp_m1(-2.0 * x);
        let (mut term, mut missing, mut sum) = (1.0, first, 0.0);
        for k in 1..=16_u32 {
            let even = f64::from(2 * k);
            term *= -square / (even * (even - 1.0));
            let part = term * missing / even;
            sum += part;
            if part.abs() <= 1e-18 * x.abs() {
                break;
            }
            missing += (1.0 - missing) * first;
        }
        dt_s + sum / self.rate_1_s
    }
}

/// Integral over s from 0 to x of cos(phi), where tan(phi) = tan(a) e^s.
fn growing_integral(angle_rad: f64, x: f64) -> f64 {
    let (sine, cosine) = math::sin_cos(angle_rad);
    if x < 1.0 && cosine > 1e-3 {
        // x + ln[(1 + sec a) / (1 + sec phi)], written without cancellation.
        let tangent = sine / cosine;
        let (secant, secant_end) = (cosine.recip(), math::hypot(tangent * math::exp(x), 1.0));
        let difference = -tangent * tangent * math::exp_m1(2.0 * x) / (secant + secant_end);
        return x + math::ln_1p(difference / (1.0 + secant_end));
    }
    if sine == 0.0 {
        return x;
    }
    let cotangent = cosine / sine;
    math::asinh(cotangent) - math::asinh(cotangent * math::exp(-x))
}

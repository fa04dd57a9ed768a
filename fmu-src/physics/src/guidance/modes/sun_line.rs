//! The line from the spacecraft to the Sun as guidance knows it, propagated by its rate.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::guidance_command::GuidanceCommand;
use crate::attitude::{Attitude, SunAngles};
use crate::guidance::geometry::moving::{MovingVector, rate, value};
use crate::math;
use crate::numerics::scalar::{Dual64, Scalar};

/// The line to the Sun, EME2000; zero while it is not known.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SunLine {
    /// In m.
    to_sun_m: Vector3<f64>,
    /// In m/s.
    rate_m_s: Vector3<f64>,
    /// When, in s.
    since_s: f64,
}

impl SunLine {
    /// At `time_s`.
    pub fn new(to_sun: &MovingVector, time_s: f64) -> Self {
        Self { to_sun_m: value(to_sun), rate_m_s: rate(to_sun), since_s: time_s }
    }

    fn at(&self, time_s: f64) -> Option<Vector3<f64>> {
        let to_sun_m = self.to_sun_m + self.rate_m_s * (time_s - self.since_s);
        (to_sun_m != Vector3::zeros()).then_some(to_sun_m)
    }

    /// Azimuth and elevation of the Sun in the frame of `attitude` at `time_s`; both 0 while it is not known.
    pub fn angles_at(&self, attitude: &Attitude, time_s: f64) -> SunAngles {
        let to_body = attitude.inertial_from_body().inverse();
        self.at(time_s)
            .map_or_else(SunAngles::default, |to_sun_m| SunAngles::from_direction(&(to_body * to_sun_m)))
    }

    /// Their rates under a command, in rad/s.
    pub fn angle_rates_at(&self, command: &GuidanceCommand, time_s: f64) -> [f64; 2] {
        let Some(to_sun_m) = self.at(time_s) else { return [0.0; 2] };
        let to_body = command.attitude_at(time_s).inertial_from_body().inverse();
        let sun_body = to_body * to_sun_m;
        let rate_body = to_body * self.rate_m_s - command.rate_body_rad_s.cross(&sun_body);
        let [x, y, z] = [0, 1, 2].map(|i| Dual64::new(sun_body[i], rate_body[i]));
        let across = Dual64::constant(math::hypot(sun_body.x, sun_body.y));
        let across = if across.re > 0.0 {
            Dual64::new(across.re, (x * x.eps + y * y.eps).re / across.re)
        } else {
            across
        };
        [Dual64::polar_angle(x, -y).eps, Dual64::polar_angle(-z, across).eps]
    }
}

//! Sun sensors with a conical field of view, and the direction of the Sun that they give together.

use nalgebra::Vector3;

use crate::attitude::angles::angle_between_rad;
use crate::math;
use crate::numerics::noise::{Channel, normal_vector};

/// Far above the rounding of a unit vector's components.
const ROUNDING: f64 = 1e-9;

/// One Sun sensor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SunSensor {
    /// Unit vector of the boresight.
    pub axis_body: Vector3<f64>,
    /// Half angle of the cone in which it sees the Sun, in rad.
    pub half_field_of_view_rad: f64,
    /// Standard deviation of the measured direction about each of two axes across it, in rad.
    pub noise_rad: f64,
}

impl SunSensor {
    /// Whether the Sun is in its field of view.
    pub fn sees(&self, sun_body: &Vector3<f64>) -> bool {
        // 1 - h^2 / 2 <= cos h <= 1 - h^2 / 2 + h^4 / 24: the angle itself is needed near the cone alone.
        let (cosine, square) = (self.axis_body.dot(sun_body), math::powi(self.half_field_of_view_rad, 2));
        let least = 1.0 - 0.5 * square;
        if cosine < least - ROUNDING {
            return false;
        }
        if cosine > least + square * square / 24.0 + ROUNDING {
            return true;
        }
        angle_between_rad(&self.axis_body, sun_body) <= self.half_field_of_view_rad
    }

    /// Measured direction of the Sun, `sun_body` being the true unit vector.
    fn measured(&self, number: usize, sun_body: &Vector3<f64>, seed: u64, sample: u64) -> Vector3<f64> {
        if self.noise_rad == 0.0 {
            return *sun_body;
        }
        let channel = Channel::SunSensorDirection(u16::try_from(number).unwrap_or(u16::MAX));
        let drawn = normal_vector(seed, channel, sample) * self.noise_rad;
        (sun_body + drawn - sun_body * sun_body.dot(&drawn)).normalize()
    }
}

/// Unit mean of what those sensors measure that work and see the Sun; `None` where none does, or the Sun is eclipsed
/// entirely. `sun_body` is a unit vector, noise the draw of that sample by the seed.
pub fn sensed_sun(
    sensors: &[SunSensor],
    failed: impl Fn(usize) -> bool,
    sun_body: &Vector3<f64>,
    lit_fraction: f64,
    (seed, sample): (u64, u64),
) -> Option<Vector3<f64>> {
    if lit_fraction <= 0.0 {
        return None;
    }
    let seeing = sensors.iter().enumerate().filter(|(k, sensor)| !failed(*k) && sensor.sees(sun_body));
    let sum: Vector3<f64> = seeing.map(|(k, sensor)| sensor.measured(k, sun_body, seed, sample)).sum();
    sum.try_normalize(0.0)
}

//! Environment of a spacecraft: time, ephemerides, orbits, eclipse, atmosphere, magnetic field.

pub mod atmosphere;
pub mod bodies_from_center;
pub mod coarse_ephemeris;
pub mod eclipse;
pub mod ephemeris;
pub mod frames;
pub mod geodetic;
pub mod kepler_planet;
pub mod magnetic_field;
pub mod onboard;
pub mod orbit;
pub mod orientation;
pub mod sun;
pub mod time;
pub mod utc;

pub use crate::toml::dates;

use core::ops::{Add, Sub};

use nalgebra::{Matrix3, Vector3};
use serde::{Deserialize, Serialize};

/// Position and velocity in one inertial frame relative to one centre.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct CartesianState {
    /// Position, m.
    pub position_m: Vector3<f64>,
    /// Velocity, m/s.
    pub velocity_m_s: Vector3<f64>,
}

impl CartesianState {
    /// On a circle of `radius_m` about a centre of gravitational parameter `mu_m3_s2`, at the first axis.
    pub fn on_circle(radius_m: f64, mu_m3_s2: f64) -> Self {
        Self {
            position_m: Vector3::x() * radius_m,
            velocity_m_s: Vector3::y() * (mu_m3_s2 / radius_m).sqrt(),
        }
    }

    /// Returns the state after `span_s` of even motion.
    #[must_use]
    pub fn moved_evenly(self, span_s: f64) -> Self {
        Self { position_m: self.position_m + self.velocity_m_s * span_s, ..self }
    }

    /// Position times velocity, m2/s, the radius times its rate: it rises through zero at periapsis.
    pub fn radial_m2_s(&self) -> f64 {
        self.position_m.dot(&self.velocity_m_s)
    }

    /// The same along other axes.
    pub fn along(&self, dcm: &Matrix3<f64>) -> Self {
        Self { position_m: dcm * self.position_m, velocity_m_s: dcm * self.velocity_m_s }
    }
}

impl Add for CartesianState {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        let Self { position_m, velocity_m_s } = other;
        Self { position_m: self.position_m + position_m, velocity_m_s: self.velocity_m_s + velocity_m_s }
    }
}

impl Sub for CartesianState {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        let Self { position_m, velocity_m_s } = other;
        Self { position_m: self.position_m - position_m, velocity_m_s: self.velocity_m_s - velocity_m_s }
    }
}

//! Where everything is and what light falls there: time, ephemerides, orbits, eclipse.

pub mod eclipse;
pub mod ephemeris;
pub mod frames;
pub mod orbit;
pub mod paper004;
pub mod sun;
pub mod time;

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

/// Position and velocity in one inertial frame relative to one centre.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct CartesianState {
    /// Position, m.
    pub position_m: Vector3<f64>,
    /// Velocity, m/s.
    pub velocity_m_s: Vector3<f64>,
}

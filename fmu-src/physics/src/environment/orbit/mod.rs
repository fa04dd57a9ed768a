//! Spacecraft orbits: Kepler's equation, elements and state, two-body motion in closed form, disturbed motion integrated.

mod deviation;
mod disturbed;
#[cfg(test)]
mod disturbed_tests;
mod elements;
pub mod kepler;
mod two_body;

pub use disturbed::{DisturbedOrbit, Flattening, Gravity, OrbitIntegrationError, OrbitMethod, tide_m_s2};
pub use elements::{Elements, OrbitError, period_s, semi_major_axis_m};
pub use two_body::TwoBodyOrbit;

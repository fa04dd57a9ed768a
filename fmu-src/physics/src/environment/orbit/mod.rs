//! Spacecraft orbits: Kepler's equation, elements and state, two-body motion in closed form, arcs between places, disturbed motion integrated, about one
//! body or between several.

mod b_plane;
mod deviation;
mod disturbed;
#[cfg(test)]
mod disturbed_tests;
mod elements;
mod first_fall;
mod gravity;
pub mod kepler;
mod lambert;
mod n_body;
#[cfg(test)]
mod n_body_tests;
mod orbit_method;
mod transition;
#[cfg(test)]
mod transition_tests;
mod two_body;

pub use b_plane::BPlane;
pub use disturbed::{DisturbedOrbit, OrbitIntegrationError};
pub use elements::{Elements, OrbitError, period_s, semi_major_axis_m};
pub use gravity::{Flattening, Gravity, Tides, tide_m_s2};
pub use lambert::{LambertArc, LambertBranch, LambertError, LambertVelocities};
pub use n_body::{BodyEphemeris, Collision, NBodyGravity, NBodySettings};
pub use orbit_method::OrbitMethod;
pub use transition::{Partials, partials_over, transition};
pub use two_body::TwoBodyOrbit;

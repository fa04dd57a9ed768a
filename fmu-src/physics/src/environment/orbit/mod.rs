//! Spacecraft orbits: Kepler's equation, elements and state, two-body motion in closed form, and motion integrated under a list
//! of what attracts, about one body or between several.

mod b_plane;
mod deviation;
mod disturbed;
#[cfg(test)]
mod disturbed_tests;
mod elements;
mod gravity;
mod gravity_model;
mod integration_center;
pub mod kepler;
mod n_body;
#[cfg(test)]
mod n_body_tests;
mod orbit_method;
mod spheres;
mod two_body;

pub use b_plane::BPlane;
pub use disturbed::{DisturbedOrbit, OrbitIntegrationError};
pub use elements::{Elements, OrbitError, check, check_mu, period_s, semi_major_axis_m};
pub use gravity::{Flattening, Gravity};
pub use gravity_model::{Attractor, BodyEphemeris, GravityModel};
pub use n_body::{NBodyGravity, NBodySettings};
pub use orbit_method::{OrbitMethod, TERMS};
pub use spheres::Collision;
pub use two_body::TwoBodyOrbit;

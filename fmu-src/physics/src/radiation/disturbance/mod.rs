//! Everything light and heat do to a spacecraft, by effect: solar, albedo, infrared, thermal recoil.
//!
//! [`DisturbanceModel::evaluate`] is the one call: geometry in, force and torque by effect and by face out. It is
//! generic over the number type, so that dual numbers give exact derivatives by any part of the geometry.

mod face_loads;
mod geometry;
mod model;
mod planet_rule;
mod workspace;

#[cfg(test)]
mod heat_tests;
#[cfg(test)]
mod paper_tests;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod whole_tests;

pub use geometry::{Geometry, PlanetGeometry, Recoil};
pub use model::{DisturbanceModel, Options};
pub use planet_rule::PlanetLightMethod;
pub use workspace::{FaceResult, Workspace};

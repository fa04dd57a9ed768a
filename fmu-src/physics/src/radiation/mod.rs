//! Light on surfaces: the flat-plate law, solar, planet light, thermal recoil, shadowing -> force and torque by source.
//!
//! Light that arrives ([`flat_plate::Beam`], [`flat_plate::ReceivedLight`]), the surface that receives it
//! ([`crate::spacecraft::Plate`] and its kin) and the law that turns one into force ([`flat_plate::force_per_area_pa`])
//! are separate ideas. Everything is generic over [`crate::numerics::scalar::Scalar`], in the body frame, SI.

pub mod cylinder;
pub mod disturbance;
pub(crate) mod faces;
pub mod flat_plate;
pub mod grid;
pub mod planet_light;
pub mod polynomial;
pub mod ring;
pub mod shadow;
pub mod solar;
pub mod thermal;

#[cfg(test)]
mod cylinder_tests;
#[cfg(test)]
mod polynomial_tests;
#[cfg(test)]
mod solar_tests;

pub use flat_plate::Beam;
pub use planet_light::PlanetLight;
pub use polynomial::{TorquePolynomial, polynomial_valid};
pub use solar::SolarModel;

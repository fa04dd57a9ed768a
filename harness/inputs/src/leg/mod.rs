//! Leg files: departure and encounter of a leg.

mod aimpoint;
pub mod file;
pub mod keys;

pub use aimpoint::FlybyAimpoint;
pub use keys::ArcBranch;

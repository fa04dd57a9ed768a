//! Leg files: departure and encounter of a leg.

mod aimpoint;
pub mod description;
pub mod file;
pub mod schema;

pub use aimpoint::FlybyAimpoint;
pub use description::ArcBranch;

//! Encounters of a recorded flight: what its B-plane depends on, at any time before, and what a miss costs behind it.

pub mod aimpoint;
pub mod controls;
pub mod dispersion;
pub mod encounter;
pub mod flight;
mod light;
pub mod maneuvers;
pub mod miss;
pub mod report;
pub mod sensitivity;
mod task;
#[cfg(test)]
mod test_flight;

pub use aimpoint::BPlaneAimpoint;
pub use encounter::Encounter;
pub use flight::ForceModel;
pub use sensitivity::Sensitivity;
pub use task::FlybyTask;

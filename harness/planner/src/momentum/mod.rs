//! Momentum that sunlight's torque can hold: what downlinks of a recorded mission attain, and optimal plans of arrays and attitudes.

mod as_it_is;
pub mod attainable;
pub mod baseline;
pub(crate) mod cell;
pub(crate) mod controls;
mod counted;
pub mod encountered;
mod formulation;
pub mod in_force;
mod linear_torque;
mod mission;
mod model;
pub mod places;
pub mod plan;
mod planned;
pub mod plant;
mod program;
pub mod refit_file;
mod region;
mod relaxed;
pub mod report;
pub mod simulated;
pub mod target;
#[cfg(test)]
pub(crate) mod test_spacecraft;
pub mod torque;
mod window;
pub mod windows;

pub use mission::{HoldableDays, Mission};
pub use model::Limit;
pub use physics::momentum::Convention;
pub use region::{Point, Region};

//! Momentum that sunlight's torque can hold: what downlinks of a recorded mission attain, and optimal plans of arrays and attitudes.

pub mod baseline;
mod counted;
pub mod flown;
mod mission;
mod model;
pub mod plan;
mod program;
pub mod refit_file;
mod region;
pub mod report;
#[cfg(test)]
mod test_craft;
pub mod torque;
pub mod windows;

pub use mission::{Held, Mission};
pub use model::Limit;
pub use region::{Point, Region};

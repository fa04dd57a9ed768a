//! From flight to output variables.

pub mod dynamic;
mod propulsion;
mod write;

pub use write::{derivative, failure, flyable, log_dump, write, write_calculated, write_ideal, write_plates};

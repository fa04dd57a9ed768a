//! Constraints of a pointing: the zone of the Sun, the hot pole, and turns within the zone.

pub mod command_slew;
pub mod constrained;
#[cfg(test)]
pub(crate) mod constraint_tests;
pub mod hot_pole;
pub mod keep_in;
pub mod slew;

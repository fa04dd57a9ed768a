//! Legs: the velocity at a place and date that leads to an encounter with a planet, by Lambert's arc and shooting.

mod aimpoint;
mod approach;
pub mod report;
mod shooting;
#[cfg(test)]
mod tests;

pub use aimpoint::{Flyby, b_m, closest_distance_m, impact_parameter_m};
pub use approach::{Approach, ApproachRow, Encounter};
pub use shooting::{Leg, LegError, LegTask, MAX_LEG_S, SimulatesLeg, shoot};

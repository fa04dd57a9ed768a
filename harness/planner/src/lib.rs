//! Optimal plans, what an encounter depends on, ephemerides to carry, what a history of momentum says of a spacecraft, and how long downlinks can hold it.
//!
//! The planner is the only part of the harness that uses the physics directly: it searches with the fast linear
//! theory, then runs what it found through the FMU, which knows nothing of the planner.
#![cfg_attr(test, allow(clippy::disallowed_methods, reason = "tests make their own files"))]

pub mod ephemeris;
pub mod flyby;
pub mod leg;
pub mod map;
pub mod momentum;
pub mod orbit;
pub mod plans;
pub mod refit;
mod simulation;
pub mod size;
pub mod spin;
mod text_table;
pub mod torque_map;

/// Reason why something could not be planned.
pub type Failure = Box<dyn std::error::Error>;

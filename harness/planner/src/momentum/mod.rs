//! Momentum that sunlight's torque during downlinks can hold: a recorded mission, and what is attainable in the plane of X and Z.

mod mission;
mod region;

pub use mission::{Held, Mission};
pub use region::{Point, Region};

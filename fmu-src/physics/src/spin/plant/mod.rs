//! The spinner in flight: body, burn, outside commands and sensors, from edge to edge.

mod access;
mod commands;
mod propellant;
mod sensing;
mod sound;
mod start;
mod state;

pub use commands::{Commands, Directions, PulseCommand};
pub use start::{Start, StartError};
pub use state::{LEAST_WORK, MOST_WORK, MassSource, Plant, Sampling, SpinPlantError, StarSample};

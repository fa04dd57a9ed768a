//! The spinner in flight: body, burn, outside commands and sensors, from edge to edge.

mod commands;
mod directions;
mod outputs;
mod predictions;
mod propulsion;
mod sensors;
mod start;
mod state;
mod valves;

pub use crate::propulsion::PulseCommand;
pub use crate::spin::spinner::PulseExecution;
pub use commands::Commands;
pub use directions::Directions;
pub use outputs::{Bounds, Outputs, Rates, Violations};
pub use predictions::Predictions;
pub use propulsion::Propulsion;
pub use sensors::{Sensors, StarSample};
pub use start::{InitialConditions, LEAST_WORK, MOST_WORK, MassSource, Sampling, Start, StartError};
pub use state::{Plant, SpinPlantError};
pub use valves::Valves;

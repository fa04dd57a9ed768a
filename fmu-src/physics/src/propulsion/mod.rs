//! Thrusters in use: valves that open and close, propellant, and which thrusters give a torque.

mod propellant;
mod pulse_command;
mod selection;
mod valve;

pub use propellant::PropellantState;
pub use pulse_command::PulseCommand;
pub use selection::{Preference, SelectionError, ThrusterSelection};
pub use valve::Valve;

//! Modes, monitors, trust in ephemerides, and the guidance system that samples it all.

pub mod body_positions;
#[cfg(test)]
pub(crate) mod burn_tests;
pub mod command_status;
mod command_timers;
#[cfg(test)]
pub(crate) mod flight_tests;
pub mod guidance_command;
pub mod mode;
pub mod monitor;
pub mod sample_inputs;
pub mod sun_line;
pub mod system;
pub mod transitions;

//! Thrusters in use: valves that open and close, propellant, and which thrusters give a torque.

mod flow;
mod plume;
mod propellant;
mod pulse_schedule;
mod selection;
mod thrust_direction;
mod thrust_law;
mod valve;

pub use plume::surface_in_plume;
pub use propellant::PropellantState;
pub use pulse_schedule::{PulseCommand, PulseSchedule, due_s};
pub use selection::{Preference, SelectionError, ThrusterSelection};
pub use thrust_direction::ThrustErrors;
pub use thrust_law::ThrustLaw;
pub use valve::Valve;

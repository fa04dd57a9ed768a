//! Attitude manoeuvres of a spinner: which train of pulses turns it by an angle with the least nutation, and how often
//! to turn during months of antenna pointing (paper 002 and beyond).

mod burn_table;
mod campaign;
mod choice;
mod error;
mod flight;
mod limit_checks;
mod months;
mod options;
mod start_values;
mod started;
mod tables;
mod task;
mod text;
mod trade;
mod turn_geometry;
mod verification;

#[cfg(test)]
mod burn_tests;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod turn_geometry_tests;
#[cfg(test)]
mod verification_tests;

pub use burn_table::PlannedBurn;
pub use campaign::{Cadence, campaign, longest_interval_s, windows};
pub use error::PlanError;
pub use flight::{Pulse, SimulatedPlan, SpinSample};
pub use limit_checks::LimitCheck;
#[cfg(test)]
use options::ACE;
pub use options::{Options, TimingOption};
pub use start_values::toml as start_table;
pub use task::{Firing, Task, TaskLimits};
pub use text::{Answer, plan};
pub use trade::{TrainForecast, best, evaluate, frontier, timing_label, trade, uniform_plan};
pub use turn_geometry::{MAX_ANGLE_DEG, TurnGeometry, Way, right_ascension_declination_deg};
pub use verification::{Verification, verify};

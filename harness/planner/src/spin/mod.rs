//! Attitude manoeuvres of a spinner: which train of pulses turns it by an angle with the least nutation, and how often
//! to turn during months of antenna pointing (paper 002 and beyond).

mod burn_table;
mod campaign;
pub(crate) mod choice;
mod error;
pub(crate) mod flight;
pub(crate) mod limit_checks;
pub(crate) mod options;
pub(crate) mod start_values;
mod started;
mod task;
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
pub use options::{RightAscensionDeclination, TurnRequest};
pub use physics::{
    environment::dates::{ALLOWED_DATE, epoch_s},
    spin::forecast::Timing,
};
pub use task::{Actuator, Body, Firing, Task, TaskLimits};
pub use trade::{TrainForecast, best, evaluate, frontier, timing_label, trade, uniform_plan};
pub use turn_geometry::{MAX_ANGLE_DEG, TurnGeometry, Way, right_ascension_declination};
pub use verification::{Verification, verify};

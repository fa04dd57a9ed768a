//! Attitude manoeuvres of a spinner: which train of pulses turns it by an angle with the least nutation, and how often
//! to turn during months of antenna pointing (paper 002 and beyond).

mod campaign;
mod error;
mod options;
mod task;
mod text;
mod trade;
mod verification;

#[cfg(test)]
mod tests;
#[cfg(test)]
mod verification_tests;

pub use campaign::{Cadence, campaign, longest_interval_s, windows};
pub use error::PlanError;
#[cfg(test)]
use options::ACE;
pub use options::{Options, TimingOption};
pub use task::{Firing, MOST_ANGLE_DEG, Task, TaskLimits};
pub use text::plan;
pub use trade::{Row, best, evaluate, frontier, paper_plan, timing_label, trade};
pub use verification::{Verification, verify};

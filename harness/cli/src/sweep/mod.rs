//! `heliotorque sweep`: many runs of a mission or an FMU whose values vary, and what is kept of each.

mod options;

use files::outcome::Outcome;
use inputs::ending::check_ending;
pub(crate) use options::Sweep;

/// Simulates a campaign.
pub(crate) fn run(arguments: &Sweep) -> Outcome {
    check_ending(&arguments.output, "csv")?;
    campaign::sweep::run(&arguments.request())
}

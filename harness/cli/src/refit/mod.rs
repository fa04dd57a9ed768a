//! `heliotorque refit`: centre of mass and `solar.scale` from a history of momentum.

mod options;

use files::outcome::Outcome;
pub(crate) use options::Refit;

/// Fits.
pub(crate) fn run(arguments: &Refit) -> Outcome {
    planner::plans::refit::run(&arguments.request())
}

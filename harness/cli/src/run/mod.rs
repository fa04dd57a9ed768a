//! `heliotorque run`: runs an FMU or a system in a process of its own, records, writes, draws.

mod options;

use files::outcome::Outcome;
pub(crate) use options::Run;

/// Runs in a child process.
pub(crate) fn run(arguments: &Run) -> Outcome {
    campaign::run::run(&arguments.request())
}

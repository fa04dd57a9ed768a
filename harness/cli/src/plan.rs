//! `heliotorque plan`: optimal plans.

use std::process::ExitCode;

use crate::{app::Outcome, args::Plan};

/// Prints the plan asked for.
pub fn run(arguments: &Plan) -> Outcome {
    let text = match arguments {
        Plan::Spin(options) => planner::spin::plan(options)?,
    };
    terminal::print(text.trim_end())?;
    Ok(ExitCode::SUCCESS)
}

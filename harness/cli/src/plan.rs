//! `heliotorque plan`: optimal plans.

use std::process::ExitCode;

use crate::{args::Plan, outcome::Outcome};

/// Prints the plan.
pub fn run(arguments: &Plan) -> Outcome {
    let text = match arguments {
        Plan::Spin(options) => planner::spin::plan(options)?,
    };
    terminal::print(text.trim_end())?;
    Ok(ExitCode::SUCCESS)
}

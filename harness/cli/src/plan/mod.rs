//! `heliotorque plan`: optimal plans.

mod files;
mod picture;

use std::process::ExitCode;

use crate::{args::Plan, outcome::Outcome};

/// Prints the plan, and writes its files where a folder is given.
pub fn run(arguments: &Plan) -> Outcome {
    let Plan::Spin(options) = arguments;
    let answer = planner::spin::plan(options)?;
    terminal::print(answer.text.trim_end())?;
    if let (Some(folder), Some(burn)) = (&options.output, &answer.burn) {
        for path in files::write(folder, options.spacecraft.as_deref(), burn)? {
            terminal::note(&path.display().to_string());
        }
    }
    Ok(ExitCode::SUCCESS)
}

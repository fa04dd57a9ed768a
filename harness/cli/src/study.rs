//! `heliotorque study`: the papers' tables and figures.

use std::{io::IsTerminal, process::ExitCode};

use studies::{Options, STUDIES};

use crate::{args::Study, outcome::Outcome};

/// Runs a study, or lists them.
pub fn run(arguments: &Study) -> Outcome {
    if arguments.name == "list" {
        let mut table = terminal::table(&["study", "paper", "what it shows"]);
        for study in STUDIES {
            table.add_row([study.name, study.paper, study.title]);
        }
        terminal::print(&table.to_string())?;
        return Ok(ExitCode::SUCCESS);
    }
    let report = studies::run(
        &arguments.name,
        &Options {
            dist: arguments.dist.clone(),
            output: arguments.output.clone().unwrap_or_else(|| arguments.dist.join(&arguments.name)),
            only: arguments.only.clone(),
            angle_rad: arguments.angle,
            step_s: arguments.step,
            progress: !arguments.quiet && std::io::stderr().is_terminal(),
        },
    )?;
    terminal::print(&report.text)?;
    for file in &report.files {
        terminal::note(&file.display().to_string());
    }
    Ok(ExitCode::SUCCESS)
}

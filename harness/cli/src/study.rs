//! `heliotorque study`: the papers' tables and figures.

use std::{io::IsTerminal, path::PathBuf, process::ExitCode};

use studies::{Options, STUDIES};

use crate::{args::Study, home, outcome::Outcome};

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
    let folder = arguments.dist.clone().unwrap_or_else(home::dist);
    let output = match &arguments.output {
        Some(output) => output.clone(),
        // An installed program's folder is not for results.
        None if arguments.dist.is_none() && home::installed().is_some() => PathBuf::from(&arguments.name),
        None => folder.join(&arguments.name),
    };
    let report = studies::run(
        &arguments.name,
        &Options {
            dist: folder,
            output,
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

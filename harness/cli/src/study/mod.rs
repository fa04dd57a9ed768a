//! `heliotorque study`: the papers' tables and figures.

use std::{io::IsTerminal, path::PathBuf};

use clap::Args;
use files::outcome::{self, Answer, Outcome};
use inputs::{
    home,
    kind::FileKind,
    values::{angle, span},
    variables::warn_of_repeated,
};
use studies::{Options, STUDIES};

use crate::patience::Patience;

/// `heliotorque study`.
#[derive(Debug, Args)]
pub(crate) struct Study {
    /// The study, or `list`
    pub name: String,
    /// Folder with the FMUs; otherwise the installed program's, or dist
    #[arg(long, value_name = "FOLDER")]
    pub dist: Option<PathBuf>,
    /// Folder for CSV files and pictures; otherwise <study> in the folder of --dist, for an installed program in this one
    #[arg(long, value_name = "FOLDER")]
    pub output: Option<PathBuf>,
    /// Run only the cases whose label contains this text
    #[arg(long, value_name = "TEXT")]
    pub only: Option<String>,
    /// Angle of the slews of control/slew, in deg or rad: 60deg
    #[arg(long, value_name = "ANGLE", value_parser = turn, allow_hyphen_values = true)]
    pub angle: Option<f64>,
    /// Communication step of control/*, in s or with a unit: 20ms; otherwise 0.5 s for slews and 1 s for the loop with
    /// Guidance
    #[arg(long, value_name = "TIME", value_parser = span, allow_hyphen_values = true)]
    pub step: Option<f64>,
    /// The spacecraft of momentum/authority, a TOML file; otherwise that of MomentumPlant.fmu
    #[arg(long, value_name = "TOML")]
    pub spacecraft: Option<PathBuf>,
    /// Give a parameter of momentum/authority another value; repeatable, written as for `run`: solar.flux=1358
    #[arg(long, value_name = "NAME=VALUE")]
    pub set: Vec<String>,
    /// Show no progress
    #[arg(long, short)]
    pub quiet: bool,
    /// How long an FMU is waited for
    #[command(flatten)]
    pub patience: Patience,
}

/// Runs a study, or lists them.
pub(crate) fn run(arguments: &Study) -> Outcome {
    if arguments.name == "list" {
        let mut table = terminal::table(&["study", "paper", "what it shows"]);
        for study in STUDIES {
            table.add_row([study.name, study.paper, study.title]);
        }
        return outcome::printed(&table.to_string());
    }
    if let Some(spacecraft) = &arguments.spacecraft {
        FileKind::Spacecraft.read(spacecraft)?;
    }
    warn_of_repeated("--set", &arguments.set);
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
            spacecraft: arguments.spacecraft.clone(),
            sets: arguments.set.clone(),
            progress: !arguments.quiet && std::io::stderr().is_terminal(),
        },
    )?;
    terminal::print(&report.text)?;
    for file in &report.files {
        terminal::note(&file.display().to_string());
    }
    Ok(Answer::Yes)
}

/// A turn with its unit, in rad; none and more than half a turn are refused.
fn turn(text: &str) -> Result<f64, String> {
    match angle(text)? {
        angle_rad if angle_rad != 0.0 && angle_rad.abs() < core::f64::consts::PI => Ok(angle_rad),
        _ => Err("allowed is more than 0 and less than 180 deg either way".to_owned()),
    }
}

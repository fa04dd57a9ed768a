//! Options of `heliotorque plan`.

use std::path::PathBuf;

use clap::{Args, Subcommand};
use inputs::values::span;

use super::spin::SpinPlan;
use crate::patience::Reader;

/// Shown with the help.
const EXAMPLE: &str = "\
A plan file gives arrays, Sun directions and alternation that hold the momentum of a mission below its limit: timeline.toml,
mission.toml, plan.csv, windows.csv, plan.svg, plan.json; with [flyby] also an aim in the B-plane of an encounter, reached by sunlight:
desired.csv, the least velocity changes that would do the same, and sensitivity.csv, what every window changes. A leg file gives the
velocity at a place and date with which a mission comes to an encounter: mission.toml, plan.svg, plan.json.

Status 1: nothing was found that keeps the limits, or meets the aim; what there is of a plan is written all the same.

Example:
  heliotorque new plan plan.toml
  heliotorque plan plan.toml --output plan
  heliotorque run plan/mission.toml
  heliotorque new leg leg.toml
  heliotorque plan leg.toml --output leg
  heliotorque plan spin --angle 2deg --sun-angle 19deg";

/// Time for counted changes of the arrays, in s.
const BUDGET_S: f64 = 60.0;

/// `heliotorque plan`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLE, args_conflicts_with_subcommands = true, subcommand_negates_reqs = true)]
pub(crate) struct Plan {
    /// A plan without a file
    #[command(subcommand)]
    pub spin: Option<SpinCommand>,
    /// A plan by its file
    #[command(flatten)]
    pub by_file: Option<FilePlan>,
    /// The library that reads the file; beside the file, as clap sees no group in a group
    #[command(flatten)]
    pub reader: Reader,
}

/// The plan without a file.
#[derive(Debug, Subcommand)]
pub(crate) enum SpinCommand {
    /// The train of thruster pulses that turns a spinner with the least nutation
    #[command(mut_args = |argument| if argument.is_positional() { argument } else { argument.allow_hyphen_values(true) })]
    Spin(Box<SpinPlan>),
}

/// `heliotorque plan FILE`.
#[derive(Clone, Debug, Args)]
pub(crate) struct FilePlan {
    /// The file: a plan of momentum, with [flyby] of an encounter too (see `heliotorque new plan`), or a leg (`heliotorque new leg`)
    pub file: PathBuf,
    /// The folder to write into, created if missing
    #[arg(long, short, value_name = "DIR")]
    pub output: PathBuf,
    /// Not for a leg: longest time that is spent on counting changes of the arrays, in s or with a unit; otherwise 60 s
    #[arg(long, value_name = "TIME", value_parser = span)]
    pub budget: Option<f64>,
    /// Not for a leg: simulate the plan again with so many values of noise.seed, by the mission's own thresholds: dumps, and percentiles of the greatest |H|
    #[arg(long, value_name = "COUNT", value_parser = clap::value_parser!(u32).range(0..=10_000))]
    pub seeds: Option<u32>,
    /// Print no summary and no progress
    #[arg(long, short)]
    pub quiet: bool,
}

impl FilePlan {
    /// The request without the command line.
    pub(super) fn request(&self, reader: &Reader) -> planner::plans::options::FilePlan {
        planner::plans::options::FilePlan {
            file: self.file.clone(),
            output: self.output.clone(),
            template: reader.template.clone(),
            budget_s: self.budget.unwrap_or(BUDGET_S),
            seeds: self.seeds.unwrap_or(0),
            quiet: self.quiet,
        }
    }

    /// Refuses what only plans of momentum take.
    ///
    /// # Errors
    /// The option.
    pub(super) fn check_leg(&self) -> Result<(), String> {
        let given = [("--budget", self.budget.is_some()), ("--seeds", self.seeds.is_some())];
        match given.into_iter().find(|(_, is_given)| *is_given) {
            Some((option, _)) => {
                Err(format!("{}: found a leg, allowed with {option}: a plan", self.file.display()))
            }
            None => Ok(()),
        }
    }
}

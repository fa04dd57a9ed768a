//! Options of `heliotorque plan momentum`.

use std::path::PathBuf;

use clap::Args;

use crate::patience::Patience;

/// Shown with the help.
const EXAMPLE: &str = "\
Status 0: a plan was found and simulated within its limits. Status 1: it needs more dumps than it may have, or another limit is not kept;
what there is of the plan is written all the same.

Example:
  heliotorque new plan plan.toml
  heliotorque plan momentum plan.toml --output plan
  heliotorque run plan/mission.toml";

/// Time for counted changes of the arrays, in s.
const BUDGET_S: f64 = 60.0;

/// `heliotorque plan momentum`.
#[derive(Clone, Debug, Args)]
#[command(after_help = EXAMPLE)]
pub(crate) struct MomentumOptions {
    /// The plan file
    pub plan: PathBuf,
    /// The folder of timeline.toml, mission.toml, plan.csv, windows.csv, plan.svg and plan.json, created if missing
    #[arg(long, short, value_name = "DIR")]
    pub output: PathBuf,
    /// The FMU whose library simulates the mission; otherwise the installed program's, or dist/MomentumPlant.fmu
    #[arg(long, value_name = "FMU")]
    pub template: Option<PathBuf>,
    /// Longest time that is spent on counting changes of the arrays, in s or with a unit
    #[arg(long, value_name = "TIME", value_parser = inputs::values::span, default_value_t = BUDGET_S)]
    pub budget: f64,
    /// Simulate the plan again with so many values of noise.seed, by the mission's own thresholds: dumps, and percentiles of the greatest |H|
    #[arg(long, value_name = "COUNT", default_value_t = 0, value_parser = clap::value_parser!(u32).range(0..=10_000))]
    pub seeds: u32,
    /// Print no summary and no progress
    #[arg(long, short)]
    pub quiet: bool,
    /// How long it waits
    #[command(flatten)]
    pub patience: Patience,
}

impl MomentumOptions {
    /// The request without the command line.
    pub(crate) fn request(&self) -> planner::plans::momentum::MomentumOptions {
        let Self { plan, output, template, budget, seeds, quiet, .. } = self.clone();
        planner::plans::momentum::MomentumOptions { plan, output, template, budget, seeds, quiet }
    }
}

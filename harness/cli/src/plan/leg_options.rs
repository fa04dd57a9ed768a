//! Options of `heliotorque plan leg`.

use std::path::PathBuf;

use clap::Args;

use crate::patience::Patience;

/// Shown with the help.
const EXAMPLE: &str = "\
Status 0: the mission that is written meets the aim to a metre, simulated with all that acts on it. Status 1: there is no such arc, the aim
lies inside the planet, or no flight comes near.

Example:
  heliotorque new leg leg.toml
  heliotorque plan leg leg.toml --output leg
  heliotorque run leg/mission.toml";

/// `heliotorque plan leg`.
#[derive(Clone, Debug, Args)]
#[command(after_help = EXAMPLE)]
pub(crate) struct LegOptions {
    /// The leg file
    pub leg: PathBuf,
    /// The folder of mission.toml, plan.svg and plan.json, created if missing
    #[arg(long, short, value_name = "DIR")]
    pub output: PathBuf,
    /// The FMU whose library simulates the mission; otherwise the installed program's, or dist/MomentumPlant.fmu
    #[arg(long, value_name = "FMU")]
    pub template: Option<PathBuf>,
    /// Print no summary and no progress
    #[arg(long, short)]
    pub quiet: bool,
    /// How long it waits
    #[command(flatten)]
    pub patience: Patience,
}

impl LegOptions {
    /// The request without the command line.
    pub(crate) fn request(&self) -> planner::plans::leg::LegOptions {
        let Self { leg, output, template, quiet, .. } = self.clone();
        planner::plans::leg::LegOptions { leg, output, template, quiet }
    }
}

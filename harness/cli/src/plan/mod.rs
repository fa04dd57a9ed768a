//! `heliotorque plan`: optimal plans.

mod leg_options;
mod momentum_options;

use std::process::ExitCode;

use clap::{Args, Subcommand};
use files::outcome::Outcome;
use inputs::home;
use planner::plans::{
    self, leg,
    momentum::{self, PlanKind},
};

use crate::patience::Patience;
pub(crate) use leg_options::LegOptions;
pub(crate) use momentum_options::MomentumOptions;

/// `heliotorque plan`.
#[derive(Debug, Subcommand)]
pub(crate) enum Plan {
    /// The train of thruster pulses that turns a spinner with the least nutation
    #[command(mut_args = |argument| if argument.is_positional() { argument } else { argument.allow_hyphen_values(true) })]
    Spin(Box<SpinPlan>),
    /// Arrays, places of the Sun and alternation that hold the momentum of a mission below its limit
    Momentum(MomentumOptions),
    /// The same with an aim in the B-plane of an encounter, reached by sunlight
    #[command(after_help = FLYBY)]
    Flyby(MomentumOptions),
    /// The velocity at a place and date with which a mission comes to an encounter with a planet
    Leg(LegOptions),
}

/// Shown with the help of `plan flyby`.
const FLYBY: &str = "\
Beside the files of `plan momentum`: desired.csv, the least velocity changes that would do the same; sensitivity.csv, what every window
changes. Status 0: a plan was found and simulated within its limits. Status 1: none, or none was found: plan.json and plan.svg
say how far it is.

Example:
  heliotorque plan flyby flyby.toml --output flyby
  heliotorque run flyby/mission.toml";

/// `heliotorque plan spin`.
#[derive(Clone, Debug, Args)]
pub(crate) struct SpinPlan {
    /// What is planned
    #[command(flatten)]
    pub options: planner::spin::Options,
    /// How long the FMU is waited for
    #[command(flatten)]
    pub patience: Patience,
}

/// Prints the plan, and writes its files where a folder is given; a plan that breaks a limit ends with status 1.
pub(crate) fn run(arguments: &Plan) -> Outcome {
    let arguments = match arguments {
        Plan::Spin(arguments) => arguments,
        Plan::Momentum(options) => return momentum::run(&options.request(), PlanKind::Momentum),
        Plan::Flyby(options) => return momentum::run(&options.request(), PlanKind::Flyby),
        Plan::Leg(options) => return leg::run(&options.request()),
    };
    let mut options = arguments.options.clone();
    if let Some(path) = &options.spacecraft {
        planner::plans::check_spinner(path)?;
    }
    if options.spacecraft.is_none() && options.fmu.is_none() && options.campaign.is_none() {
        options.fmu = home::installed().map(|_| home::fmu("SpinPlant")).filter(|fmu| fmu.is_file());
    }
    let answer = planner::spin::plan(&options)?;
    terminal::print(answer.text.trim_end())?;
    if let (Some(folder), Some(burn)) = (&options.output, &answer.burn) {
        for path in plans::files::write(folder, options.spacecraft.as_deref(), burn)? {
            terminal::note(&path.display().to_string());
        }
    }
    if answer.broken.is_empty() {
        return Ok(ExitCode::SUCCESS);
    }
    terminal::note(&format!("limits broken: {}", answer.broken.join(", ")));
    Ok(ExitCode::FAILURE)
}

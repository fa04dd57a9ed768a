//! `heliotorque plan`: optimal plans.

mod options;

use files::outcome::{self, Answer, Outcome};
use inputs::{home, kind::FileKind};
use planner::{
    plans::{self, leg, momentum},
    spin::PlanError,
};

use options::SpinPlan;
pub(crate) use options::{Plan, SpinCommand};

/// Plans what the file or the subcommand names; a plan that breaks a limit ends with status 1.
pub(crate) fn run(arguments: &Plan) -> Outcome {
    match (&arguments.spin, &arguments.by_file) {
        (Some(SpinCommand::Spin(spin)), _) => run_spin(spin),
        (None, Some(options)) => {
            let text = ::files::read_text(&options.file)?;
            if FileKind::recognize(&text) == Some(FileKind::Leg) {
                options.check_leg()?;
                return leg::run(&options.request(&arguments.reader));
            }
            momentum::run(&options.request(&arguments.reader))
        }
        (None, None) => Err("allowed: a plan file, a leg file or spin".into()),
    }
}

/// Prints the plan of a spinner's turn, and writes its files where a folder is given.
fn run_spin(arguments: &SpinPlan) -> Outcome {
    let mut options = arguments.options.clone();
    if let Some(path) = &options.spacecraft {
        planner::plans::check_spinner(path)?;
    }
    if options.spacecraft.is_none() && options.template.is_none() && options.campaign_s.is_none() {
        options.template = home::installed().map(|_| home::fmu("SpinPlant")).filter(|fmu| fmu.is_file());
    }
    let answer = match planner::spin::plan(&options) {
        Err(PlanError::Infeasible(why)) => return outcome::no(&why),
        answer => answer?,
    };
    terminal::print(answer.text.trim_end())?;
    if let (Some(folder), Some(burn)) = (&options.output, &answer.burn) {
        for path in plans::files::write(folder, options.spacecraft.as_deref(), burn)? {
            terminal::note(&path.display().to_string());
        }
    }
    if answer.broken.is_empty() {
        return Ok(Answer::Yes);
    }
    terminal::note(&format!("limits broken: {}", answer.broken.join(", ")));
    Ok(Answer::No)
}

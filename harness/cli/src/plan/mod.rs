//! `heliotorque plan`: optimal plans.

mod options;
mod spin;

use files::outcome::Outcome;
use inputs::kind::FileKind;
use planner::plans::{self, leg, momentum};

pub(crate) use options::{Plan, SpinCommand};

/// Plans what the file or the subcommand names; a plan that breaks a limit ends with status 1.
pub(crate) fn run(arguments: &Plan) -> Outcome {
    match (&arguments.spin, &arguments.by_file) {
        (Some(SpinCommand::Spin(spin)), _) => plans::spin::run(&spin.request()),
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

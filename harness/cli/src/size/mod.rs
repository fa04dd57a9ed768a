//! `heliotorque size`: momentum, dumps, propellant, wheels, slews and thrusters of a spacecraft or mission.

mod options;

use files::outcome::Outcome;
pub(crate) use options::Size;

/// Sizes a spacecraft.
pub(crate) fn run(arguments: &Size) -> Outcome {
    planner::size::run(&arguments.request())
}

//! `heliotorque map`: torque of sunlight over the Sun's azimuth and elevation, as picture, table and CSV.

mod options;

use files::outcome::Outcome;
pub(crate) use options::Map;

/// Maps a spacecraft.
pub(crate) fn run(arguments: &Map) -> Outcome {
    planner::map::run(&arguments.request())
}

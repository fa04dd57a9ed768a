//! The mission that simulates a plan, and what its input table cannot express.

use std::path::Path;

use physics::constants::DAY_S;
use toml_edit::value;

use super::{
    super::{flights::SimulatedMission, mission_text},
    timeline::MissionTimeline,
};
use crate::Failure;

/// The mission's text with the plan's timeline, for a file in `folder`.
///
/// # Errors
/// A mission that cannot be read again.
pub(super) fn mission(
    planned: &SimulatedMission,
    folder: &Path,
    panels: usize,
    sets: &[(String, Vec<f64>)],
) -> Result<String, Failure> {
    let mut document = mission_text::moved(&planned.mission.path, folder)?;
    document["timeline"] = value("timeline.toml");
    for number in 1..=panels {
        mission_text::set(&mut document, &format!("panel[{number}].control"), value("timeline"));
    }
    for (name, values) in sets {
        mission_text::set(&mut document, name, mission_text::numbers(values));
    }
    Ok(document.to_string())
}

/// Returns the manoeuvres of the mission that the input table cannot express, as dumps and thrusters are parameters there.
pub(super) fn beyond_inputs(planned: &SimulatedMission, timeline: &MissionTimeline) -> Vec<String> {
    let dumps = planned.values().is_true("maneuver.dump");
    let maneuvers = timeline.thruster_events.iter().filter_map(|(at_s, event)| Some((at_s, event.maneuver?)));
    let printed = maneuvers.filter_map(|(at_s, maneuver)| {
        let what = match (dumps, maneuver.dumps, maneuver.thrusters) {
            (true, Some(false), _) => "is without a dump, the input table's has one (maneuver.dump)",
            (_, _, Some(_)) => "names its thrusters, the input table's are those of maneuver.thrusters",
            _ => return None,
        };
        let day = terminal::short((at_s - planned.start_s) / DAY_S);
        Some(format!("warning: plan.csv: the maneuver of day {day} {what}"))
    });
    printed.collect()
}

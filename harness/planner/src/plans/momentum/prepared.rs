//! A plan before its first flight: the mission that it names, and everything that can be refused without simulating it.

use std::path::Path;

use inputs::{
    plan::{PlanFile, keys::Activity},
    reading::At,
};
use packing::assembly::spacecraft_of;
use physics::guidance::timeline::Timeline;

use super::{
    flyby_task::Aim,
    layout::{check_arrays, check_spans, layout, refit, sets_of},
    timeline::MissionTimeline,
    update::update_time_s,
};
use crate::{
    Failure,
    momentum::{refit_file::RefitValues, torque::SunlitSpacecraft, windows::Layout},
    plans::flights::{OUTSIDE, SimulatedMission},
};

/// A plan whose mission is open.
pub(super) struct Prepared {
    /// The plan file, frozen until the date of its flyby.
    pub file: PlanFile,
    pub mission: SimulatedMission,
    pub timeline: MissionTimeline,
    pub sunlit: SunlitSpacecraft,
    pub refit: Option<RefitValues>,
    /// Encounter of a plan with a flyby.
    pub aim: Option<Aim>,
    /// Windows in cruise. In an orbit phase a flight shows its downlinks; with `[update]` the mission changes.
    pub cruise: Option<Layout>,
}

impl Prepared {
    /// Reads what the plan file names, and opens its mission.
    ///
    /// # Errors
    /// Whatever is refused, by the plan's line.
    pub(super) fn new(file: &PlanFile, template: Option<&Path>) -> Result<Self, Failure> {
        let refit = file.momentum.refit.as_ref().map(|at| refit(file, at)).transpose()?;
        let settings = refit.iter().flat_map(sets_of).map(|(name, values)| {
            let values: Vec<String> = values.iter().map(f64::to_string).collect();
            format!("{name}={}", values.join(","))
        });
        let settings: Vec<String> = settings.collect();
        let in_mission = |error: Failure| file.problem(&file.mission, &error.to_string());
        let mut mission =
            SimulatedMission::open([&file.mission.it; 2], template, &settings).map_err(in_mission)?;
        mission.rows_s = file.every_s;
        mission.check_downlinks().map_err(in_mission)?;
        if let Some(at) = &file.update {
            update_time_s(file, &at.it, &mission)?;
        }
        let file = frozen_until_from(file, &mission)?;
        let is_updated = file.update.is_some();
        if !is_updated {
            check_spans(&file, &mission)?;
            check_arrays(&file, &mission)?;
        }
        let is_in_orbit = mission.is_in_orbit();
        if let Some(at) = file.of_cruise().next().filter(|_| is_in_orbit) {
            let what = "found it, allowed: none in an orbit phase, whose downlinks' places of the Sun alone are planned";
            return Err(file.problem(&at, what).into());
        }
        let spacecraft = spacecraft_of(&mission.fmu)?;
        if let (Some(at), Some(refit)) = (&file.momentum.refit, &refit)
            && let Some(other) = refit.spacecraft.as_ref().filter(|other| **other != spacecraft.name)
        {
            let what = format!(
                "found values of {other:?}, allowed: of {:?}, the mission's spacecraft",
                spacecraft.name
            );
            return Err(file.problem(at, &what).into());
        }
        let found = mission.timeline(&spacecraft)?;
        let timeline = MissionTimeline::new(&mission, found.as_ref())?;
        let own: Option<&Timeline> = found.as_ref().map(|(_, timeline)| timeline);
        let sunlit = mission.sunlit(own)?;
        let aim = file.flyby.as_ref().map(|at| Aim::new(&file, &at.it, &mission)).transpose()?;
        for at in &file.activities {
            span_s(&file, at, &mission)?;
        }
        let cruise = (!is_in_orbit && !is_updated).then(|| layout(&file, &mission, &timeline, &sunlit));
        let cruise = cruise.transpose()?;
        Ok(Self { file, mission, timeline, sunlit, refit, aim, cruise })
    }
}

/// Start and stop of an activity, in s of the mission.
pub(super) fn span_s(
    file: &PlanFile,
    at: &At<Activity>,
    mission: &SimulatedMission,
) -> Result<[f64; 2], String> {
    let [from_s, to_s] = [at.it.start, at.it.stop].map(|instant| mission.time_in_file_s(file, at, instant));
    let (from_s, to_s) = (from_s?, to_s?);
    if from_s < mission.start_s || to_s > mission.stop_s {
        return Err(file.problem(at, OUTSIDE));
    }
    Ok([from_s, to_s])
}

/// A plan whose `[flyby] from` says until when the mission stays as it is.
fn frozen_until_from(file: &PlanFile, mission: &SimulatedMission) -> Result<PlanFile, Failure> {
    let mut file = file.clone();
    let Some(from) = file.flyby.as_ref().and_then(|flyby| flyby.it.from.clone()) else { return Ok(file) };
    let frozen_s = mission.time_in_mission_s(&file, &from)? - mission.start_s;
    file.freeze_s = from.with(frozen_s);
    Ok(file)
}

//! Windows of a plan by its file and its mission, and what a refit found.

use std::path::PathBuf;

use inputs::{plan::PlanFile, reading::At, variables::numbers};
use physics::constants::DAY_S;

use super::timeline::MissionTimeline;
use crate::{
    Failure,
    momentum::{
        refit_file::{self, RefitValues},
        simulated::SimulatedFlight,
        torque::SunlitSpacecraft,
        windows::{ControlBounds, Layout},
    },
    plans::flights::SimulatedMission,
    simulation::Flight,
};

/// Most windows of a plan.
const MAX_WINDOWS: f64 = 1000.0;

/// Refuses a plan without free time, or with windows beyond count.
pub(super) fn check_spans(file: &PlanFile, mission: &SimulatedMission) -> Result<(), Failure> {
    let length_s = mission.stop_s - mission.start_s;
    let days = |time_s: f64| terminal::short(time_s / DAY_S);
    if file.freeze_s.it >= length_s {
        let found =
            format!("found {} d, no less than the mission's {} d", days(file.freeze_s.it), days(length_s));
        let what = format!("{found}, allowed: less, so that there is something to plan");
        return Err(file.problem(&file.freeze_s, &what).into());
    }
    let least_s = length_s / MAX_WINDOWS;
    if file.window_s.it < least_s {
        let found = format!("found {} d of the mission's {} d", days(file.window_s.it), days(length_s));
        let what = format!("{found}, allowed: from {} d on", days(least_s));
        return Err(file.problem(&file.window_s, &what).into());
    }
    Ok(())
}

/// Refuses a flyby whose arrays cannot stay as the mission has them up to the date of the plan.
pub(super) fn check_arrays(file: &PlanFile, mission: &SimulatedMission) -> Result<(), Failure> {
    if file.flyby.is_none() || file.freeze_s.it <= 0.0 {
        return Ok(());
    }
    let controls = (1..).map(|number| (number, mission.values().item(&format!("panel[{number}].control"))));
    let mut all = controls.map_while(|(number, item)| Some((number, item?)));
    let moved = all.find(|(_, item)| !matches!(*item, "sunOffset" | "timeline"));
    let Some((number, found)) = moved else { return Ok(()) };
    let what = format!(
        "found panel[{number}].control {found}, allowed: timeline or sunOffset, for arrays stay as they are up to `from`: first \
         a plan of the momentum"
    );
    Err(file.problem(&file.mission, &what).into())
}

/// Angle that no downlink's Sun is off -Y by, in rad: where neither plan nor keep-in zone bounds it.
const MAX_TILT_RAD: f64 = 1.5;
/// Places stay so far within the keep-in zone, in rad: angles are rounded where they are written.
const WITHIN_ZONE_RAD: f64 = 1e-4;

/// Resolution of the ends of downlinks, in s.
const END_S: f64 = 60.0;
/// Output that says whether a downlink lasts.
const ACTIVE: &str = "downlink.active";

/// The downlinks of a flight, each up to the last minute in it.
fn ended_within(mission: &SimulatedMission, simulated: &SimulatedFlight) -> Result<Vec<[f64; 2]>, Failure> {
    let rows = &simulated.rows;
    let last_in =
        |stop_s: f64| rows[rows.partition_point(|row| row.time_s < stop_s).saturating_sub(1)].time_s;
    let minutes = |[_, stop_s]: [f64; 2]| -> Vec<f64> {
        let from_s = last_in(stop_s);
        let count = ((stop_s - from_s) / END_S).ceil() as u32;
        (0..count).map(|minute| from_s + END_S * f64::from(minute)).collect()
    };
    let found = simulated.downlinks_s();
    let times_s: Vec<f64> = found.iter().copied().flat_map(minutes).collect();
    let flight = Flight { outputs: &[ACTIVE], at_s: Some(&times_s), ..Flight::default() };
    let recording = mission.record(&flight)?;
    let is_active = numbers(&recording, ACTIVE)?;
    let minutes = || recording.times_s.iter().zip(&is_active);
    let ended = found.into_iter().filter_map(|[start_s, stop_s]| {
        let within = minutes().filter(|(at_s, is)| (start_s..stop_s).contains(*at_s) && **is != 0.0);
        within.map(|(at_s, _)| [start_s, *at_s]).next_back()
    });
    Ok(ended.filter(|[start_s, stop_s]| stop_s > start_s).collect())
}

/// The downlinks of a mission's orbit phase.
pub(super) fn orbit_layout(
    file: &PlanFile,
    mission: &SimulatedMission,
    timeline: &MissionTimeline,
    simulated: &SimulatedFlight,
) -> Result<Layout, Failure> {
    // A command ends within its downlink: the spacecraft's own turn to science follows.
    let downlinks_s = ended_within(mission, simulated)?;
    if downlinks_s.is_empty() {
        return Err(file
            .problem(&file.mission, "found no downlink, allowed: a mission with downlinks to plan")
            .into());
    }
    let zone_rad = mission.values().zone_rad();
    let tilt = |angle_rad: Option<f64>, zone_rad: f64| {
        angle_rad.unwrap_or(MAX_TILT_RAD).min(zone_rad - WITHIN_ZONE_RAD).max(0.0)
    };
    let control_bounds = ControlBounds {
        azimuth_rad: tilt(file.tilt.azimuth_rad, zone_rad[0]),
        elevation_rad: tilt(file.tilt.elevation_rad, zone_rad[1]),
        ..ControlBounds::default()
    };
    let sun_offset_rad = mission.values().real("panel[1].sunOffset");
    let sun_offset_rad = if sun_offset_rad.is_finite() { sun_offset_rad } else { 0.0 };
    Ok(Layout {
        frozen_until_s: mission.start_s + file.freeze_s.it,
        occupied: timeline.occupied(mission.stop_s),
        own: timeline.own(mission.start_s, &[], &[]),
        ..Layout::of_downlinks(downlinks_s, control_bounds, sun_offset_rad)
    })
}

/// Windows in cruise.
pub(super) fn layout(
    file: &PlanFile,
    mission: &SimulatedMission,
    timeline: &MissionTimeline,
    sunlit: &SunlitSpacecraft,
) -> Result<Layout, Failure> {
    let sides: Vec<f64> = sunlit.windmill_sides().collect();
    let has_side = sides.iter().any(|side| *side != 0.0);
    if file.windmill_rad.is_written && file.windmill_rad.it > 0.0 && !has_side {
        let what = "found panels without a side, allowed: 0, or windmill_side = 1 or -1 of [[panels]] in the spacecraft file";
        return Err(file.problem(&file.windmill_rad, what).into());
    }
    let panels = 1..=sunlit.panels.len();
    let controls = panels.map(|number| mission.values().item(&format!("panel[{number}].control")));
    let arrays_are_frozen = controls.into_iter().all(|it| matches!(it, Some("sunOffset" | "timeline")));
    let mut contacts_s: Vec<[f64; 2]> = Vec::new();
    for at in &file.contacts.it {
        let [from_s, to_s] =
            [at.it.start, at.it.stop].map(|instant| mission.time_in_file_s(file, at, instant));
        let (from_s, to_s) = (from_s?, to_s?);
        // Dates and simulation times compare here alone.
        if contacts_s.last().is_some_and(|[_, before_s]| from_s < *before_s) {
            let what = "found it before the contact above ends, allowed: contacts in the order of time, none overlapping";
            return Err(file.problem(at, what).into());
        }
        contacts_s.push([from_s, to_s]);
    }
    // Of panels that take no part too: the timeline turns all.
    let all_sides: Vec<f64> = sunlit.spacecraft.panels.iter().map(|panel| panel.windmill_side).collect();
    let zone_rad = mission.values().zone_rad();
    let offset_rad =
        timeline.arrays_rad.first().and_then(|(_, angles)| angles.first().copied()).unwrap_or_else(|| {
            if sides.is_empty() { 0.0 } else { mission.values().real("panel[1].sunOffset") }
        });
    let offsets_rad =
        (1..=all_sides.len()).map(|number| mission.values().real(&format!("panel[{number}].sunOffset")));
    let own = match arrays_are_frozen {
        true => timeline.own(mission.start_s, &all_sides, &offsets_rad.collect::<Vec<_>>()),
        false => Vec::new(),
    };
    Ok(Layout {
        frozen_until_s: mission.start_s + file.freeze_s.it,
        arrays_are_frozen,
        window_s: file.window_s.it,
        occupied: timeline.occupied(mission.stop_s),
        downlinks_s: None,
        contacts_s,
        contact_share: file.contact_share.it,
        control_bounds: ControlBounds {
            offset_rad: file.offset_rad(),
            windmill_rad: file.windmill_rad.it,
            azimuth_rad: file.tilt.azimuth_rad.unwrap_or(0.0).min(zone_rad[0]),
            elevation_rad: file.tilt.elevation_rad.unwrap_or(0.0).min(zone_rad[1]),
            alternate: file.alternation.it,
            alternate_apart: file.flyby.is_some(),
        },
        in_force: timeline.in_force(&own),
        own,
        corridor: mission.corridor(),
        offset_sign: if offset_rad < 0.0 { -1.0 } else { 1.0 },
        frozen_offset_rad: offset_rad,
        sides,
    })
}

/// Values of the mission that a refit gives.
pub(super) fn sets_of(refit: &RefitValues) -> Vec<(String, Vec<f64>)> {
    vec![
        ("spacecraft.centerOfMass".to_owned(), refit.center_of_mass_m.to_vec()),
        ("solar.scale".to_owned(), vec![refit.scale]),
    ]
}

/// Reads the file of a refit.
pub(super) fn refit(plan: &PlanFile, at: &At<PathBuf>) -> Result<RefitValues, String> {
    // Beside the values for missions stands what was found.
    let is_toml = at.it.extension().is_some_and(|it| it.eq_ignore_ascii_case("toml"));
    let path = if is_toml { at.it.with_extension("json") } else { at.it.clone() };
    let found = ::files::read_text(&path).and_then(|text| refit_file::read(&text));
    found.map_err(|error| {
        let allowed = "allowed: the JSON that `heliotorque refit` writes of a fit that is trusted";
        plan.problem(at, &format!("found {}: {error}, {allowed}", path.display()))
    })
}

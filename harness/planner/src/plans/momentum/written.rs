//! The files of a plan: the mission that simulates it, and its arrays and places of the Sun as an input table.

use std::{fmt, path::Path};

use nalgebra::Vector3;
use physics::{constants::DAY_S, plant::ThrusterEventSettings};
use toml_edit::value;

use super::{
    super::{flights::SimulatedMission, mission_text},
    timeline::{MissionTimeline, array_steps, shown_deg, shown_n_m_s, stretches},
};
use crate::{
    Failure,
    momentum::{
        plan::{MomentumPlan, PlannedDump},
        windows::WindowKind,
    },
};

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

/// How long a request of a dump is held, in s: seen by steps of a minute.
const HELD_S: f64 = 60.0;

/// A value of an input.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Cell {
    Real(f64),
    Truth(bool),
}

impl fmt::Display for Cell {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Real(number) => write!(f, "{number:?}"),
            Self::Truth(truth) => truth.fmt(f),
        }
    }
}

/// Groups of columns that change together, with their names but for those of panels.
const GROUPS: [&str; 5] = [
    "",
    ",downlink.sunAzimuth,downlink.sunElevation,downlink.alternate",
    ",maneuver.request,maneuver.deltaV[1],maneuver.deltaV[2],maneuver.deltaV[3]",
    ",dump.request,dump.target[1],dump.target[2],dump.target[3]",
    ",spacecraft.centerOfMass[1],spacecraft.centerOfMass[2],spacecraft.centerOfMass[3]",
];
/// Their places there; those behind the Sun's are in the table where they change.
const PANELS: usize = 0;
const SUN: usize = 1;
const MANEUVER: usize = 2;
const DUMP: usize = 3;
const CENTER_OF_MASS: usize = 4;

fn reals<'n>(numbers: impl IntoIterator<Item = &'n f64>) -> Vec<Cell> {
    numbers.into_iter().map(|number| Cell::Real(*number)).collect()
}

fn sun_place(angles_rad: [f64; 2], alternate: bool) -> Vec<Cell> {
    [reals(&angles_rad), vec![Cell::Truth(alternate)]].concat()
}

fn requested(request: bool, vector: &Vector3<f64>) -> Vec<Cell> {
    [vec![Cell::Truth(request)], reals(vector)].concat()
}

/// The input table: a row before and one behind every jump.
pub(super) fn inputs(
    planned: &SimulatedMission,
    timeline: &MissionTimeline,
    plan: &MomentumPlan,
    sides: &[f64],
    bodies: &dyn Fn(&PlannedDump) -> Vector3<f64>,
) -> String {
    let panels = 1..=sides.len();
    let offsets_rad = panels.clone().map(|number| format!("panel[{number}].sunOffset"));
    let offsets_rad: Vec<f64> = offsets_rad.map(|name| planned.values().real(&name)).collect();
    let mut now: [Vec<Cell>; GROUPS.len()] = [
        reals(&offsets_rad),
        sun_place([0.0; 2], false),
        requested(false, &Vector3::zeros()),
        requested(false, &Vector3::zeros()),
        reals(&planned.values().vector("spacecraft.centerOfMass")),
    ];
    // What changes, by time: the group and its new values.
    let mut changes: Vec<(f64, usize, Vec<Cell>)> = Vec::new();
    let is_frozen = plan.windows.first().is_some_and(|window| window.kind == WindowKind::Frozen);
    let frozen_s = plan.windows.first().filter(|_| is_frozen).map_or(planned.start_s, |window| window.stop_s);
    for (at_s, angles_rad) in timeline.arrays_rad.iter().filter(|(at_s, _)| *at_s < frozen_s) {
        changes.push((*at_s, PANELS, reals(angles_rad)));
    }
    if is_frozen {
        for (at_s, sun_rad, alternate) in timeline.sun_places.iter().filter(|it| it.0 < frozen_s) {
            changes.push((at_s.max(planned.start_s), SUN, sun_place(*sun_rad, *alternate)));
        }
    }
    for step in array_steps(&plan.windows) {
        let [offset_rad, windmill_rad] = [step.offset_deg, step.windmill_deg].map(f64::to_radians);
        let angles_rad: Vec<f64> = sides.iter().map(|side| offset_rad + windmill_rad * side).collect();
        changes.push((step.at_s, PANELS, reals(&angles_rad)));
    }
    // What is frozen first is the timeline's, above.
    for window in plan.windows.iter().skip(usize::from(is_frozen && !timeline.sun_places.is_empty())) {
        if window.kind != WindowKind::Free {
            changes.push((window.start_s, SUN, sun_place([0.0; 2], false)));
            continue;
        }
        for stretch in stretches(window) {
            let place_rad = window.sun_place_rad(stretch.alternate);
            let angles_rad = place_rad.map(|angle_rad| shown_deg(angle_rad).to_radians());
            changes.push((stretch.at_s, SUN, sun_place(angles_rad, stretch.alternate)));
        }
    }
    let mut request = |at_s: f64, group: usize, vector: &Vector3<f64>| {
        changes.push((at_s, group, requested(true, vector)));
        changes.push((at_s + HELD_S, group, requested(false, vector)));
    };
    for planned in &plan.dumps {
        request(planned.at_s, DUMP, &shown_n_m_s(&bodies(planned)).into());
    }
    let settings = ThrusterEventSettings {
        dumps: planned.values().is_true("maneuver.dump"),
        requested_body_n_m_s: planned.values().vector("dump.target"),
        ..ThrusterEventSettings::default()
    };
    for (at_s, event) in &timeline.thruster_events {
        if let Some(target_n_m_s) = settings.dump_target_body_n_m_s(event) {
            request(*at_s, DUMP, &target_n_m_s);
        }
        if let Some(maneuver) = event.maneuver {
            request(*at_s, MANEUVER, &maneuver.delta_v_inertial_m_s);
        }
    }
    let moved = timeline.thruster_events.iter();
    changes.extend(
        moved.filter_map(|(at_s, it)| Some((*at_s, CENTER_OF_MASS, reals(&it.center_of_mass_body_m?)))),
    );
    changes.sort_by(|a, b| a.0.total_cmp(&b.0));
    let is_there: [bool; GROUPS.len()] =
        std::array::from_fn(|group| group <= SUN || changes.iter().any(|(_, changed, _)| *changed == group));
    let mut text = String::from("time");
    text.extend(panels.map(|number| format!(",panel[{number}].sunOffsetCommand")));
    text.extend(GROUPS.iter().zip(is_there).filter(|(_, is_there)| *is_there).map(|(names, _)| *names));
    text.push('\n');
    let row = |time_s: f64, now: &[Vec<Cell>; GROUPS.len()]| {
        let there = now.iter().zip(is_there).filter(|(_, is_there)| *is_there).flat_map(|(cells, _)| cells);
        let cells: String = there.map(|cell| format!(",{cell}")).collect();
        format!("{time_s:?}{cells}\n")
    };
    let mut started = false;
    let mut index = 0;
    while index < changes.len() {
        let at_s = changes[index].0;
        if started || at_s > planned.start_s {
            if !started {
                text.push_str(&row(planned.start_s, &now));
            }
            text.push_str(&row(at_s, &now));
        }
        let before = now.clone();
        while let Some((_, group, cells)) = changes.get(index).filter(|(next_s, ..)| *next_s == at_s) {
            now[*group].clone_from(cells);
            index += 1;
        }
        if started && now == before {
            // Nothing jumps: the row before it is not needed either.
            let last = text.trim_end().rfind('\n').map_or(0, |at| at + 1);
            text.truncate(last);
            continue;
        }
        text.push_str(&row(at_s.max(planned.start_s), &now));
        started = true;
    }
    text.push_str(&row(planned.stop_s, &now));
    text
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

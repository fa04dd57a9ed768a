//! The files of a plan: the mission that simulates it, and its arrays and places of the Sun as an input table.

use std::path::Path;

use nalgebra::Vector3;
use physics::plant::ThrusterEventSettings;
use planner::momentum::{
    plan::{MomentumPlan, PlannedDump},
    torque::Control,
    windows::{Window, WindowKind},
};
use toml_edit::value;

use super::super::{
    flights::{Failure, SimulatedMission},
    mission_text,
};
use super::timeline::{MissionTimeline, array_steps, shown_deg, shown_n_m_s, stretches};

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
    let mut document = mission_text::moved(&planned.mission.file, folder)?;
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

/// Values of the inputs over a stretch.
#[derive(Clone, Debug, PartialEq)]
struct Inputs {
    panels_rad: Vec<f64>,
    azimuth_rad: f64,
    elevation_rad: f64,
    alternate: bool,
    dump: bool,
    target_n_m_s: Vector3<f64>,
    maneuver: bool,
    delta_v_m_s: Vector3<f64>,
    center_of_mass_m: Vector3<f64>,
}

/// Which groups of columns there are.
#[derive(Clone, Copy)]
struct Columns {
    dumps: bool,
    maneuvers: bool,
    centers_of_mass: bool,
}

/// The input table: a row before and one behind every jump.
pub(super) fn inputs(
    planned: &SimulatedMission,
    timeline: &MissionTimeline,
    plan: &MomentumPlan,
    sides: &[f64],
    bodies: &dyn Fn(&PlannedDump) -> Vector3<f64>,
) -> String {
    let count = sides.len();
    let mut now = Inputs {
        panels_rad: (1..=count)
            .map(|number| planned.values().real(&format!("panel[{number}].sunOffset")))
            .collect(),
        azimuth_rad: 0.0,
        elevation_rad: 0.0,
        alternate: false,
        dump: false,
        target_n_m_s: Vector3::zeros(),
        maneuver: false,
        delta_v_m_s: Vector3::zeros(),
        center_of_mass_m: planned.values().vector("spacecraft.centerOfMass"),
    };
    // What changes, by time.
    let mut changes: Vec<(f64, Change<'_>)> = Vec::new();
    let is_frozen = plan.windows.first().is_some_and(|window| window.kind == WindowKind::Frozen);
    let frozen_s = plan.windows.first().filter(|_| is_frozen).map_or(planned.start_s, |window| window.stop_s);
    for (at_s, angles_rad) in timeline.arrays_rad.iter().filter(|(at_s, _)| *at_s < frozen_s) {
        changes.push((*at_s, Change::Arrays(angles_rad.clone())));
    }
    if is_frozen {
        for (at_s, sun_rad, alternate) in timeline.sun_places.iter().filter(|it| it.0 < frozen_s) {
            changes.push((at_s.max(planned.start_s), Change::Place(*sun_rad, *alternate)));
        }
    }
    for step in array_steps(&plan.windows) {
        let [offset_rad, windmill_rad] = [step.offset_deg, step.windmill_deg].map(f64::to_radians);
        changes.push((
            step.at_s,
            Change::Arrays(sides.iter().map(|side| offset_rad + windmill_rad * side).collect()),
        ));
    }
    // What is frozen first is the timeline's, above.
    for window in plan.windows.iter().skip(usize::from(is_frozen && !timeline.sun_places.is_empty())) {
        if window.kind != WindowKind::Free {
            changes.push((window.start_s, Change::Sun(None, false)));
            continue;
        }
        for stretch in stretches(window) {
            changes.push((stretch.at_s, Change::Sun(Some(window), stretch.alternate)));
        }
    }
    let mut dump = |at_s: f64, target_n_m_s: Vector3<f64>| {
        changes.push((at_s, Change::Dump(true, target_n_m_s)));
        changes.push((at_s + HELD_S, Change::Dump(false, target_n_m_s)));
    };
    for planned in &plan.dumps {
        dump(planned.at_s, shown_n_m_s(&bodies(planned)).into());
    }
    let settings = ThrusterEventSettings {
        dumps: planned.values().is_true("maneuver.dump"),
        requested_body_n_m_s: planned.values().vector("dump.target"),
        ..ThrusterEventSettings::default()
    };
    for (at_s, event) in &timeline.thruster_events {
        if let Some(target_n_m_s) = settings.dump_target_body_n_m_s(event) {
            dump(*at_s, target_n_m_s);
        }
    }
    for (at_s, event) in &timeline.thruster_events {
        if let Some(maneuver) = event.maneuver {
            let delta_v_m_s = maneuver.delta_v_inertial_m_s;
            changes.push((*at_s, Change::Maneuver(true, delta_v_m_s)));
            changes.push((*at_s + HELD_S, Change::Maneuver(false, delta_v_m_s)));
        }
        if let Some(center_of_mass_m) = event.center_of_mass_body_m {
            changes.push((*at_s, Change::CenterOfMass(center_of_mass_m)));
        }
    }
    changes.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut text = String::from("time");
    for number in 1..=count {
        text.push_str(&format!(",panel[{number}].sunOffsetCommand"));
    }
    text.push_str(",downlink.sunAzimuth,downlink.sunElevation,downlink.alternate");
    let has = |is: fn(&Change<'_>) -> bool| changes.iter().any(|(_, change)| is(change));
    let columns = Columns {
        dumps: has(|it| matches!(it, Change::Dump(..))),
        maneuvers: has(|it| matches!(it, Change::Maneuver(..))),
        centers_of_mass: has(|it| matches!(it, Change::CenterOfMass(_))),
    };
    if columns.maneuvers {
        text.push_str(",maneuver.request,maneuver.deltaV[1],maneuver.deltaV[2],maneuver.deltaV[3]");
    }
    if columns.dumps {
        text.push_str(",dump.request,dump.target[1],dump.target[2],dump.target[3]");
    }
    if columns.centers_of_mass {
        let axes = [1, 2, 3].map(|axis| format!(",spacecraft.centerOfMass[{axis}]"));
        text.push_str(&axes.concat());
    }
    text.push('\n');
    let mut started = false;
    let mut index = 0;
    while index < changes.len() {
        let at_s = changes[index].0;
        if started || at_s > planned.start_s {
            if !started {
                text.push_str(&row(planned.start_s, &now, columns));
            }
            text.push_str(&row(at_s, &now, columns));
        }
        let before = now.clone();
        while let Some((next_s, change)) = changes.get(index).filter(|(next_s, _)| *next_s == at_s) {
            let _ = next_s;
            change.apply(&mut now);
            index += 1;
        }
        if started && now == before {
            // Nothing jumps: the row before it is not needed either.
            let last = text.trim_end().rfind('\n').map_or(0, |at| at + 1);
            text.truncate(last);
            continue;
        }
        text.push_str(&row(at_s.max(planned.start_s), &now, columns));
        started = true;
    }
    text.push_str(&row(planned.stop_s, &now, columns));
    text
}

/// What the input table cannot say of the mission's maneuvers, whose dumps and thrusters are parameters there.
pub(super) fn beyond_inputs(planned: &SimulatedMission, timeline: &MissionTimeline) -> Vec<String> {
    let dumps = planned.values().is_true("maneuver.dump");
    let maneuvers = timeline.thruster_events.iter().filter_map(|(at_s, event)| Some((at_s, event.maneuver?)));
    let printed = maneuvers.filter_map(|(at_s, maneuver)| {
        let what = match (dumps, maneuver.dumps, maneuver.thrusters) {
            (true, Some(false), _) => "is without a dump, the input table's has one (maneuver.dump)",
            (_, _, Some(_)) => "names its thrusters, the input table's are those of maneuver.thrusters",
            _ => return None,
        };
        let day = terminal::short((at_s - planned.start_s) / 86_400.0);
        Some(format!("warning: plan.csv: the maneuver of day {day} {what}"))
    });
    printed.collect()
}

enum Change<'w> {
    Arrays(Vec<f64>),
    Sun(Option<&'w Window>, bool),
    Place([f64; 2], bool),
    Dump(bool, Vector3<f64>),
    Maneuver(bool, Vector3<f64>),
    CenterOfMass(Vector3<f64>),
}

impl Change<'_> {
    fn apply(&self, inputs: &mut Inputs) {
        match self {
            Self::Arrays(angles_rad) => inputs.panels_rad.clone_from(angles_rad),
            Self::Sun(window, alternate) => {
                let angle = |control| {
                    window.map_or(0.0, |window| shown_deg(window.controls.get(control)).to_radians())
                };
                (inputs.azimuth_rad, inputs.elevation_rad) =
                    (angle(Control::Azimuth), angle(Control::Elevation));
                inputs.alternate = *alternate;
            }
            Self::Place([azimuth_rad, elevation_rad], alternate) => {
                (inputs.azimuth_rad, inputs.elevation_rad) = (*azimuth_rad, *elevation_rad);
                inputs.alternate = *alternate;
            }
            Self::Maneuver(request, delta_v) => (inputs.maneuver, inputs.delta_v_m_s) = (*request, *delta_v),
            Self::CenterOfMass(center_of_mass_m) => inputs.center_of_mass_m = *center_of_mass_m,
            Self::Dump(request, target) => (inputs.dump, inputs.target_n_m_s) = (*request, *target),
        }
    }
}

fn row(time_s: f64, inputs: &Inputs, columns: Columns) -> String {
    let mut cells = vec![format!("{time_s:?}")];
    cells.extend(inputs.panels_rad.iter().map(|angle| format!("{angle:?}")));
    cells.extend([inputs.azimuth_rad, inputs.elevation_rad].map(|angle| format!("{angle:?}")));
    cells.push(inputs.alternate.to_string());
    if columns.maneuvers {
        cells.push(inputs.maneuver.to_string());
        cells.extend(inputs.delta_v_m_s.iter().map(|component| format!("{component:?}")));
    }
    if columns.dumps {
        cells.push(inputs.dump.to_string());
        cells.extend(inputs.target_n_m_s.iter().map(|component| format!("{component:?}")));
    }
    if columns.centers_of_mass {
        cells.extend(inputs.center_of_mass_m.iter().map(|component| format!("{component:?}")));
    }
    format!("{}\n", cells.join(","))
}

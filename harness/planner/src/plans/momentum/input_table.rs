//! Arrays and places of the Sun of a plan as a table of inputs: a row before and one behind every jump.

use fmi::Value;
use nalgebra::Vector3;
use physics::plant::ThrusterEventSettings;

use super::{
    planned::Planned,
    steps::{array_steps, shown_deg, shown_n_m_s, stretches},
};
use crate::momentum::{plan::MomentumPlan, windows::WindowKind};

/// Time for which a request of a dump is held, in s: seen by steps of a minute.
const HELD_S: f64 = 60.0;

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

/// Values of a group.
type Cells = Vec<Value>;

fn reals<'n>(numbers: impl IntoIterator<Item = &'n f64>) -> Cells {
    numbers.into_iter().map(|number| Value::Real(*number)).collect()
}

fn sun_place(angles_rad: [f64; 2], alternate: bool) -> Cells {
    [reals(&angles_rad), vec![Value::Boolean(alternate)]].concat()
}

fn requested(request: bool, vector: &Vector3<f64>) -> Cells {
    [vec![Value::Boolean(request)], reals(vector)].concat()
}

/// Changes of groups by time in s.
type Changes = Vec<(f64, usize, Cells)>;

/// The table, in an orbit phase without the panels.
pub(super) fn text(planned: &Planned<'_>, plan: &MomentumPlan) -> String {
    let sides = planned.sunlit.spacecraft.panels.iter().map(|panel| panel.windmill_side);
    let sides: Vec<f64> = sides.filter(|_| !planned.mission.is_in_orbit()).collect();
    let mut changes = of_arrays_and_sun(planned, plan, &sides);
    changes.extend(of_events(planned, plan));
    changes.sort_by(|a, b| a.0.total_cmp(&b.0));
    let values = planned.mission.values();
    let offsets_rad = (1..=sides.len()).map(|number| values.real(&format!("panel[{number}].sunOffset")));
    let start = [
        reals(&offsets_rad.collect::<Vec<_>>()),
        sun_place([0.0; 2], false),
        requested(false, &Vector3::zeros()),
        requested(false, &Vector3::zeros()),
        reals(&values.vector("spacecraft.centerOfMass")),
    ];
    let is_there = |group: usize| group <= SUN || changes.iter().any(|(_, changed, _)| *changed == group);
    let groups: Vec<usize> = (0..GROUPS.len()).filter(|group| is_there(*group)).collect();
    let mut text = String::from("time");
    text.extend((1..=sides.len()).map(|number| format!(",panel[{number}].sunOffsetCommand")));
    text.extend(groups.iter().map(|group| GROUPS[*group]));
    text.push('\n');
    text + &rows(&changes, start, &groups, [planned.mission.start_s, planned.mission.stop_s])
}

/// Arrays and places of the Sun: the mission's while it is frozen, then the plan's.
fn of_arrays_and_sun(planned: &Planned<'_>, plan: &MomentumPlan, sides: &[f64]) -> Changes {
    let (timeline, start_s) = (&planned.timeline, planned.mission.start_s);
    let mut changes = Changes::new();
    let frozen = plan.windows.first().filter(|window| window.kind == WindowKind::Frozen);
    let frozen_s = frozen.map_or(start_s, |window| window.stop_s);
    for (at_s, angles_rad) in timeline.arrays_rad.iter().filter(|(at_s, _)| *at_s < frozen_s) {
        changes.push((*at_s, PANELS, reals(angles_rad)));
    }
    if frozen.is_some() {
        for (at_s, sun_rad, alternate) in timeline.sun_places.iter().filter(|it| it.0 < frozen_s) {
            changes.push((at_s.max(start_s), SUN, sun_place(*sun_rad, *alternate)));
        }
    }
    for step in array_steps(&plan.windows) {
        let [offset_rad, windmill_rad] = [step.offset_deg, step.windmill_deg].map(f64::to_radians);
        let angles_rad: Vec<f64> = sides.iter().map(|side| offset_rad + windmill_rad * side).collect();
        changes.push((step.at_s, PANELS, reals(&angles_rad)));
    }
    // What is frozen first is the timeline's, above.
    let skipped = usize::from(frozen.is_some() && !timeline.sun_places.is_empty());
    for window in plan.windows.iter().skip(skipped) {
        if window.kind != WindowKind::Free {
            changes.push((window.start_s, SUN, sun_place([0.0; 2], false)));
            continue;
        }
        changes.extend(stretches(window).into_iter().map(|stretch| {
            let place_rad = window.sun_place_rad(stretch.alternate);
            let angles_rad = place_rad.map(|angle_rad| shown_deg(angle_rad).to_radians());
            (stretch.at_s, SUN, sun_place(angles_rad, stretch.alternate))
        }));
    }
    changes
}

/// Dumps of the plan, then dumps, manoeuvres and centres of mass of the mission.
fn of_events(planned: &Planned<'_>, plan: &MomentumPlan) -> Changes {
    let mut changes = Changes::new();
    let mut request = |at_s: f64, group: usize, vector: &Vector3<f64>| {
        changes.push((at_s, group, requested(true, vector)));
        changes.push((at_s + HELD_S, group, requested(false, vector)));
    };
    for dump in &plan.dumps {
        request(dump.at_s, DUMP, &shown_n_m_s(&planned.body(&plan.windows, dump)).into());
    }
    let values = planned.mission.values();
    let settings = ThrusterEventSettings {
        dumps: values.is_true("maneuver.dump"),
        requested_body_n_m_s: values.vector("dump.target"),
        ..ThrusterEventSettings::default()
    };
    let events = &planned.timeline.thruster_events;
    for (at_s, event) in events {
        if let Some(target_n_m_s) = settings.dump_target_body_n_m_s(event) {
            request(*at_s, DUMP, &target_n_m_s);
        }
        if let Some(maneuver) = event.maneuver {
            request(*at_s, MANEUVER, &maneuver.delta_v_inertial_m_s);
        }
    }
    let moved = events.iter();
    changes.extend(
        moved.filter_map(|(at_s, it)| Some((*at_s, CENTER_OF_MASS, reals(&it.center_of_mass_body_m?)))),
    );
    changes
}

/// The rows of these groups, which begin with the values of `now`.
fn rows(
    changes: &Changes,
    mut now: [Cells; GROUPS.len()],
    groups: &[usize],
    [start_s, stop_s]: [f64; 2],
) -> String {
    let row = |time_s: f64, now: &[Cells; GROUPS.len()]| {
        let cells = groups.iter().flat_map(|group| &now[*group]).map(|cell| match cell {
            Value::Real(number) => format!(",{number:?}"),
            other => format!(",{other}"),
        });
        format!("{time_s:?}{}\n", cells.collect::<String>())
    };
    let mut text = String::new();
    let mut started = false;
    for together in changes.chunk_by(|one, next| one.0 == next.0) {
        let at_s = together[0].0;
        let before = now.clone();
        for (_, group, cells) in together {
            now[*group].clone_from(cells);
        }
        if started && now == before {
            continue;
        }
        if started || at_s > start_s {
            if !started {
                text += &row(start_s, &before);
            }
            text += &row(at_s, &before);
        }
        text += &row(at_s.max(start_s), &now);
        started = true;
    }
    text + &row(stop_s, &now)
}

//! A mission from the state that orbit determination found, at the date of it.
//!
//! Momentum there is that of the mission's flight; so are position or velocity, where the plan gives one alone.

use ::files::Scratch;
use inputs::{
    plan::{PlanFile, keys::Update},
    reading::At,
    values::Instant,
    variables::{NEVER_N_M_S, elements, vectors},
};
use nalgebra::Vector3;
use packing::assembly::spacecraft_of;
use physics::{environment::dates, guidance::timeline::TimelineClock};
use toml_edit::{DocumentMut, Item, value};

use crate::{
    Failure,
    plans::{flights::SimulatedMission, mission_text},
    simulation::Flight,
};

/// The timeline of an updated mission.
const TIMELINE: &str = "timeline.toml";
/// Variables recorded up to the date.
const STATE: [&str; 3] = ["position", "velocity", "momentum.body"];

/// When the state of `[update]` holds, in s of the mission as it is.
pub(super) fn update_time_s(
    file: &PlanFile,
    update: &Update,
    mission: &SimulatedMission,
) -> Result<f64, Failure> {
    let at_s = mission.time_in_mission_s(file, &update.at)?;
    if let (Some(_), Some(_)) = (&mission.mission.inputs, mission.zero_epoch_s)
        && at_s > mission.start_s
    {
        let what = "found inputs of the mission, which count from its start, allowed: none, or a date that is its start";
        return Err(file.problem(&update.at, what).into());
    }
    Ok(at_s)
}

/// A plan whose mission begins with the state of `[update]`, in a folder that lasts as long as it is in use.
pub(super) fn updated(
    file: &PlanFile,
    at: &At<Update>,
    mission: &SimulatedMission,
) -> Result<(PlanFile, Scratch), Failure> {
    let update = &at.it;
    let at_s = update_time_s(file, update, mission)?;
    let [position_m, velocity_m_s, momentum_n_m_s] = state_at(mission, at_s)?;
    let position_m = update.position_m.unwrap_or(position_m);
    let velocity_m_s = update.velocity_m_s.unwrap_or(velocity_m_s);
    let folder = Scratch::new()?;
    let vectors = [
        ("orbit.position", position_m),
        ("orbit.velocity", velocity_m_s),
        ("start.momentum", momentum_n_m_s),
    ];
    let mut document = mission_text::moved(&mission.mission.path, folder.path())?;
    for (name, vector) in vectors {
        mission_text::set(&mut document, name, mission_text::numbers(vector.as_slice()));
    }
    mission_text::set(&mut document, "orbit.source", value("inputs"));
    match mission.zero_epoch_s {
        Some(zero_s) => {
            document["start"] = value(dates::utc(zero_s + at_s));
            document["stop"] = value(mission.stop_s - at_s);
            if let Some(text) = dated(mission, zero_s)? {
                folder.write(TIMELINE, text)?;
                document["timeline"] = value(TIMELINE);
            }
        }
        None => {
            document["start"] = value(at_s);
            document["stop"] = value(mission.stop_s);
        }
    }
    let path = folder.write("updated.toml", document.to_string())?;
    let mut updated = file.clone();
    // The clock of the mission as it was, for every time of the file.
    if let Some(zero_s) = mission.zero_epoch_s {
        updated.instants_mut().for_each(|instant| {
            if let Instant::Time(time_s) = *instant {
                *instant = Instant::Epoch(zero_s + time_s);
            }
        });
    }
    updated.mission.it = path;
    // The date of the mission's start moves, that up to which it is frozen does not.
    updated.freeze_s.it = match &file.flyby {
        Some(flyby) if flyby.it.from.is_some() => file.freeze_s.it,
        _ => (file.freeze_s.it - (at_s - mission.start_s)).max(0.0),
    };
    Ok((updated, folder))
}

/// Begin of each row of a list and, where it has one, its end, in s.
type RowTimes = Vec<(f64, Option<f64>)>;

/// The mission's timeline with dates in the place of times, which would count from another start; `None` where it has none, or dates.
fn dated(mission: &SimulatedMission, zero_s: f64) -> Result<Option<String>, Failure> {
    let spacecraft = spacecraft_of(&mission.fmu)?;
    let Some((text, timeline)) = mission.timeline(&spacecraft)? else { return Ok(None) };
    if timeline.clock == TimelineClock::Epoch {
        return Ok(None);
    }
    let mut document: DocumentMut = text.parse()?;
    let commands = timeline.entries.iter().map(|it| (it.at_s, it.until_s)).collect();
    let panels = timeline.panels.iter().map(|it| (it.at_s, None)).collect();
    let events = timeline.events.iter().map(|it| (it.at_s, None)).collect();
    let lists: [(&str, RowTimes); 3] = [("command", commands), ("panels", panels), ("event", events)];
    for (name, times_s) in lists {
        let tables = document.get_mut(name).and_then(Item::as_array_of_tables_mut);
        for (table, (at_s, until_s)) in tables.into_iter().flat_map(|it| it.iter_mut()).zip(times_s) {
            table["at"] = value(dates::utc(zero_s + at_s));
            if let Some(until_s) = until_s.filter(|_| table.contains_key("until")) {
                table["until"] = value(dates::utc(zero_s + until_s));
            }
        }
    }
    Ok(Some(document.to_string()))
}

/// Position, velocity and momentum (body frame) of the mission's flight at a time.
fn state_at(mission: &SimulatedMission, at_s: f64) -> Result<[Vector3<f64>; 3], Failure> {
    let start = |name: &str| mission.values().vector(name);
    if at_s <= mission.start_s && mission.values().item("orbit.source") == Some("inputs") {
        return Ok([start("orbit.position"), start("orbit.velocity"), start("start.momentum")]);
    }
    let sets: Vec<_> = elements("dump.threshold", Vector3::repeat(NEVER_N_M_S)).collect();
    let stop_s = Some(at_s.max(mission.start_s + 1.0));
    let recording = mission.record(&Flight { sets: &sets, outputs: &STATE, stop_s, ..Flight::default() })?;
    // The first row where the mission starts there, else the last.
    let row = if at_s <= mission.start_s { 0 } else { recording.times_s.len().saturating_sub(1) };
    let vector = |name: &str| -> Result<Vector3<f64>, Failure> {
        let found = vectors(&recording, name)?.get(row).copied();
        found.ok_or_else(|| format!("the FMU has no output {name}").into())
    };
    Ok([vector(STATE[0])?, vector(STATE[1])?, vector(STATE[2])?])
}

//! The timeline of a plan: what the mission commands and keeps, and the plan's own commands, panels and dumps.

use core::fmt::Write;

use inputs::plan::keys::Activity;
use nalgebra::Vector3;
use packing::assembly::spacecraft_of;
use physics::{
    environment::dates,
    guidance::timeline::{PlanStatus, Timeline, TimelineClock, TimelineEvent, simulation_time_s},
};
use toml_edit::{DocumentMut, Item};

use super::{
    super::flights::SimulatedMission,
    steps::{ArrayStep, array_steps, shown_deg, shown_n_m_s, stretches},
};
use crate::{
    Failure,
    momentum::{
        controls::Controls,
        in_force::ActiveControls,
        plan::PlannedDump,
        report::PlanEvent,
        windows::{BusySpan, Layout, Window, WindowKind},
    },
};

/// Panels stand by an offset and a windmill angle to so much, in rad.
const SAME_RAD: f64 = 1e-9;
/// A tolerance for clocks that are written to the millisecond, in s.
const CLOCK_S: f64 = 2e-3;

/// A table of the mission's timeline.
#[derive(Clone, Debug)]
struct Kept {
    /// In s of the flight.
    at_s: f64,
    until_s: Option<f64>,
    text: String,
    status: PlanStatus,
}

/// Contents of the mission's own timeline.
#[derive(Clone, Debug, Default)]
pub(super) struct MissionTimeline {
    commands: Vec<Kept>,
    /// Times in s with the texts of the tables.
    panels: Vec<(f64, String)>,
    events: Vec<(f64, String)>,
    /// Offset and windmill angle of the arrays over time, in rad, where the timeline says so: time in s, each panel's angle.
    pub arrays_rad: Vec<(f64, Vec<f64>)>,
    /// Sun's place in its downlinks by its commands: time in s, azimuth and elevation in rad, whether turned about the Sun line.
    pub sun_places: Vec<(f64, [f64; 2], bool)>,
    /// Its events and their times, in s.
    pub thruster_events: Vec<(f64, TimelineEvent)>,
    is_dated: bool,
}

impl MissionTimeline {
    /// Reads the mission's timeline.
    ///
    /// # Errors
    /// A file that cannot be read again.
    pub(super) fn new(
        mission: &SimulatedMission,
        found: Option<&(String, Timeline)>,
    ) -> Result<Self, Failure> {
        let Some((text, timeline)) = found else {
            return Ok(Self { is_dated: mission.zero_epoch_s.is_some(), ..Self::default() });
        };
        let document: DocumentMut = text.parse()?;
        let clock_minus_time_s = mission.clock_minus_time_s(timeline);
        let time = |at_s: f64| simulation_time_s(at_s, clock_minus_time_s);
        let commands = timeline.entries.iter().zip(tables(&document, "command"));
        let commands = commands.map(|(it, text)| Kept {
            at_s: time(it.at_s),
            until_s: it.until_s.map(time),
            text,
            status: it.status,
        });
        let panels = timeline.panels.iter().map(|it| time(it.at_s));
        let events = timeline.events.iter().map(|it| time(it.at_s));
        let sides: Vec<f64> =
            spacecraft_of(&mission.fmu)?.panels.iter().map(|panel| panel.windmill_side).collect();
        let arrays = timeline.panels.iter().map(|step| {
            let angles = step.sun_offsets_rad.iter().zip(&sides);
            (
                time(step.at_s),
                angles.map(|(offset_rad, side)| offset_rad + step.windmill_rad * side).collect(),
            )
        });
        let mut sun_places = Vec::new();
        for (index, entry) in timeline.entries.iter().enumerate() {
            let sun = entry.downlink.sun.map_or([0.0; 2], |sun| [sun.azimuth_rad, sun.elevation_rad]);
            sun_places.push((time(entry.at_s), sun, entry.downlink.alternate));
            let next_s = timeline.entries.get(index + 1).map_or(f64::INFINITY, |next| next.at_s);
            if let Some(until_s) = entry.until_s.filter(|until_s| *until_s < next_s) {
                sun_places.push((time(until_s), [0.0; 2], false));
            }
        }
        Ok(Self {
            arrays_rad: arrays.collect(),
            sun_places,
            thruster_events: timeline.events.iter().map(|event| (time(event.at_s), *event)).collect(),
            commands: commands.collect(),
            panels: panels.zip(tables(&document, "panels")).collect(),
            events: events.zip(tables(&document, "event")).collect(),
            is_dated: timeline.clock == TimelineClock::Epoch,
        })
    }

    /// Its events by their kinds.
    pub(super) fn plan_events(&self) -> Vec<PlanEvent> {
        let kinds = |event: &TimelineEvent| {
            let kinds = [
                ("maneuver", event.maneuver.is_some()),
                ("dump", event.dump.is_some()),
                ("centerOfMass", event.center_of_mass_body_m.is_some()),
            ];
            kinds.into_iter().filter(|(_, is)| *is).map(|(name, _)| name).collect()
        };
        let events = self.thruster_events.iter();
        events.map(|(at_s, event)| PlanEvent { at_s: *at_s, kinds: kinds(event), planned: false }).collect()
    }

    /// Commands that a plan leaves as they are.
    pub(super) fn occupied(&self, stop_s: f64) -> Vec<BusySpan> {
        let next = |index: usize| self.commands.get(index + 1).map_or(stop_s, |next| next.at_s);
        let commands = self.commands.iter().enumerate();
        commands
            .filter(|(_, kept)| kept.status != PlanStatus::Free)
            .map(|(index, kept)| BusySpan {
                start_s: kept.at_s,
                stop_s: kept.until_s.unwrap_or(f64::INFINITY).min(next(index)),
                planned: kept.status == PlanStatus::Planned,
                command: index,
            })
            .collect()
    }

    /// Controls of the mission from its start on, where every panel stands at one offset plus a windmill angle by its side: `sides` is
    /// which way that turns each of them, `offsets_rad` where they stand before the timeline's first step; else none.
    pub(super) fn own(&self, start_s: f64, sides: &[f64], offsets_rad: &[f64]) -> Vec<ActiveControls> {
        let turned = sides.iter().position(|side| *side != 0.0);
        // Panels on both sides are at offset + windmill and offset - windmill.
        let other = turned.and_then(|turned| sides.iter().position(|side| *side == -sides[turned]));
        let arrays = |time_s: f64| {
            let step = self.arrays_rad.iter().rfind(|(at_s, _)| *at_s <= time_s + CLOCK_S);
            let angles_rad = step.map_or(offsets_rad, |(_, angles_rad)| angles_rad);
            let Some(first) = angles_rad.first() else { return Some([0.0; 2]) };
            let [offset_rad, windmill_rad] = match turned.zip(other) {
                Some((turned, other)) => {
                    let [one, other] = [*angles_rad.get(turned)?, *angles_rad.get(other)?];
                    [0.5 * (one + other), 0.5 * (one - other) * sides[turned]]
                }
                None => [*first, 0.0],
            };
            let stands = |(angle_rad, side): (&f64, &f64)| {
                (offset_rad + windmill_rad * side - angle_rad).abs() < SAME_RAD
            };
            angles_rad.iter().zip(sides).all(stands).then_some([offset_rad, windmill_rad])
        };
        let place = |time_s: f64| {
            let place = self.sun_places.iter().rfind(|(at_s, ..)| *at_s <= time_s + CLOCK_S);
            place.map_or(([0.0; 2], false), |(_, sun_rad, alternate)| (*sun_rad, *alternate))
        };
        let mut times_s: Vec<f64> = self.arrays_rad.iter().map(|it| it.0).collect();
        times_s.extend(self.sun_places.iter().map(|it| it.0));
        times_s.push(start_s);
        times_s.sort_by(f64::total_cmp);
        times_s.dedup();
        let at = |at_s: f64| {
            let ([offset_rad, windmill_rad], (sun_rad, alternate)) = (arrays(at_s)?, place(at_s));
            let share = if alternate { 1.0 } else { 0.0 };
            // Between its times an attitude keeps its place of the Sun.
            let of = |is_alternate: bool| {
                let mut begun = self.sun_places.iter().filter(|it| it.0 <= at_s + CLOCK_S);
                begun.rfind(|it| it.2 == is_alternate).map_or(sun_rad, |it| it.1)
            };
            let ([azimuth, elevation], [own_azimuth, own_elevation]) = (of(false), of(true));
            let controls =
                Controls([offset_rad, windmill_rad, azimuth, elevation, share, own_azimuth, own_elevation]);
            Some(ActiveControls { at_s, controls })
        };
        let all: Option<Vec<ActiveControls>> = times_s.into_iter().map(at).collect();
        all.unwrap_or_default()
    }

    /// Part of `own` that is a plan: from the time on at which both arrays and Sun directions are commanded.
    pub(super) fn in_force(&self, own: &[ActiveControls]) -> Vec<ActiveControls> {
        let (Some((arrays_s, _)), Some((places_s, ..))) = (self.arrays_rad.first(), self.sun_places.first())
        else {
            return Vec::new();
        };
        let from_s = arrays_s.max(*places_s);
        own.iter().filter(|it| it.at_s >= from_s - CLOCK_S).copied().collect()
    }

    /// The timeline of a plan, as text; with an activity where one is given.
    pub(super) fn text(
        &self,
        mission: &SimulatedMission,
        (windows, dumps, layout): (&[Window], &[PlannedDump], &Layout),
        bodies: &dyn Fn(&PlannedDump) -> Vector3<f64>,
        activity: Option<(&Activity, [f64; 2])>,
    ) -> String {
        let clock = |time_s: f64| self.clock(mission, time_s);
        let (is_in_orbit, frozen_s) = (mission.is_in_orbit(), layout.frozen_until_s);
        let mut commands: Vec<(f64, String)> = Vec::new();
        for kept in &self.commands {
            let is_frozen = kept.at_s < frozen_s - CLOCK_S;
            if kept.status == PlanStatus::Free && !is_frozen {
                continue;
            }
            let ends = kept.until_s.filter(|until_s| kept.status == PlanStatus::Free && *until_s > frozen_s);
            let text = if ends.is_some() { without(&kept.text, "until") } else { kept.text.clone() };
            commands.push((kept.at_s, text));
        }
        let spans = activity.map(|(_, span)| span);
        for window in windows.iter().filter(|window| window.kind == WindowKind::Free) {
            let all = stretches(window);
            for (index, stretch) in all.iter().enumerate() {
                let until_s = all.get(index + 1).map_or(window.stop_s, |next| next.at_s);
                // In an orbit phase science follows.
                let ends = |to_s: f64| is_in_orbit.then(|| clock(to_s));
                let text =
                    |at_s: f64, to_s: f64| command(&clock(at_s), ends(to_s), window, stretch.alternate);
                match spans {
                    Some([from_s, to_s]) if stretch.at_s < to_s && until_s > from_s => {
                        if stretch.at_s < from_s {
                            commands.push((stretch.at_s, text(stretch.at_s, from_s)));
                        }
                        if until_s > to_s {
                            commands.push((to_s, text(to_s, until_s)));
                        }
                    }
                    _ => commands.push((stretch.at_s, text(stretch.at_s, until_s))),
                }
            }
        }
        if let Some((activity, [from_s, to_s])) = activity {
            let head = format!("[[command]]\nat = {}\nuntil = {}\n", clock(from_s), clock(to_s));
            commands.push((from_s, format!("{head}{}", activity.command)));
        }
        let mut panels: Vec<(f64, String)> = Vec::new();
        let arrays_are_frozen = windows.first().is_some_and(|window| window.kind == WindowKind::Frozen);
        if arrays_are_frozen || is_in_orbit {
            let is_kept = |(at_s, _): &&(f64, String)| is_in_orbit || *at_s < frozen_s - CLOCK_S;
            panels.extend(self.panels.iter().filter(is_kept).cloned());
        }
        // Arrays that go on as the frozen timeline has them do not move.
        let before = layout.own.iter().rfind(|it| it.at_s < frozen_s - CLOCK_S && !panels.is_empty());
        let steps = array_steps(windows);
        let stays =
            |first: &ArrayStep| before.is_some_and(|it| ArrayStep::new(first.at_s, &it.controls) == *first);
        for step in steps.iter().skip(usize::from(steps.first().is_some_and(stays))) {
            let mut text =
                format!("[[panels]]\nat = {}\nsunOffset = \"{} deg\"\n", clock(step.at_s), step.offset_deg);
            if step.windmill_deg != 0.0 {
                let _ = writeln!(text, "windmill = \"{} deg\"", step.windmill_deg);
            }
            panels.push((step.at_s, text));
        }
        let mut events = self.events.clone();
        for dump in dumps {
            let after = bodies(dump);
            let text = format!("[[event]]\nat = {}\ndump = {:?}\n", clock(dump.at_s), shown_n_m_s(&after));
            events.push((dump.at_s, text));
        }
        let mut text = String::from("# Written by `heliotorque plan`.\n");
        for mut list in [commands, panels, events] {
            list.sort_by(|a, b| a.0.total_cmp(&b.0));
            for (_, table) in list {
                text.push('\n');
                text.push_str(&table);
            }
        }
        text
    }

    fn clock(&self, mission: &SimulatedMission, time_s: f64) -> String {
        match self.is_dated {
            true => format!("{:?}", dates::utc(mission.zero_s() + time_s)),
            false => format!("{time_s:?}"),
        }
    }
}

/// A downlink of a window.
fn command(at: &str, until: Option<String>, window: &Window, alternate: bool) -> String {
    let [azimuth_deg, elevation_deg] = window.sun_place_rad(alternate).map(shown_deg);
    let until = until.map_or(String::new(), |until| format!("until = {until}\n"));
    let mut text = format!("[[command]]\nat = {at}\n{until}scenario = \"downlink\"\n");
    if azimuth_deg != 0.0 || elevation_deg != 0.0 {
        let _ = writeln!(
            text,
            "sun = {{ azimuth = \"{azimuth_deg} deg\", elevation = \"{elevation_deg} deg\" }}"
        );
    }
    if alternate {
        text.push_str("alternate = true\n");
    }
    text.push_str("status = \"free\"\n");
    text
}

/// The tables of a list as they are written, each with its header and its keys in one line each.
fn tables(document: &DocumentMut, name: &str) -> Vec<String> {
    let Some(list) = document.get(name).and_then(Item::as_array_of_tables) else { return Vec::new() };
    list.iter()
        .map(|table| {
            let entries = table.iter().filter_map(|(key, item)| {
                let value = item.clone().into_value().ok()?;
                let value = value.decorated(" ", "");
                Some(format!("{key} ={value}\n"))
            });
            format!("[[{name}]]\n{}", entries.collect::<String>())
        })
        .collect()
}

/// The table without a key.
fn without(table: &str, key: &str) -> String {
    let is_kept = |line: &&str| !line.starts_with(&format!("{key} ="));
    table.lines().filter(is_kept).map(|line| format!("{line}\n")).collect()
}

#[cfg(test)]
mod tests {
    //! The plan that a timeline commands, for panels on both sides.
    use super::*;

    #[test]
    fn arrays_and_places_are_in_force_from_when_both_are_commanded() {
        let timeline = MissionTimeline {
            // Offset less and plus the windmill angle.
            arrays_rad: vec![(0.0, vec![0.5, 0.7]), (20.0, vec![0.9, 0.9])],
            sun_places: vec![(5.0, [0.1, -0.2], false), (10.0, [-0.1, 0.3], true)],
            ..MissionTimeline::default()
        };
        let own = timeline.own(0.0, &[-1.0, 1.0], &[0.0; 2]);
        let found: Vec<_> = timeline.in_force(&own).iter().map(|it| (it.at_s, it.controls.0)).collect();
        let expected = [
            (5.0, [0.6, 0.1, 0.1, -0.2, 0.0, 0.1, -0.2]),
            (10.0, [0.6, 0.1, 0.1, -0.2, 1.0, -0.1, 0.3]),
            (20.0, [0.9, 0.0, 0.1, -0.2, 1.0, -0.1, 0.3]),
        ];
        assert_eq!(found.len(), expected.len());
        for ((at_s, controls), (expected_s, of)) in found.into_iter().zip(expected) {
            assert_eq!(at_s, expected_s);
            assert!(controls.iter().zip(of).all(|(a, b)| (a - b).abs() < 1e-15), "{controls:?} {of:?}");
        }
        let still = MissionTimeline { arrays_rad: Vec::new(), ..timeline };
        assert_eq!(still.in_force(&own), []);
        let before: Vec<_> =
            still.own(-3.0, &[-1.0, 1.0], &[0.3, 0.3]).iter().map(|it| (it.at_s, it.controls.0)).collect();
        assert_eq!(before[0], (-3.0, [0.3, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]));
        assert_eq!(before.last().unwrap(), &(10.0, [0.3, 0.0, 0.1, -0.2, 1.0, -0.1, 0.3]));
        // A panel of no side that stands elsewhere is neither.
        assert_eq!(still.own(0.0, &[-1.0, 1.0, 0.0], &[0.3, 0.3, 0.4]), []);
    }
}

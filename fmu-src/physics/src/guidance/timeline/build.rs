//! The timeline, from its file: times in order, each command checked.

use std::sync::Arc;

use super::attitude::name;
use super::burn::burn as burn_of;
use super::commands::{Commands, Reader};
use super::description::TimelineDescription;
use super::entry::{
    Slot, TimelineClock, TimelineEntry, TimelineEvent, TimelinePanels, begun, simulation_time_s,
};
use super::events::{event, panels as panels_from};
use super::scans::scan;
use super::times::Times;
use crate::guidance::pointing::command::{PointingCommand, Scenario};
use crate::numerics::Span;
use crate::spacecraft::Spacecraft;
use crate::toml::{Checker, Document, FileError, Place, TIMELINE_LIMITS};

/// Commands, panels and events one after the other; of each list the times grow, and one list at least is not empty.
#[derive(Clone, Debug, PartialEq)]
pub struct Timeline {
    /// Clock of all times.
    pub clock: TimelineClock,
    /// Commands in the order of their times.
    pub entries: Vec<TimelineEntry>,
    /// Name of each command.
    pub names: Vec<String>,
    /// Positions of the panels in the order of their times.
    pub panels: Vec<TimelinePanels>,
    /// Events, each at one time, in the order of the times.
    pub events: Arc<[TimelineEvent]>,
}

impl Timeline {
    /// Reads a timeline from TOML text; `file` only names it in errors; instruments and sets of thrusters are
    /// those of `spacecraft`.
    ///
    /// # Errors
    ///
    /// Text that is not TOML, or all unknown, missing and ill-typed keys, all commands that cannot be carried out and all
    /// times that are out of order, each with line, key, what was found and what is allowed.
    pub fn from_toml(file: &str, text: &str, spacecraft: &Spacecraft) -> Result<Self, FileError> {
        Self::read(file, text, spacecraft, Reader::Guidance)
    }

    /// The same for the plant, which has neither burns with a law of guidance nor modes.
    ///
    /// # Errors
    ///
    /// The same, and commands with a burn or a mode.
    pub fn of_plant(file: &str, text: &str, spacecraft: &Spacecraft) -> Result<Self, FileError> {
        Self::read(file, text, spacecraft, Reader::Plant)
    }

    fn read(file: &str, text: &str, spacecraft: &Spacecraft, reader: Reader) -> Result<Self, FileError> {
        let document = Document::parse(file, text)?.limited(TIMELINE_LIMITS);
        let (description, check) = Checker::read::<TimelineDescription>(&document)?;
        let root = Place::root(&check);
        let mut commands = Commands { spacecraft, reader, scenario: String::new() };
        let [place, panels_place, events_place] = ["command", "panels", "event"].map(|list| root.key(list));
        let list = description.command.as_deref().unwrap_or_default();
        let panels_list = description.panels.as_deref().unwrap_or_default();
        let events_list = description.event.as_deref().unwrap_or_default();
        if list.is_empty() && panels_list.is_empty() && events_list.is_empty() {
            let allowed = "at least one [[command]], [[panels]] or [[event]]";
            root.report("an empty timeline", allowed);
        }
        let mut times = Times::default();
        let spans = times.spans(&place, list.iter().map(|command| (&command.at, command.until.as_ref())));
        let panel_times = times.instants(&panels_place, panels_list.iter().map(|it| &it.at));
        let event_times = times.instants(&events_place, events_list.iter().map(|it| &it.at));
        let clock = times.clock();
        let mut entries = Vec::with_capacity(list.len());
        let mut names = Vec::with_capacity(list.len());
        for (index, ((at, description), &[at_s, until_s])) in place.items(list).zip(&spans).enumerate() {
            let command = commands.pointing(&at, description);
            names.push(name(&at, description));
            let next_s = spans.iter().skip(index + 1).find_map(|[next_s, _]| *next_s);
            let end_s = until_s.or(next_s).unwrap_or(f64::INFINITY);
            let span = Span::new(at_s.unwrap_or(f64::NAN), end_s);
            let burns = command.scenario == Some(Scenario::Burn);
            let burn = description.burn.as_ref().filter(|_| burns);
            let burn = burn.map(|given| burn_of(spacecraft, &at.key("burn"), given, clock, span));
            let scan = scan(&at, description, &command);
            entries.push(TimelineEntry {
                line: at.line(),
                at_s: at_s.unwrap_or(f64::NAN),
                until_s,
                command: PointingCommand { scan, ..command },
                downlink: commands.downlink(&at, description),
                keep_in: commands.keep_in(&at, description.keep_in.as_ref()),
                mode: description.mode,
                burn,
                status: description.status.unwrap_or_default(),
            });
        }
        let panels = panels_place.items(panels_list).zip(panel_times);
        let panels = panels.map(|((at, given), at_s)| panels_from(&at, given, at_s, &spacecraft.panels));
        let (panels, events) = (panels.collect(), events_place.items(events_list).zip(event_times));
        let events = events.map(|((at, given), at_s)| event(spacecraft, &at, given, at_s)).collect();
        check.finish(Self { clock, entries, names, panels, events })
    }

    /// The clock at a time of the simulation, minus that time, in s, the epoch being `epoch_minus_time_s` ahead of it.
    pub fn clock_minus_time_s(&self, epoch_minus_time_s: f64) -> f64 {
        match self.clock {
            TimelineClock::Epoch => epoch_minus_time_s,
            TimelineClock::FmiTime => 0.0,
        }
    }

    /// The command that begins at this time of the timeline's clock, in s.
    pub fn entry_at(&self, at_s: f64) -> Option<&TimelineEntry> {
        self.entries.get(self.entries.binary_search_by(|entry| entry.at_s.total_cmp(&at_s)).ok()?)
    }

    /// Entry in force until `since_s` of the simulation.
    pub fn slot_before(&self, since_s: f64, clock_minus_time_s: f64) -> Slot<'_> {
        self.slot(since_s.next_down(), clock_minus_time_s)
    }

    /// Returns the entry in force at a time of the simulation, in s, the clock being `clock_minus_time_s` ahead of it.
    pub fn slot(&self, now_s: f64, clock_minus_time_s: f64) -> Slot<'_> {
        let entries = &self.entries;
        let time_s = |at_s: f64| simulation_time_s(at_s, clock_minus_time_s);
        let begun = begun(entries, clock_minus_time_s, now_s, |entry| entry.at_s);
        let next_s = entries.get(begun).map_or(f64::INFINITY, |next| time_s(next.at_s));
        let Some(last) = begun.checked_sub(1).and_then(|index| entries.get(index)) else {
            return Slot { entry: None, row: 0, since_s: f64::NEG_INFINITY, until_s: next_s };
        };
        match last.until_s.map(time_s) {
            Some(end_s) if end_s <= now_s => Slot { entry: None, row: 0, since_s: end_s, until_s: next_s },
            end_s => Slot {
                entry: Some(last),
                row: begun,
                since_s: time_s(last.at_s),
                until_s: end_s.unwrap_or(f64::INFINITY).min(next_s),
            },
        }
    }
}

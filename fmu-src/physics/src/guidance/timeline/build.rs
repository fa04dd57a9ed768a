//! The timeline, from its file: times in order, each command checked.

use super::commands::Commands;
use super::description::{CommandDescription, Description};
use super::entry::{TimelineClock, TimelineEntry};
use super::quantity::{Quantity, TIME};
use super::scans::scan;
use crate::environment::dates::{self, ALLOWED_DATE};
use crate::guidance::pointing::command::PointingCommand;
use crate::spacecraft::Instrument;
use crate::toml::{Checker, Document, FileError, Place};

/// Commands one after the other.
#[derive(Clone, Debug, PartialEq)]
pub struct Timeline {
    clock: TimelineClock,
    /// At least one, with times that grow.
    entries: Vec<TimelineEntry>,
}

impl Timeline {
    /// Reads a timeline from TOML text; `file` only names it in errors, `instruments` are those of the spacecraft.
    ///
    /// # Errors
    ///
    /// Text that is not TOML, or all unknown, missing and ill-typed keys, all commands that cannot be carried out and all
    /// times that are out of order, each with line, key, what was found and what is allowed.
    pub fn from_toml(file: &str, text: &str, instruments: &[Instrument]) -> Result<Self, FileError> {
        let document = Document::parse(file, text)?;
        let (description, findings) = document.read::<Description>()?;
        let mut commands = Commands::new(Checker::new(&document, findings), instruments);
        let place = Place::root().key("command");
        let list = &description.command;
        if list.is_empty() {
            commands.check.report(&place, "an empty list", "at least one command");
        }
        let (clock, times) = times(&mut commands.check, &place, list);
        let mut entries = Vec::with_capacity(list.len());
        for ((index, description), [at_s, until_s]) in list.iter().enumerate().zip(times) {
            let at = place.item(index);
            let command = commands.pointing(&at, description);
            let scan = scan(&mut commands, &at, description, &command);
            entries.push(TimelineEntry {
                line: commands.check.line(&at),
                at_s: at_s.unwrap_or(f64::NAN),
                until_s,
                command: PointingCommand { scan, ..command },
                keep_in: commands.keep_in(&at, description.keep_in.as_ref()),
                mode: description.mode,
            });
        }
        commands.check.finish(Self { clock, entries })
    }

    /// By which clock it counts.
    pub fn clock(&self) -> TimelineClock {
        self.clock
    }

    /// The commands in the order of their times.
    pub fn entries(&self) -> &[TimelineEntry] {
        &self.entries
    }

    /// The command in force at a time of the simulation, which is this epoch: the last one that began, unless it ended.
    pub fn entry_at(&self, time_s: f64, epoch_s: f64) -> Option<&TimelineEntry> {
        let now_s = match self.clock {
            TimelineClock::Epoch => epoch_s,
            TimelineClock::FmiTime => time_s,
        };
        let begun = self.entries.partition_point(|entry| entry.at_s <= now_s);
        let last = self.entries.get(begun.checked_sub(1)?)?;
        last.until_s.is_none_or(|until_s| now_s < until_s).then_some(last)
    }
}

/// The clock, and begin and end of each command where they are given and not reported: times of one clock that grow, each end
/// after its beginning and before the next one's.
fn times(
    check: &mut Checker<'_>,
    place: &Place,
    list: &[CommandDescription],
) -> (TimelineClock, Vec<[Option<f64>; 2]>) {
    let mut clock = None;
    let mut read = |place: Place, quantity: &Quantity| {
        let (counted_by, time_s) = instant(check, &place, quantity)?;
        if counted_by == *clock.get_or_insert(counted_by) {
            return Some(time_s);
        }
        let [found, allowed] = match counted_by {
            TimelineClock::Epoch => ["a date", "FMI time, as in the first command: a file has one kind"],
            TimelineClock::FmiTime => ["FMI time", "a date, as in the first command: a file has one kind"],
        };
        check.report(&place, format_args!("{quantity}, {found}"), allowed);
        None
    };
    let mut times = Vec::with_capacity(list.len());
    for (index, description) in list.iter().enumerate() {
        let at = place.item(index);
        let begin_s = read(at.key("at"), &description.at);
        times.push([begin_s, description.until.as_ref().and_then(|until| read(at.key("until"), until))]);
    }
    let mut last: Option<(usize, f64)> = None;
    for (index, (description, [begin_s, end_s])) in list.iter().zip(&times).enumerate() {
        let here = place.item(index);
        let next =
            times[index + 1..].iter().zip(index + 1..).find_map(|([next_s, _], at)| Some((at, (*next_s)?)));
        let Some(begin_s) = *begin_s else { continue };
        if let Some((before, before_s)) = last.filter(|(_, before_s)| begin_s <= *before_s) {
            let (before, relation) =
                (place.item(before), if begin_s == before_s { "when" } else { "before" });
            let found = format!("{}, {relation} {before} begins", description.at);
            check.report(&here.key("at"), found, "a time after the commands above");
        }
        last = Some((index, begin_s));
        let (Some(end_s), Some(written)) = (*end_s, &description.until) else { continue };
        if end_s <= begin_s {
            let allowed = format!("a time after {}", description.at);
            check.report(&here.key("until"), format_args!("{written}, not after `at`"), allowed);
        } else if let Some((next, next_s)) = next
            && begin_s < next_s
            && end_s > next_s
        {
            let found = format!("{written}, after {} begins", place.item(next));
            let allowed = format!("a time up to {}, or no such key", list[next].at);
            check.report(&here.key("until"), found, allowed);
        }
    }
    (clock.unwrap_or(TimelineClock::FmiTime), times)
}

/// A date or FMI time.
fn instant(check: &mut Checker<'_>, at: &Place, quantity: &Quantity) -> Option<(TimelineClock, f64)> {
    let date = match quantity {
        Quantity::Text(text) => Some(text).filter(|text| is_date(text)),
        _ => None,
    };
    if let Some(text) = date {
        return match dates::epoch_s(text) {
            Ok(time_s) => Some((TimelineClock::Epoch, time_s)),
            Err(error) => {
                check.report(at, format_args!("{quantity}, {error}"), ALLOWED_DATE);
                None
            }
        };
    }
    let time_s = quantity.si(&TIME);
    if time_s.is_none() {
        let allowed =
            format!("{ALLOWED_DATE}; or FMI time: a number in s or a string with a unit (\"90 min\")");
        check.report(at, quantity, allowed);
    }
    let time_s = check.finite(at, time_s?);
    time_s.is_finite().then_some((TimelineClock::FmiTime, time_s))
}

fn is_date(text: &str) -> bool {
    dates::looks_like_date(text) || ["UTC", "TDB"].iter().any(|scale| text.trim_end().ends_with(scale))
}

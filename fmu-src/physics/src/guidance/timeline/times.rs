//! Times of a timeline: one clock for all lists, times that grow, each end after its beginning and before the next one's.

use super::entry::TimelineClock;
use super::quantity::{Quantity, TIME};
use crate::environment::dates::{self, ALLOWED_DATE};
use crate::toml::Place;

/// Reads the times of the lists one after the other.
#[derive(Default)]
pub(super) struct Times {
    clock: Option<TimelineClock>,
}

impl Times {
    /// The one clock of all times.
    pub(super) fn clock(&self) -> TimelineClock {
        self.clock.unwrap_or(TimelineClock::FmiTime)
    }

    fn read(&mut self, place: &Place<'_>, quantity: &Quantity) -> Option<f64> {
        let (counted_by, time_s) = instant(place, quantity)?;
        if counted_by == *self.clock.get_or_insert(counted_by) {
            return Some(time_s);
        }
        let [found, allowed] = match counted_by {
            TimelineClock::Epoch => ["a date", "FMI time, as the first time in it: a file has one kind"],
            TimelineClock::FmiTime => ["FMI time", "a date, as the first time in it: a file has one kind"],
        };
        place.report(format_args!("{quantity}, {found}"), allowed);
        None
    }

    /// Times of a list of what has no end; NaN where they are reported.
    pub(super) fn instants<'q>(
        &mut self,
        place: &Place<'_>,
        list: impl Iterator<Item = &'q Quantity>,
    ) -> Vec<f64> {
        let spans = self.spans(place, list.map(|at| (at, None)));
        spans.into_iter().map(|[at_s, _]| at_s.unwrap_or(f64::NAN)).collect()
    }

    /// Begin and end of each item where they are given and not reported.
    pub(super) fn spans<'q>(
        &mut self,
        place: &Place<'_>,
        list: impl Iterator<Item = (&'q Quantity, Option<&'q Quantity>)>,
    ) -> Vec<[Option<f64>; 2]> {
        let list: Vec<_> = list.collect();
        let mut times = Vec::with_capacity(list.len());
        for (index, (at, until)) in list.iter().enumerate() {
            let here = place.item(index);
            let begin_s = self.read(&here.key("at"), at);
            times.push([begin_s, until.and_then(|until| self.read(&here.key("until"), until))]);
        }
        let mut last: Option<(usize, f64)> = None;
        for (index, ((at, until), [begin_s, end_s])) in list.iter().zip(&times).enumerate() {
            let here = place.item(index);
            let Some(begin_s) = *begin_s else { continue };
            if let Some((before, before_s)) = last.filter(|(_, before_s)| begin_s <= *before_s) {
                let (before, relation) =
                    (place.item(before), if begin_s == before_s { "when" } else { "before" });
                let found = format!("{at}, {relation} {before} begins");
                here.key("at").report(found, "a time after those above");
            }
            last = Some((index, begin_s));
            let (Some(end_s), Some(written)) = (*end_s, until) else { continue };
            let next = times[index + 1..].iter().zip(index + 1..);
            let next = next.into_iter().find_map(|([next_s, _], at)| Some((at, (*next_s)?)));
            if end_s <= begin_s {
                let allowed = format!("a time after {at}");
                here.key("until").report(format_args!("{written}, not after `at`"), allowed);
            } else if let Some((next, next_s)) = next
                && begin_s < next_s
                && end_s > next_s
            {
                let found = format!("{written}, after {} begins", place.item(next));
                let allowed = format!("a time up to {}, or no such key", list[next].0);
                here.key("until").report(found, allowed);
            }
        }
        times
    }
}

/// A date or FMI time.
pub(super) fn instant(at: &Place<'_>, quantity: &Quantity) -> Option<(TimelineClock, f64)> {
    if let Some(text) = date(quantity) {
        let refuse = |error| at.report(format_args!("{quantity}, {error}"), ALLOWED_DATE);
        return Some((TimelineClock::Epoch, dates::epoch_s(text).map_err(refuse).ok()?));
    }
    let allowed = format!("{ALLOWED_DATE}; or FMI time: a number in s or a string with a unit (\"90 min\")");
    let time_s = at.finite(at.known(quantity.si(&TIME), quantity, allowed)?);
    time_s.is_finite().then_some((TimelineClock::FmiTime, time_s))
}

/// Whether it is meant as a date.
pub(super) fn is_date(quantity: &Quantity) -> bool {
    date(quantity).is_some()
}

fn date(quantity: &Quantity) -> Option<&str> {
    let Quantity::Text(text) = quantity else { return None };
    dates::looks_like_date(text).then_some(text)
}

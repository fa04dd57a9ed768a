//! An instant of a timeline: a date or FMI time.

use super::entry::TimelineClock;
use super::quantity::{Quantity, TIME};
use crate::environment::dates::{self, ALLOWED_DATE};
use crate::toml::Place;

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

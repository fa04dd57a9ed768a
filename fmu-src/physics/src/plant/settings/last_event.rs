//! The last event of a kind: its time, and its number at that time.

use serde::{Deserialize, Serialize};

/// The last event of a kind. In a schedule it is a place by time, which counts in any other schedule too: events before `time_s` are
/// over, and `count` of those at it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct LastEvent {
    /// Time of the event, in s.
    pub time_s: f64,
    /// Number of events at that time.
    pub count: u32,
}

impl LastEvent {
    /// Returns the place before the events at `time_s`.
    pub(crate) fn before(time_s: f64) -> Self {
        Self { time_s, count: 0 }
    }

    /// Returns the place after all events up to `time_s`.
    pub(crate) fn until(time_s: f64) -> Self {
        Self { time_s, count: u32::MAX }
    }

    /// Goes on to `time_s`: what another schedule had before it is over.
    pub(crate) fn skip_to(&mut self, time_s: f64) {
        if self.time_s < time_s {
            *self = Self::before(time_s);
        }
    }

    /// Counts an event at `time_s`.
    pub(crate) fn take(&mut self, time_s: f64) {
        let count = if self.time_s == time_s { self.count } else { 0 };
        *self = Self { time_s, count: count.saturating_add(1) };
    }
}

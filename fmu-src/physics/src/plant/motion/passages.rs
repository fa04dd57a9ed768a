//! Passages nearest to a body: sought span after span as a path is integrated, and kept in a log.
//!
//! Equation: r . v = 0, rising: position times velocity relative to the body.
//! Method: changes of sign on the dense output of each span. Where a path is computed anew, a passage at the edge of two spans may
//! fall between them; so the search remembers where a span ended with the spacecraft approaching.
//! Error measure: that of [`crate::numerics::events`].

use serde::{Deserialize, Serialize};

use crate::environment::CartesianState;
use crate::numerics::Span;
use crate::numerics::events::first_crossing;

/// Events kept: one may lie ahead of the present time, one may be too recent for its window.
pub(super) const KEPT: usize = 3;
/// Spacing of the clocks of ephemerides, s, by which positions over time are rounded.
const CLOCK_SPACING_S: f64 = 1.2e-7;

/// Event at a time.
pub(super) trait Timed: Copy {
    /// Time, s.
    fn at_s(&self) -> f64;
}

impl Timed for f64 {
    fn at_s(&self) -> f64 {
        *self
    }
}

/// Last events of one kind, the latest first; some may lie after the present time.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct EventLog<T>(pub [Option<T>; KEPT]);

impl<T: Timed> EventLog<T> {
    /// Adds an event after all others.
    pub(super) fn push(&mut self, event: T) {
        self.0.rotate_right(1);
        self.0[0] = Some(event);
    }

    /// Number of events after `time_s`.
    pub(super) fn count_after(&self, time_s: f64) -> u32 {
        self.0.iter().flatten().filter(|event| event.at_s() > time_s).count() as u32
    }

    /// Last event until `time_s`.
    pub(super) fn until(&self, time_s: f64) -> Option<T> {
        self.0.into_iter().flatten().find(|event| event.at_s() <= time_s)
    }

    /// First event after `time_s`.
    pub(super) fn first_after(&self, time_s: f64) -> Option<T> {
        self.0.into_iter().rev().flatten().find(|event| event.at_s() > time_s)
    }

    /// Discards the events after `time_s`; returns their number.
    pub(super) fn truncate(&mut self, time_s: f64) -> u32 {
        let discarded = self.count_after(time_s);
        for _ in 0..discarded {
            self.0[0] = None;
            self.0.rotate_left(1);
        }
        discarded
    }
}

/// Search for passages nearest to a body on spans that follow one another.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct PassageSearch {
    /// Time, s, from which the search goes on, the spacecraft approaching there; absent where it was receding or nothing was
    /// searched.
    approaching_at_s: Option<f64>,
}

impl PassageSearch {
    /// Goes on at `time_s`, where the path changes, after passages ahead were discarded or not.
    pub(super) fn resume_at(&mut self, time_s: f64, has_discarded: bool) {
        if has_discarded {
            self.approaching_at_s = Some(time_s);
        }
    }

    /// Tells whether the signs at the ends of `span` exclude a passage, as they do on a span shorter than half a revolution.
    pub(super) fn excludes(&mut self, span: Span, mut path: impl FnMut(f64) -> CartesianState) -> bool {
        let was_approaching =
            self.approaching_at_s == Some(span.start_s) || path(span.start_s).radial_m2_s() < 0.0;
        let is_approaching = path(span.end_s).radial_m2_s() < 0.0;
        if !was_approaching || is_approaching {
            self.approaching_at_s = is_approaching.then_some(span.end_s);
            return true;
        }
        false
    }

    /// Reports the passages in `span` with the state there, `path` being the spacecraft from the body.
    pub(super) fn search(
        &mut self,
        span: Span,
        mut path: impl FnMut(f64) -> CartesianState,
        mut report: impl FnMut(f64, &CartesianState),
    ) {
        let start = path(span.start_s);
        if self.approaching_at_s == Some(span.start_s) && start.radial_m2_s() >= 0.0 {
            report(span.start_s, &start);
        }
        let mut rest = span;
        while let Some(at_s) = first_crossing(rest, CLOCK_SPACING_S, |at_s| -path(at_s).radial_m2_s()) {
            report(at_s, &path(at_s));
            rest.start_s = at_s;
        }
        self.approaching_at_s = (path(span.end_s).radial_m2_s() < 0.0).then_some(span.end_s);
    }
}

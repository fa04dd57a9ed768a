//! Closest approaches to the encounter's body, found as the path is integrated.

use serde::{Deserialize, Serialize};

use super::passages::{EventLog, PassageSearch, Timed};
use crate::environment::CartesianState;
use crate::momentum::after_event_s;
use crate::numerics::Span;

/// A closest approach.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ClosestApproach {
    /// When, in s.
    pub at_s: f64,
    /// Height above the body's radius, in m.
    pub altitude_m: f64,
}

impl Timed for ClosestApproach {
    fn at_s(&self) -> f64 {
        self.at_s
    }
}

/// Closest approaches that were found; some may lie after the present time.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ClosestApproaches {
    count: i32,
    log: EventLog<ClosestApproach>,
    search: PassageSearch,
}

impl ClosestApproaches {
    /// Rejects decoded states that no simulation can produce.
    pub(crate) fn is_valid(&self) -> bool {
        self.count >= 0
    }

    /// How many there were until `time_s`, and the last of them.
    pub fn until(&self, time_s: f64) -> (i32, Option<ClosestApproach>) {
        let ahead = self.log.count_after(time_s);
        (self.count.saturating_sub_unsigned(ahead), self.log.until(time_s))
    }

    /// The first one that was found beyond `time_s`.
    pub(crate) fn after(&self, time_s: f64) -> Option<ClosestApproach> {
        self.log.first_after(time_s)
    }

    /// Discards those after `time_s`; the path is searched again from there.
    pub(crate) fn truncate(&mut self, time_s: f64) {
        let discarded = self.log.truncate(time_s);
        self.count = self.count.saturating_sub_unsigned(discarded);
        self.search.resume_at(time_s, discarded > 0);
    }

    /// Records closest approaches within a span, `path` being the spacecraft from a body of `radius_m` there; those beyond
    /// `sphere_m` are none.
    pub(crate) fn detect(
        &mut self,
        span: Span,
        [radius_m, sphere_m]: [f64; 2],
        path: impl FnMut(f64) -> CartesianState,
    ) {
        let Self { count, log, search } = self;
        search.search(span, path, |at_s, state| {
            let distance_m = state.position_m.norm();
            // A passage at the edge of two spans is one.
            let is_new = log.until(f64::INFINITY).is_none_or(|last| at_s >= after_event_s(last.at_s));
            if distance_m <= sphere_m && is_new {
                *count = count.saturating_add(1);
                log.push(ClosestApproach { at_s, altitude_m: distance_m - radius_m });
            }
        });
    }
}

//! Periapses of an integrated orbit, and of a two-body orbit before a maneuver.

use serde::{Deserialize, Serialize};

use super::passages::{EventLog, KEPT, PassageSearch};
use crate::environment::orbit::{DisturbedOrbit, TwoBodyOrbit};
use crate::numerics::Span;
use crate::plant::settings::configuration::Configuration;

/// Two passages closer together than this part of a revolution are one, found twice.
const SAME_PASSAGE: f64 = 1e-3;
/// Time of a passage before all that are kept, s; finite, for windows are computed from it.
const BEFORE_ALL_TIME_S: f64 = -1e100;

/// Periapses passed, counted as the two-body orbit at the start counts them (number 0 is the one nearest to the start).
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Periapses {
    /// Number of the last one found.
    number: i64,
    found_s: EventLog<f64>,
    /// Periapses whose number is a multiple of the schedule's.
    scheduled_s: EventLog<f64>,
    search: PassageSearch,
}

impl Periapses {
    /// Returns the periapses of the two-body orbit at the start until `epoch_s`.
    pub(super) fn before(configuration: &Configuration, epoch_s: f64) -> Self {
        let orbit = &configuration.orbit;
        let period_s = orbit.period_s();
        if !period_s.is_finite() {
            return Self::default();
        }
        // A start at periapsis counts as past it, whatever the rounding.
        let number = orbit.orbit_number(epoch_s + SAME_PASSAGE * period_s);
        let at_s = |number: i64| Some(orbit.periapsis_epoch_s(number) - configuration.epoch_minus_time_s);
        let every = every(configuration);
        let first = number - number.rem_euclid(every);
        Self {
            number,
            found_s: EventLog(core::array::from_fn(|back| at_s(number - back as i64))),
            scheduled_s: EventLog(core::array::from_fn(|back| at_s(first - every * back as i64))),
            search: PassageSearch::default(),
        }
    }

    /// Rejects decoded states that no simulation can produce.
    pub(super) fn is_valid(&self) -> bool {
        self.number.unsigned_abs() < 1 << 60
    }

    /// Time of the last one found, s.
    pub(super) fn last_s(&self) -> f64 {
        self.last_until_s(f64::INFINITY)
    }

    /// Time of the last one until `time_s`, s.
    pub(super) fn last_until_s(&self, time_s: f64) -> f64 {
        self.found_s.until(time_s).unwrap_or(BEFORE_ALL_TIME_S)
    }

    /// Times of those of the schedule, the latest first, s.
    pub(super) fn scheduled_s(&self) -> [f64; KEPT] {
        self.scheduled_s.0.map(|at_s| at_s.unwrap_or(BEFORE_ALL_TIME_S))
    }

    /// Discards those after `time_s`; the orbit is searched again from there.
    pub(super) fn truncate(&mut self, time_s: f64) {
        let discarded = self.found_s.truncate(time_s);
        self.number -= i64::from(discarded);
        self.scheduled_s.truncate(time_s);
        self.search.resume_at(time_s, discarded > 0);
    }

    /// Returns these without the next one of the schedule, for an orbit that does not come to it.
    pub(super) fn without_next(mut self) -> Self {
        self.truncate(self.last_s());
        self
    }

    /// Records a periapsis within this span of the present segment.
    pub(super) fn detect(&mut self, configuration: &Configuration, orbit: &DisturbedOrbit, span: Span) {
        let period_s = configuration.orbit.period_s();
        let path = |at_s: f64| orbit.state_at(at_s);
        if !period_s.is_finite() || self.search.excludes(span, path) {
            return;
        }
        let Self { number, found_s, scheduled_s, search } = self;
        search.search(span, path, |at_s, _| {
            if found_s.until(f64::INFINITY).is_some_and(|last_s| at_s - last_s < SAME_PASSAGE * period_s) {
                return;
            }
            found_s.push(at_s);
            *number += 1;
            if number.rem_euclid(every(configuration)) == 0 {
                scheduled_s.push(at_s);
            }
        });
    }

    /// Returns these and those of a two-body `orbit` that follows over `span`; of those of the schedule the next one too.
    pub(super) fn continued(&self, configuration: &Configuration, orbit: &TwoBodyOrbit, span: Span) -> Self {
        let period_s = orbit.period_s();
        if period_s.is_infinite() {
            return *self;
        }
        let to_epoch_s = configuration.epoch_minus_time_s;
        let at_s = |number: i64| orbit.periapsis_epoch_s(number) - to_epoch_s;
        // A maneuver at periapsis moves it: that is one passage, not two.
        let mut first = orbit.orbit_number(span.start_s + to_epoch_s) + 1;
        if at_s(first) - self.last_s() < SAME_PASSAGE * period_s {
            first += 1;
        }
        let count = (orbit.orbit_number(span.end_s + to_epoch_s) - first + 1).max(0);
        let number = self.number + count;
        // Passage with this number, counted from the last one before the maneuver.
        let passage_s = |k: i64| match usize::try_from(-k) {
            Ok(back) => self.found_s.0.get(back).copied().flatten(),
            Err(_) => Some(at_s(first + k - 1)),
        };
        let every = every(configuration);
        let [latest, latest_before] = [number, self.number].map(|it| it - it.rem_euclid(every));
        let scheduled_s = core::array::from_fn(|back| {
            let scheduled = latest + every - every * back as i64;
            if scheduled > self.number {
                return passage_s(scheduled - self.number);
            }
            let index = usize::try_from((latest_before - scheduled) / every).unwrap_or(KEPT);
            self.scheduled_s.0.get(index).copied().flatten()
        });
        let found_s = EventLog(core::array::from_fn(|back| passage_s(count - back as i64)));
        Self { number, found_s, scheduled_s: EventLog(scheduled_s), search: self.search }
    }
}

fn every(configuration: &Configuration) -> i64 {
    configuration.attitude.guided().map_or(1, |guided| i64::from(guided.schedule.every.max(1)))
}

//! Watches one direction pass one sensor, once a turn.

use core::f64::consts::PI;

use serde::{Deserialize, Serialize};

use super::crossing::{Crossing, SLOWEST_RAD_S};
use super::{motion::Motion, work::Work};

/// Between these lies every time between two crossings in a state that is one: what is divided by it stays finite.
const SHORTEST_PERIOD_S: f64 = 1e-12;
/// See [`SHORTEST_PERIOD_S`].
const LONGEST_PERIOD_S: f64 = 1e100;

/// Crossings of one direction, one after the other.
///
/// A crossing within half a turn of the last does not count. The next one is looked for only when time comes near it,
/// within the motion's present segment and always from the same instant, so that it does not depend on how often somebody
/// asks.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct CrossingDetector {
    /// The last crossing, in s.
    pub last_s: Option<f64>,
    /// Time between the last two, in s.
    pub period_s: Option<f64>,
    /// The same, one crossing earlier, in s.
    pub period_before_s: Option<f64>,
    /// How many so far.
    pub count: u64,
    search_from_s: f64,
    /// The next crossing, once it was looked for; `Some(None)` if there is none on this motion.
    next_s: Option<Option<f64>>,
}

impl CrossingDetector {
    /// Watches from `start_s` on.
    pub fn new(start_s: f64) -> Self {
        Self { search_from_s: start_s, ..Self::default() }
    }

    /// Whether a decoded detector can be one.
    pub fn is_valid(&self) -> bool {
        let times = [self.last_s, Some(self.search_from_s), self.next_s.flatten()];
        let periods = [self.period_s, self.period_before_s];
        times.iter().flatten().all(|at_s| at_s.abs() <= LONGEST_PERIOD_S)
            && periods
                .iter()
                .flatten()
                .all(|&period_s| (SHORTEST_PERIOD_S..=LONGEST_PERIOD_S).contains(&period_s))
    }

    /// The motion, its segment or the direction changed: what was predicted is void.
    pub fn forget(&mut self, now_s: f64) {
        self.next_s = None;
        self.search_from_s = self.search_from_s.max(now_s);
    }

    /// The next crossing if it comes at or before `until_s`.
    #[inline]
    pub fn due_s(
        &mut self,
        motion: &Motion,
        crossing: impl FnOnce() -> Crossing,
        until_s: f64,
        work: &mut Work,
    ) -> Option<f64> {
        if until_s < self.search_from_s {
            return None;
        }
        let next_s = match self.next_s {
            Some(next_s) => next_s,
            None => {
                let found = crossing().here_s(motion, self.search_from_s, work);
                self.next_s = Some(found);
                found
            }
        };
        next_s.filter(|&next_s| next_s <= until_s)
    }

    /// Records the crossing at `time_s` of a body that spins at `rate_rad_s`.
    pub fn pass(&mut self, time_s: f64, rate_rad_s: f64) {
        self.period_before_s = self.period_s;
        self.period_s = self.last_s.map(|last_s| time_s - last_s);
        self.last_s = Some(time_s);
        self.count = self.count.wrapping_add(1);
        // Half a turn of a slower body is not waited for.
        self.search_from_s = time_s + PI / rate_rad_s.max(SLOWEST_RAD_S);
        self.next_s = None;
    }
}

//! Closest approaches to the encounter's body, found as the path is integrated.

use serde::{Deserialize, Serialize};

use crate::environment::CartesianState;
use crate::numerics::roots;

/// Pieces of a segment at whose ends the radial velocity is looked at.
const PIECES: u32 = 8;

/// A closest approach.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ClosestApproach {
    /// When, in s.
    pub at_s: f64,
    /// Height above the body's radius, in m.
    pub altitude_m: f64,
}

/// Closest approaches that were found; some may lie after the present time.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct ClosestApproaches {
    count: i32,
    /// The last one and the one before it.
    last: [Option<ClosestApproach>; 2],
    /// Whether the spacecraft came nearer where the last span ended, on which the next one continues: computed anew it may have the
    /// other sign.
    was_approaching: Option<bool>,
}

impl ClosestApproaches {
    /// Rejects decoded states that no simulation can produce.
    pub(crate) fn is_valid(&self) -> bool {
        self.count >= 0
    }

    /// How many there were until `time_s`, and the last of them.
    pub(crate) fn until(&self, time_s: f64) -> (i32, Option<ClosestApproach>) {
        match self.last {
            [Some(ahead), before] if ahead.at_s > time_s => (self.count - 1, before),
            [last, _] => (self.count, last),
        }
    }

    /// The first one that was found beyond `time_s`.
    pub(crate) fn after(&self, time_s: f64) -> Option<ClosestApproach> {
        let [last, before] = self.last;
        [before, last].into_iter().flatten().find(|approach| approach.at_s > time_s)
    }

    /// Forgets one found beyond `time_s`: it will be met again.
    pub(crate) fn forget_after(&mut self, time_s: f64) {
        self.was_approaching = None;
        if let [Some(ahead), before] = self.last
            && ahead.at_s > time_s
        {
            *self = Self { count: self.count - 1, last: [before, None], was_approaching: None };
        }
    }

    /// Takes note of closest approaches within a span, `path` being the spacecraft from a body of `radius_m` there; those beyond
    /// `sphere_m` are none.
    pub(crate) fn detect(
        &mut self,
        [start_s, end_s]: [f64; 2],
        [radius_m, sphere_m]: [f64; 2],
        mut path: impl FnMut(f64) -> CartesianState,
    ) {
        let mut radial = |at_s: f64| {
            let state = path(at_s);
            state.position_m.dot(&state.velocity_m_s)
        };
        let mut found = [None; PIECES as usize];
        let mut from_s = start_s;
        let mut comes_nearer = self.was_approaching.unwrap_or_else(|| radial(start_s) < 0.0);
        for piece in 1..=PIECES {
            let to_s = start_s + (end_s - start_s) * f64::from(piece) / f64::from(PIECES);
            let now = radial(to_s);
            if comes_nearer && now >= 0.0 {
                let is_there = radial(from_s) >= 0.0;
                let root =
                    if is_there { Ok(from_s) } else { roots::bracketed(from_s, to_s, 0.0, &mut radial) };
                found[piece as usize - 1] = root.ok();
            }
            (from_s, comes_nearer) = (to_s, now < 0.0);
        }
        self.was_approaching = Some(comes_nearer);
        for at_s in found.into_iter().flatten() {
            let distance_m = path(at_s).position_m.norm();
            if distance_m <= sphere_m {
                let approach = ClosestApproach { at_s, altitude_m: distance_m - radius_m };
                self.count = self.count.saturating_add(1);
                self.last = [Some(approach), self.last[0]];
            }
        }
    }
}

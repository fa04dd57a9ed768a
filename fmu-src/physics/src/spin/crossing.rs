//! When a direction fixed in inertial space passes a direction fixed in the spinning body, once and turn after turn.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::{
    motion::Motion,
    work::{Work, WorkKind},
};
use crate::attitude::RigidBodyState;
use crate::math;
use crate::numerics::spacing::spacing;

/// About which axis the angle is counted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pole {
    /// The body's third axis: what a sensor sees.
    SpinAxis,
    /// The angular momentum: what a thruster does.
    Momentum,
}

/// A crossing to look for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// Direction in the body.
    pub body: Vector3<f64>,
    /// Direction in inertial space.
    pub inertial: Vector3<f64>,
    /// Axis of the angle between them.
    pub pole: Pole,
}

/// How many turns are searched before a crossing counts as absent.
const TURNS_SEARCHED: f64 = 2.5;

/// A body that is past a direction by no more than this has just reached it: segments meet to rounding only.
const ROUNDING_RAD: f64 = 1e-12;
/// The search on the closed form has converged at this angle.
const CONVERGED_RAD: f64 = 1e-9;
/// A body slower than this is no spinner: nothing is searched for.
const SLOWEST_RAD_S: f64 = 1e-4;
/// Between these lies every time between two crossings in a state that is one: what is divided by it stays finite.
const SHORTEST_PERIOD_S: f64 = 1e-12;
/// See [`SHORTEST_PERIOD_S`].
const LONGEST_PERIOD_S: f64 = 1e100;

/// To what a time on a motion is known, in s: by the spacing of doubles at that time and at its distance from the anchor.
fn rounding_s(motion: &Motion, time_s: f64) -> f64 {
    spacing(time_s.abs().max((time_s - motion.anchor_s()).abs()))
}

/// How far a body of spin rate `rate_rad_s` may seem to be off a direction for that: precession and the turn about its own
/// axis are each at most about twice as fast as the spin.
fn phase_rounding_rad(motion: &Motion, rate_rad_s: f64, time_s: f64) -> f64 {
    8.0 * rate_rad_s * rounding_s(motion, time_s)
}

impl Crossing {
    /// Angle about the pole by which the body still has to turn, -pi..pi, in rad.
    #[inline]
    fn ahead_rad(&self, state: &RigidBodyState) -> f64 {
        let seen = state.attitude.body_from_inertial(&self.inertial);
        if self.pole == Pole::SpinAxis {
            let (x, y) = (self.body.x, self.body.y);
            return math::atan2(x * seen.y - y * seen.x, x * seen.x + y * seen.y);
        }
        let pole = state.momentum_body.normalize();
        let sine = pole.dot(&self.body.cross(&seen));
        let cosine = self.body.dot(&seen) - pole.dot(&self.body) * pole.dot(&seen);
        math::atan2(sine, cosine)
    }

    /// First crossing at or after `from_s`, a time within the motion's present segment or after it; `None` if the body
    /// does not bring the direction round within 2 1/2 turns.
    pub fn next_s(&self, motion: &Motion, from_s: f64, work: &mut Work) -> Option<f64> {
        work.spend(WorkKind::Crossing);
        let inertia = &motion.inertia;
        if motion.segment_end_s().is_infinite() {
            let state = motion.at(from_s);
            return self.on_closed_form(motion, from_s, &state, state.rate_rad_s(inertia).z);
        }
        let mut segment = motion.clone();
        while segment.segment_end_s() < from_s && !segment.diverges() && !work.is_exhausted() {
            work.spend_segment(&segment.damper);
            segment.next_segment();
        }
        let rate = segment.at(from_s).rate_rad_s(inertia).z;
        if rate.is_nan() || rate <= SLOWEST_RAD_S {
            return None;
        }
        let give_up_s = from_s + TURNS_SEARCHED * 2.0 * core::f64::consts::PI / rate;
        let mut start_s = from_s;
        loop {
            let end_s = segment.segment_end_s();
            if let Some(time_s) = self.within(&segment, start_s, end_s, rate) {
                return Some(time_s);
            }
            if end_s > give_up_s || segment.diverges() || work.is_exhausted() {
                return None;
            }
            start_s = end_s;
            work.spend_segment(&segment.damper);
            segment.next_segment();
        }
    }

    /// First crossing at or after `from_s` on the closed form, or within the present segment; `None` if there is none.
    pub fn here_s(&self, motion: &Motion, from_s: f64, work: &mut Work) -> Option<f64> {
        let end_s = motion.segment_end_s();
        if end_s.is_infinite() {
            return self.next_s(motion, from_s, work);
        }
        if from_s >= end_s {
            return None;
        }
        work.spend(WorkKind::Crossing);
        let rate = motion.at(from_s).rate_rad_s(&motion.inertia).z.abs();
        self.within(motion, from_s, end_s, rate)
    }

    /// Secant iteration from the guess of a uniform turn.
    fn on_closed_form(&self, motion: &Motion, from_s: f64, state: &RigidBodyState, rate: f64) -> Option<f64> {
        if rate.is_nan() || rate <= SLOWEST_RAD_S {
            return None;
        }
        let turn = 2.0 * core::f64::consts::PI;
        let mut ahead = self.ahead_rad(state);
        if ahead < -(ROUNDING_RAD + phase_rounding_rad(motion, rate, from_s)) {
            ahead += turn;
        }
        let (mut last_s, mut last_ahead) = (from_s, ahead);
        let mut time_s = from_s + ahead / rate;
        for _ in 0..40 {
            ahead = self.ahead_rad(&motion.at(time_s));
            if ahead.abs() <= 2e-16 {
                break;
            }
            let slope = (ahead - last_ahead) / (time_s - last_s);
            let step_s = if slope < -0.2 * rate { -ahead / slope } else { ahead / rate };
            (last_s, last_ahead) = (time_s, ahead);
            time_s += step_s;
            if step_s.abs() <= 4.0 * rounding_s(motion, time_s).max(spacing(turn / rate)) {
                break;
            }
        }
        let reached_rad = CONVERGED_RAD + phase_rounding_rad(motion, rate, time_s);
        let converged = ahead.abs() < reached_rad && time_s - from_s < TURNS_SEARCHED * turn / rate;
        (converged && time_s >= from_s - reached_rad / rate).then_some(time_s)
    }

    /// The crossing between two times of one segment, by bisection sharpened with secants.
    fn within(&self, segment: &Motion, start_s: f64, end_s: f64, rate: f64) -> Option<f64> {
        let (mut low_s, mut high_s) = (start_s, end_s);
        let mut low = self.ahead_rad(&segment.at(low_s));
        let mut high = self.ahead_rad(&segment.at(high_s));
        // From ahead to behind, not through the far side where the angle wraps.
        let before = -(ROUNDING_RAD + phase_rounding_rad(segment, rate, start_s));
        if !(low >= before && high < 0.0 && low - high < core::f64::consts::PI) {
            return None;
        }
        if low <= 0.0 {
            return Some(low_s);
        }
        let step_s = spacing(low_s.abs().max(high_s.abs()));
        for round in 0..80 {
            let middle_s = 0.5 * (low_s + high_s);
            if middle_s <= low_s || middle_s >= high_s {
                break;
            }
            // Never the end itself: a crossing next to it is found by the double before it.
            let secant_s = low_s + (high_s - low_s) * (low / (low - high));
            let inside_s = secant_s.max(low_s + step_s).min(high_s - step_s);
            let time_s =
                if round % 3 == 2 || inside_s <= low_s || inside_s >= high_s { middle_s } else { inside_s };
            let ahead = self.ahead_rad(&segment.at(time_s));
            if ahead >= 0.0 {
                (low_s, low) = (time_s, ahead);
            } else {
                (high_s, high) = (time_s, ahead);
            }
            if low == 0.0 {
                break;
            }
        }
        Some(low_s)
    }
}

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
        let from_s = self.search_from_s;
        let next_s = self.next_s.get_or_insert_with(|| crossing().here_s(motion, from_s, work));
        next_s.filter(|&next_s| next_s <= until_s)
    }

    /// Records the crossing at `time_s` of a body that spins at `rate_rad_s`.
    pub fn pass(&mut self, time_s: f64, rate_rad_s: f64) {
        self.period_before_s = self.period_s;
        self.period_s = self.last_s.map(|last_s| time_s - last_s);
        self.last_s = Some(time_s);
        self.count = self.count.wrapping_add(1);
        // Half a turn of a slower body is not waited for.
        self.search_from_s = time_s + core::f64::consts::PI / rate_rad_s.max(SLOWEST_RAD_S);
        self.next_s = None;
    }
}

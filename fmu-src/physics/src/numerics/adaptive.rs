//! Length of a Chebyshev segment, adapted until its last terms fall below a tolerance.
//!
//! Equation: none; a function of time is interpolated by `N` Chebyshev terms on `[start, end]`, whose end is sought.
//! Method: start long, and shorten while the error measure exceeds the tolerance. Where a function is smooth its last
//! terms fall like the length to the power `N`, so a length times `0.9 (tolerance / unresolved)^(1/N)` is what the
//! tolerance allows; one attempt shortens to 0.1 to 0.7 of its length, and the next segment is tried at 0.5 to 4 times
//! this one's.
//! Error measure: the greatest magnitude among the last two terms, chosen by the caller per quantity. Two, because a
//! function that is even or odd about the middle has no other.
//! Reference: Boyd, Chebyshev and Fourier Spectral Methods, 2.12 (the last coefficient as a measure of truncation);
//! Press et al., Numerical Recipes, 17.2 (control of a step by the power of its error).

use serde::{Deserialize, Serialize};

use super::Span;
use super::intervals::next_multiple_s;
use super::or_infinite;
use crate::math;

/// Fraction of the length that the estimate allows which is used.
const SAFETY: f64 = 0.9;

/// Outcome of an attempt to fit a function over an interval.
#[derive(Clone, Debug, PartialEq)]
pub enum Attempt<T, E> {
    /// Fit to be judged.
    Fitted {
        /// The fit.
        fit: T,
        /// Error measure.
        unresolved: f64,
        /// Largest error measure that is accepted.
        tolerance: f64,
    },
    /// Fit over an interval so short that its error measure says nothing of the length the tolerance allows.
    Short(T),
    /// An event inside the interval, s, at which the segment has to end.
    Event(f64),
    /// Reason why the function has no value somewhere in the interval.
    Undefined(E),
}

/// Interval of the segment that is being fitted, from its start to the end of the present attempt.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AdaptiveInterval {
    start_s: f64,
    end_s: f64,
    longest_s: f64,
    shortest_s: f64,
    shortened: bool,
}

impl AdaptiveInterval {
    /// From `start_s` to the next multiple of `grid_s` or sooner: after `longest_s`, the length that the segment before
    /// expects the tolerance to allow, or at `limit_s`. It is never without length, whatever a restored state expects,
    /// and not shortened for the tolerance once it lasts `shortest_s` or less.
    pub fn new(start_s: f64, grid_s: f64, longest_s: f64, limit_s: f64, shortest_s: f64) -> Self {
        let end_s =
            next_multiple_s(start_s, grid_s).min(start_s + longest_s).min(limit_s).max(start_s.next_up());
        Self { start_s, end_s, longest_s, shortest_s, shortened: false }
    }

    /// End of this attempt, in s.
    pub fn end_s(&self) -> f64 {
        self.end_s
    }

    /// Ends at an event: that says nothing of the length the tolerance allows.
    pub fn end_at(&mut self, end_s: f64) {
        self.end_s = end_s;
    }

    /// Tells whether an attempt failed and this one is shorter.
    pub fn is_refinement(&self) -> bool {
        self.shortened
    }

    /// Fits a segment of `terms` terms: repeats `attempt`, on a shorter interval each time, until the error measure is within
    /// the tolerance or the interval is the shortest. Returns the fit and its span.
    ///
    /// # Errors
    /// Any error of `attempt`; the reason why the function has no value on the shortest interval.
    pub fn fit<T, E>(
        mut self,
        terms: usize,
        mut attempt: impl FnMut(&Self) -> Result<Attempt<T, E>, E>,
    ) -> Result<(T, SegmentSpan), E> {
        loop {
            let (fit, next_longest_s) = match attempt(&self)? {
                Attempt::Fitted { fit, unresolved, tolerance } => {
                    let Some(next_longest_s) = self.accept(unresolved, tolerance, terms) else { continue };
                    (fit, next_longest_s)
                }
                Attempt::Short(fit) => (fit, f64::INFINITY),
                Attempt::Event(end_s) => {
                    self.end_at(end_s);
                    continue;
                }
                Attempt::Undefined(_) if self.halve() => continue,
                Attempt::Undefined(error) => return Err(error),
            };
            return Ok((fit, SegmentSpan { start_s: self.start_s, end_s: self.end_s, next_longest_s }));
        }
    }

    /// Halves the length, the function having no value somewhere; `false` where it is the shortest already.
    fn halve(&mut self) -> bool {
        let length_s = self.end_s - self.start_s;
        if length_s <= self.shortest_s {
            return false;
        }
        self.end_s = self.start_s + 0.5 * length_s;
        self.shortened = true;
        true
    }

    /// Judges an attempt of `terms` terms whose last ones come to `unresolved`: the length to try the next segment at, in
    /// s, if it is accepted; otherwise this one is now shorter.
    fn accept(&mut self, unresolved: f64, tolerance: f64, terms: usize) -> Option<f64> {
        let length_s = self.end_s - self.start_s;
        let growth = SAFETY * math::powf(tolerance / unresolved, 1.0 / terms as f64);
        let shorter_s = self.start_s + length_s * growth.clamp(0.1, 0.7);
        // A number that is not finite cannot be resolved by shortening; it shows in the outputs.
        let accepted = unresolved <= tolerance
            || !unresolved.is_finite()
            || length_s <= self.shortest_s
            || shorter_s <= self.start_s;
        if !accepted {
            self.end_s = shorter_s;
            self.shortened = true;
            return None;
        }
        let expected_s = length_s * if growth.is_finite() { growth.clamp(0.5, 4.0) } else { 4.0 };
        Some(if self.shortened { expected_s } else { expected_s.max(self.longest_s) })
    }
}

/// Interval of a fitted segment, and the length expected of the next one.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SegmentSpan {
    /// Start, in s.
    #[serde(with = "or_infinite")]
    pub start_s: f64,
    /// End, in s.
    #[serde(with = "or_infinite")]
    pub end_s: f64,
    /// Length the tolerance will probably allow the next segment, in s.
    #[serde(with = "or_infinite")]
    pub next_longest_s: f64,
}

impl Default for SegmentSpan {
    /// Before the first segment.
    fn default() -> Self {
        Self { start_s: f64::INFINITY, end_s: f64::NEG_INFINITY, next_longest_s: f64::INFINITY }
    }
}

impl SegmentSpan {
    /// Whether it is the one before the first segment.
    pub fn is_before(&self) -> bool {
        self.start_s == f64::INFINITY
    }

    /// Rejects decoded spans that no simulation can produce.
    pub fn is_valid(&self) -> bool {
        (self.is_before() || self.start_s.is_finite() && self.end_s.is_finite()) && self.next_longest_s > 0.0
    }

    /// Start and end, in s; a segment that was cut before its start has no length.
    pub fn span(&self) -> Span {
        Span::new(self.start_s, self.end_s.max(self.start_s))
    }

    /// Whether the segment is valid from `time_s` on.
    pub fn contains(&self, time_s: f64) -> bool {
        self.start_s <= time_s && time_s < self.end_s
    }

    /// Whether the segment reaches `time_s`, its end included, up to rounding at its start.
    pub fn covers(&self, time_s: f64) -> bool {
        self.start_s <= time_s + 8.0 * f64::EPSILON * time_s.abs() && time_s <= self.end_s
    }

    /// Ends the segment at `time_s` if it is longer.
    pub fn cut(&mut self, time_s: f64) {
        self.end_s = self.end_s.min(time_s);
    }
}

#[cfg(test)]
mod tests;

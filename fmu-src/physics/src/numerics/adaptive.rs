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

use super::intervals::next_multiple_s;

/// Of what the estimate allows, as much is used.
const SAFETY: f64 = 0.9;

/// The segment that is being fitted: where it begins and where this attempt ends.
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

    /// Where the segment begins, in s.
    pub fn start_s(&self) -> f64 {
        self.start_s
    }

    /// Where this attempt ends, in s.
    pub fn end_s(&self) -> f64 {
        self.end_s
    }

    /// Ends at an event: that says nothing of the length the tolerance allows.
    pub fn end_at(&mut self, end_s: f64) {
        self.end_s = end_s;
    }

    /// Halves the length, the function having no value somewhere; `false` where it is the shortest already.
    pub fn halve(&mut self) -> bool {
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
    pub fn accept(&mut self, unresolved: f64, tolerance: f64, terms: usize) -> Option<f64> {
        let length_s = self.end_s - self.start_s;
        let growth = SAFETY * (tolerance / unresolved).powf(1.0 / terms as f64);
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

#[cfg(test)]
mod tests {
    //! A function is resolved to the tolerance in a few attempts, and what cannot be resolved ends them.
    use nalgebra::Vector1;

    use super::*;
    use crate::numerics::chebyshev::Segment;

    const TERMS: usize = 8;

    /// The segment of a function from `start_s` on, the length expected of the next one and the number of attempts.
    fn fitted(
        start_s: f64,
        longest_s: f64,
        tolerance: f64,
        function: impl Fn(f64) -> f64,
    ) -> (Segment<1, TERMS>, f64, u32) {
        let mut interval = AdaptiveInterval::new(start_s, 600.0, longest_s, f64::INFINITY, 1e-3);
        for attempts in 1.. {
            let series =
                Segment::<1, TERMS>::fit(start_s, interval.end_s(), |at_s| Vector1::new(function(at_s)));
            let terms = series.coefficients();
            let unresolved = terms[TERMS - 1].abs().max(terms[TERMS - 2].abs());
            if let Some(next_s) = interval.accept(unresolved, tolerance, TERMS) {
                return (series, next_s, attempts);
            }
        }
        unreachable!("an interval gets shorter for ever")
    }

    #[test]
    fn the_error_is_of_the_size_of_the_tolerance_in_few_attempts() {
        for (period_s, tolerance) in [(40.0, 1e-6), (200.0, 1e-9), (7.0, 1e-4)] {
            let wave = |at_s: f64| (core::f64::consts::TAU * at_s / period_s).sin();
            let (mut start_s, mut longest_s, mut worst) = (1.0, f64::INFINITY, 0.0_f64);
            let (mut attempts, mut count, mut last) = (0, 0, 0.0_f64);
            while start_s < 600.0 {
                let (series, next_s, tried) = fitted(start_s, longest_s, tolerance, wave);
                let length_s = series.end() - series.start();
                last = last
                    .max(series.coefficients()[TERMS - 1].abs().max(series.coefficients()[TERMS - 2].abs()));
                for i in 0..=100 {
                    let at_s = series.start() + length_s * f64::from(i) / 100.0;
                    worst = worst.max((series.value(at_s)[0] - wave(at_s)).abs());
                }
                (start_s, longest_s) = (series.end().max(start_s.next_up()), next_s);
                (attempts, count) = (attempts + tried, count + 1);
            }
            // The bound is on the last terms; what comes after them is smaller by a thousand.
            assert!(worst < tolerance && last > 0.3 * tolerance, "{period_s} s: {worst} {last}");
            assert!(attempts <= 2 * count + 4, "{period_s} s: {attempts} for {count}");
        }
    }

    #[test]
    fn what_is_resolved_at_once_lets_the_next_one_grow() {
        let (series, next_s, attempts) = fitted(0.0, 10.0, 1e-9, |at_s| 1e-3 * at_s);
        assert_eq!((series.end(), attempts), (10.0, 1));
        assert!(next_s > 10.0);
    }

    #[test]
    fn a_singularity_or_a_nan_ends_the_attempts() {
        let (series, _, _) = fitted(0.0, f64::INFINITY, 1e-9, |at_s| at_s.powf(0.1));
        assert!(series.end() <= 1e-3, "{}", series.end());
        let (series, next_s, attempts) = fitted(0.0, f64::INFINITY, 1e-9, |_| f64::NAN);
        assert_eq!((series.end(), attempts), (600.0, 1));
        assert!(next_s.is_infinite());
    }

    #[test]
    fn it_ends_at_the_grid_the_limit_or_an_event_and_is_never_empty() {
        assert_eq!(AdaptiveInterval::new(10.0, 600.0, f64::INFINITY, f64::INFINITY, 1.0).end_s(), 600.0);
        assert_eq!(AdaptiveInterval::new(10.0, 600.0, 20.0, f64::INFINITY, 1.0).end_s(), 30.0);
        assert_eq!(AdaptiveInterval::new(10.0, 600.0, 20.0, 15.0, 1.0).end_s(), 15.0);
        assert_eq!(AdaptiveInterval::new(10.0, 600.0, 0.0, 5.0, 1.0).end_s(), 10.0_f64.next_up());
        let mut interval = AdaptiveInterval::new(0.0, 600.0, 8.0, 600.0, 3.0);
        interval.end_at(4.0);
        assert!(interval.halve() && !interval.halve());
        assert_eq!((interval.start_s(), interval.end_s()), (0.0, 2.0));
    }
}

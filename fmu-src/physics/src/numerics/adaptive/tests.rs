//! A function is resolved to the tolerance in a few attempts, and what cannot be resolved ends them.
use core::convert::Infallible;

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
    let interval = AdaptiveInterval::new(start_s, 600.0, longest_s, f64::INFINITY, 1e-3);
    let mut attempts = 0;
    let fitted = interval.fit(TERMS, |interval| {
        attempts += 1;
        let fit = Segment::<1, TERMS>::fit(start_s, interval.end_s(), |at_s| Vector1::new(function(at_s)));
        let terms = fit.coefficients();
        let unresolved = terms[TERMS - 1].abs().max(terms[TERMS - 2].abs());
        Ok::<_, Infallible>(Attempt::Fitted { fit, unresolved, tolerance })
    });
    let Ok((series, span)) = fitted;
    (series, span.next_longest_s, attempts)
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
            last =
                last.max(series.coefficients()[TERMS - 1].abs().max(series.coefficients()[TERMS - 2].abs()));
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
    let interval = AdaptiveInterval::new(0.0, 600.0, 8.0, 600.0, 3.0);
    let mut ends_s = Vec::new();
    let refused = interval.fit(TERMS, |interval| {
        ends_s.push((interval.end_s(), interval.is_refinement()));
        Ok::<Attempt<(), _>, _>(if ends_s.len() == 1 {
            Attempt::Event(4.0)
        } else {
            Attempt::Undefined("no value")
        })
    });
    assert_eq!(refused, Err("no value"));
    assert_eq!(ends_s, [(8.0, false), (4.0, false), (2.0, true)]);
}

#[test]
fn an_interval_too_short_to_be_judged_leaves_the_next_one_free() {
    let interval = AdaptiveInterval::new(0.0, 600.0, 8.0, 600.0, 3.0);
    let span = SegmentSpan { start_s: 0.0, end_s: 8.0, next_longest_s: f64::INFINITY };
    assert_eq!(interval.fit(TERMS, |_| Ok::<_, Infallible>(Attempt::Short(()))), Ok(((), span)));
}

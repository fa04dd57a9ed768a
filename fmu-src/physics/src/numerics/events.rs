//! When a smooth function of time changes sign: eclipse edges, thresholds, limits, located without missing short ones.
//!
//! Equation: f(t) = 0 with a change of sign, in an interval; an event is such a root of one of several functions.
//! Method: adaptive Chebyshev fits of 16 terms, the interval halved until a fit holds or its coefficients exclude a root;
//! then the sign changes of the fit ([`super::roots`]), each refined by bisection on the function itself.
//! Order: 16 a halving where the function is smooth; bisection is linear and ends at neighbouring doubles.
//! Error measure: the last two coefficients of a fit beside its largest (1e-10); an event is the first double at which the
//! sign has changed.
//! Reference: Boyd, Solving Transcendental Equations, 2014, ch. 3 (Chebyshev proxy); Shampine and Thompson, Event location
//! for ordinary differential equations, Computers and Mathematics with Applications 39, 2000.

use nalgebra::SVector;

use super::{chebyshev::Segment, intervals::first_change_s};

/// Coefficients of one fit.
const TERMS: usize = 16;
/// Pieces no shorter than 2^-DEPTH of the interval are split.
const DEPTH: usize = 20;
/// More fits are not made in one search: a function that is nothing but rounding would be halved everywhere. A kink near
/// zero takes twice [`DEPTH`].
const MOST_FITS: u32 = 256;
/// A fit whose last two coefficients are this small beside its largest is taken for the function, on which the event is then
/// found: a dip of 1e-5 of the interval is still seen.
const EVENT_FIT: f64 = 1e-10;
/// The same where the rounding of time is what the fit misses: halving the interval does not make that smaller.
const ROUNDED_FIT: f64 = 1e-7;

/// How much a fit through a few nodes may miss, in its last two coefficients.
const MISSED: f64 = 4.0;
/// Roots are located to this part of the interval before their last bit is found.
const LOCATED: f64 = 1e-10;

/// The first number in `(after, to)` at which any of `K` functions has changed its sign: an event, to the last bit.
///
/// `samples` are the functions at the nodes of [`Segment::nodes`] of `from` and `to`, which usually are known already: where
/// the polynomial through them stays away from zero by more than it can miss, nothing is evaluated. The others are fitted
/// together, from left to right up to the first event, so that a dip between two nodes is not overlooked. A function that is not finite is not watched. `after` lies a little behind `from`, for an interval may begin
/// at an event. The functions see their argument rounded to `rounding`: what they gain over that is no misfit.
pub fn first_event<const K: usize, const N: usize>(
    after: f64,
    from: f64,
    to: f64,
    rounding: f64,
    samples: &[SVector<f64, K>; N],
    mut values: impl FnMut(f64) -> SVector<f64, K>,
) -> Option<f64> {
    let fitted = Segment::<K, N>::from_samples(from, to, samples);
    let suspects: [bool; K] = core::array::from_fn(|k| zero_of_row(&fitted, k, rounding) != Zero::Excluded);
    // Depth first, left before right: at most one right half waits per level.
    let mut waiting = [(from, to, 0, suspects); DEPTH + 2];
    let (mut height, mut fits) = (usize::from(suspects.contains(&true)), 0);
    while height > 0 {
        height -= 1;
        fits += 1;
        let (start, end, depth, suspects) = waiting[height];
        let segment = Segment::<K, TERMS>::fit(start, end, &mut values);
        let zeros: [Zero; K] = core::array::from_fn(|k| match suspects[k] {
            true => zero_of_row(&segment, k, rounding),
            false => Zero::Excluded,
        });
        let suspects = zeros.map(|zero| zero != Zero::Excluded);
        if zeros.contains(&Zero::Unresolved) && depth < DEPTH && fits < MOST_FITS {
            let middle = 0.5 * (start + end);
            waiting[height] = (middle, end, depth + 1, suspects);
            waiting[height + 1] = (start, middle, depth + 1, suspects);
            height += 2;
            continue;
        }
        let mut first: Option<f64> = None;
        for k in (0..K).filter(|&k| suspects[k]) {
            let mut function = |at: f64| values(at)[k];
            let roots = segment.row(k, 1.0, 0.0).sign_changes(start, end);
            let limit = first.unwrap_or(to);
            first = roots
                .iter()
                .filter(|&root| root > after && root < limit)
                .find_map(|root| change_near(root, from.max(after), to, &mut function))
                .filter(|&event| event < limit)
                .or(first);
        }
        if first.is_some() {
            return first;
        }
    }
    None
}

/// What a fit tells of a function's zeros.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Zero {
    /// There is none, or the function is not finite.
    Excluded,
    /// Those of the fit are the function's.
    Resolved,
    /// The fit is too coarse.
    Unresolved,
}

/// What a fit tells of the zeros of its row `k`: what it misses is of the size of its last two coefficients.
fn zero_of_row<const K: usize, const N: usize>(fitted: &Segment<K, N>, k: usize, rounding: f64) -> Zero {
    let terms = fitted.coefficients().row(k);
    if !terms.iter().all(|term| term.is_finite()) {
        return Zero::Excluded;
    }
    let swing: f64 = terms.iter().skip(1).map(|term| term.abs()).sum();
    let tail = terms[N - 1].abs() + terms[N - 2].abs();
    if terms[0].abs() > swing + MISSED * tail {
        return Zero::Excluded;
    }
    let sign = fitted.value(fitted.start())[k].signum();
    let nearest = fitted.row(k, sign, -MISSED * tail);
    let (start, end) = (fitted.start(), fitted.end());
    if nearest.value(start)[0] > 0.0 && nearest.sign_changes(start, end).is_empty() {
        return Zero::Excluded;
    }
    // The slope is at most the sum of n^2 |c_n|, times 2 by the length; a coefficient takes up twice what a sample is off.
    let slope = terms.iter().enumerate().map(|(n, term)| (n * n) as f64 * term.abs()).sum::<f64>() * 2.0
        / (end - start);
    let rounded = (2.0 * rounding * slope).min(ROUNDED_FIT * terms.amax());
    if tail > rounded.max(EVENT_FIT * terms.amax()) { Zero::Unresolved } else { Zero::Resolved }
}

/// The number at which `function` has changed its sign next to a root located roughly; `None` where it touches zero only.
fn change_near(root: f64, from: f64, to: f64, mut function: impl FnMut(f64) -> f64) -> Option<f64> {
    let mut reach = (LOCATED * (to - from)).max(8.0 * f64::EPSILON * root.abs());
    while reach < to - from {
        let (before, behind) = ((root - reach).max(from), (root + reach).min(to));
        let positive = function(before) > 0.0;
        if (function(behind) > 0.0) != positive {
            return Some(first_change_s(before, behind, |at| (function(at) > 0.0) == positive));
        }
        if reach > 1e3 * LOCATED * (to - from) {
            return None;
        }
        reach *= 16.0;
    }
    None
}

#[cfg(test)]
mod tests {
    //! Sign changes are found where they were built in, and short dips are not overlooked.

    use nalgebra::Vector1;
    use proptest::prelude::*;

    use super::*;
    use crate::numerics::spacing::spacing;

    #[test]
    fn a_function_of_nothing_but_rounding_ends_the_search() {
        let mut evaluations = 0;
        let mut noise = |at: f64| {
            evaluations += 1;
            let bits = at.to_bits().wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 40;
            Vector1::new(1e-16 * (bits as f64 / f64::from(1 << 24) - 0.5))
        };
        let samples = Segment::<1, 8>::nodes(0.0, 600.0).map(&mut noise);
        first_event(0.0, 0.0, 600.0, 0.0, &samples, &mut noise);
        assert!(evaluations <= 16 * 2 * MOST_FITS, "{evaluations}");
    }

    /// The first event of sin and of a dip of a thousandth of the interval, whose nodes do not see it.
    #[test]
    fn the_first_event_is_found_between_the_nodes_and_to_the_last_bit() {
        let (from, to) = (0.1, 1.1);
        for center in [0.35, 0.611, 0.87] {
            let values = |t: f64| {
                SVector::from([
                    (t - 3.0).sin(),
                    2.0 * (2.0 * (t - center)).sin().powi(2) - 2e-6,
                    f64::INFINITY,
                ])
            };
            let samples = Segment::<3, 8>::nodes(from, to).map(values);
            assert!(samples.iter().all(|sample| sample[1] > 0.0), "the nodes see the dip");
            let edge = first_event(from + 1e-6, from, to, 0.0, &samples, values).unwrap();
            assert!((edge - (center - 0.5e-3)).abs() < 1e-7, "{edge}");
            assert!(values(edge)[1] <= 0.0 && values(edge.next_down())[1] > 0.0);
            // From within the dip on the next event is its end.
            let samples = Segment::<3, 8>::nodes(edge, to).map(values);
            let end = first_event(edge + 1e-6, edge, to, 0.0, &samples, values).unwrap();
            assert!((end - (center + 0.5e-3)).abs() < 1e-7, "{end}");
        }
    }

    /// Time counted from an epoch far away is rounded to 6e-8 s.
    #[test]
    fn rounded_time_costs_no_halving() {
        let epoch = 3.5e8;
        let rounding = spacing(epoch);
        let mut evaluations = 0;
        let mut values = |t: f64| {
            evaluations += 1;
            let at = (t + epoch) - epoch;
            Vector1::new(1e-2 * (1e-3 * (at - 31.0)).sin() * (2.0 + (0.01 * at).cos()))
        };
        let samples = Segment::<1, 8>::nodes(0.0, 45.0).map(&mut values);
        let edge = first_event(1e-4, 0.0, 45.0, rounding, &samples, &mut values).unwrap();
        assert!((edge - 31.0).abs() <= rounding, "{edge}");
        assert!(values(edge)[0] * values(edge.next_down())[0] <= 0.0);
        assert!(evaluations < 8 + 16 + 80, "{evaluations}");
    }

    #[test]
    fn without_an_event_only_the_samples_are_used() {
        let samples = Segment::<1, 8>::nodes(0.0, 1.0).map(|t| Vector1::new(2.0 + t.sin()));
        let found = first_event(0.0, 0.0, 1.0, 0.0, &samples, |_| panic!("evaluated"));
        assert_eq!(found, None);
    }

    proptest! {
        #[test]
        fn grazing_dips_are_found(center in 0.05..0.7f64, log_depth in -8.0..-1.0f64) {
            // cos(8 (t - center)) - (1 - depth) > 0 only for |t - center| < acos(1 - depth) / 8.
            let depth = 10.0_f64.powf(log_depth);
            let values = |t: f64| Vector1::new(depth - 2.0 * (4.0 * (t - center)).sin().powi(2));
            let half = (depth / 2.0).sqrt().asin() / 4.0;
            let built_in = if center > half { center - half } else { center + half };
            let samples = Segment::<1, 8>::nodes(0.0, 1.0).map(values);
            let found = first_event(0.0, 0.0, 1.0, 0.0, &samples, values).unwrap();
            prop_assert!((found - built_in).abs() < 1e-11 / half, "{} {}", found, built_in);
        }
    }
}

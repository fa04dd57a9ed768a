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

use super::{Span, chebyshev::Segment, intervals::first_change_s};

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
    [after, from, to]: [f64; 3],
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
        let zero = |k: usize| if suspects[k] { zero_of_row(&segment, k, rounding) } else { Zero::Excluded };
        let zeros: [Zero; K] = core::array::from_fn(zero);
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
            let fit = segment.row(k, 1.0, 0.0);
            let roots = fit.sign_changes(start, end);
            let limit = first.unwrap_or(to);
            first = roots
                .iter()
                .filter(|&root| root > after && root < limit)
                .find_map(|root| {
                    let rises = fit.value_and_derivative(root).1[0] > 0.0;
                    change_near(root, rises, from.max(after), to, &mut function)
                })
                .filter(|&event| event < limit)
                .or(first);
        }
        if first.is_some() {
            return first;
        }
    }
    None
}

/// Nodes of a span at which [`first_crossing`] looks at a function.
const CROSSING_NODES: usize = 9;
/// Number of roundings of time beyond which a function keeps its sign.
const ROUNDINGS: f64 = 8.0;

/// First number in a span, to the last bit, at which a smooth `function` has fallen from above zero to zero or below; `rounding` as for
/// [`first_event`]. Edges of spheres, closest approaches and periapses are such crossings: of a distance less a radius, and of
/// minus position times velocity.
pub fn first_crossing(span: Span, rounding: f64, mut function: impl FnMut(f64) -> f64) -> Option<f64> {
    let Span { start_s, end_s } = span;
    let samples = Segment::<1, CROSSING_NODES>::nodes(start_s, end_s).map(|at| SVector::from([function(at)]));
    let mut after = start_s;
    loop {
        let bounds = [after, start_s, end_s];
        let event = first_event(bounds, rounding, &samples, |at| SVector::from([function(at)]))?;
        if function(event) <= 0.0 {
            return Some(event);
        }
        // Within the rounding of time a function that falls rises too.
        let settled_s = (event + ROUNDINGS * rounding).min(end_s);
        if function(settled_s) <= 0.0 {
            return Some(first_change_s(event, settled_s, |at_s| function(at_s) > 0.0));
        }
        after = event;
    }
}

/// Zeros of a function by a fit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Zero {
    /// There is none, or the function is not finite.
    Excluded,
    /// The zeros of the fit are the function's.
    Resolved,
    /// The fit is too coarse.
    Unresolved,
}

/// Zeros of row `k` of a fit, whose error is of the size of its last two coefficients.
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

/// The number at which `function` has changed its sign next to a root located roughly, rising or falling as the fit does there, so far
/// apart that rounding does not reverse it; `None` where it touches zero only.
fn change_near(
    root: f64,
    rises: bool,
    from: f64,
    to: f64,
    mut function: impl FnMut(f64) -> f64,
) -> Option<f64> {
    let mut reach = (LOCATED * (to - from)).max(8.0 * f64::EPSILON * root.abs());
    while reach < to - from {
        let (before, behind) = ((root - reach).max(from), (root + reach).min(to));
        if (function(before) > 0.0) != rises && (function(behind) > 0.0) == rises {
            return Some(first_change_s(before, behind, |at| (function(at) > 0.0) != rises));
        }
        if reach > 1e3 * LOCATED * (to - from) {
            return None;
        }
        reach *= 16.0;
    }
    None
}

#[cfg(test)]
mod tests;

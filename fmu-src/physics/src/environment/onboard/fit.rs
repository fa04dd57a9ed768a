//! Chebyshev fits of a body's motion, and their error where nothing was fitted.
//!
//! A segment is sampled at [`SAMPLES`] Chebyshev nodes; the series through them, cut off at a degree, is the fit of least
//! squares with Chebyshev's weight, near the best there is. Its error is the greatest at [`CHECKS`] evenly spaced epochs
//! from the segment's start to its end, none a node. At the end itself the next segment counts, and the source
//! may have an edge there: the last check lies just before it.

use nalgebra::SVector;

use super::table::{EphemerisSegment, SegmentTable};
use crate::environment::CartesianState;
use crate::numerics::Span;
use crate::numerics::chebyshev::Segment;

/// Nodes of a segment.
const SAMPLES: usize = 32;
/// Epochs of a segment at which it is checked. An odd number whose middle epoch is no node, for those are even in number.
const CHECKS: usize = 49;

/// How far before the end of a segment the last check lies, as a part of its length.
const END_MARGIN: f64 = 1e-6;

/// Greatest degree of a fit: a third of the samples' information is left to average.
pub const GREATEST_DEGREE: usize = 24;

/// Greatest error of a fit.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FitError {
    /// Error of position, in m.
    pub position_m: f64,
    /// Error of velocity, in m/s.
    pub velocity_m_s: f64,
}

impl FitError {
    /// The greater of both.
    pub fn worst(self, other: Self) -> Self {
        Self {
            position_m: self.position_m.max(other.position_m),
            velocity_m_s: self.velocity_m_s.max(other.velocity_m_s),
        }
    }

    /// Returns the error of a state against the truth.
    pub fn from_states(found: &CartesianState, truth: &CartesianState) -> Self {
        Self {
            position_m: (found.position_m - truth.position_m).norm(),
            velocity_m_s: (found.velocity_m_s - truth.velocity_m_s).norm(),
        }
    }
}

/// Segments to fit, and the epochs at which the motion must be known for that.
#[derive(Clone, Debug, PartialEq)]
pub struct FitPlan {
    /// Starts of the segments, and the end of the last one.
    pub(super) edges_s: Vec<f64>,
}

impl FitPlan {
    /// Segments over a span; inner edges are whole multiples of their length past J2000.
    /// A length that is not above 0 makes one segment of the whole span.
    pub fn new(span: Span, segment_s: f64) -> Self {
        let Span { start_s, end_s } = span;
        let mut edges_s = vec![start_s];
        if segment_s > 0.0 {
            let mut number = (start_s / segment_s).floor() + 1.0;
            // What is left at an end is joined to its neighbour where it is no longer than rounding.
            let least_s = 1e-6 * segment_s;
            while number * segment_s < end_s - least_s {
                if number * segment_s > start_s + least_s {
                    edges_s.push(number * segment_s);
                }
                number += 1.0;
            }
        }
        edges_s.push(end_s);
        Self { edges_s }
    }

    /// The epochs at which [`FitPlan::fit`] wants the states, in rising order.
    pub fn epochs_s(&self) -> Vec<f64> {
        self.edges_s.windows(2).flat_map(|edge| schedule(edge[0], edge[1])).map(|(at_s, _)| at_s).collect()
    }

    /// The segments of this degree through the states at [`FitPlan::epochs_s`], and their error.
    pub fn fit(&self, states: &[CartesianState], degree: usize) -> (SegmentTable, FitError) {
        let mut error = FitError::default();
        let mut fitted = Vec::with_capacity(self.edges_s.len());
        for (edge, states) in self.edges_s.windows(2).zip(states.chunks(SAMPLES + CHECKS)) {
            let (start_s, end_s) = (edge[0], edge[1]);
            let scheduled = schedule(start_s, end_s);
            let mut samples = [SVector::<f64, 3>::zeros(); SAMPLES];
            for ((_, node), state) in scheduled.iter().zip(states) {
                if let Some(node) = node {
                    samples[*node] = state.position_m;
                }
            }
            let whole = Segment::<3, SAMPLES>::from_samples(start_s, end_s, &samples);
            let lowest = whole.coefficients().data.0.iter().take(degree.min(GREATEST_DEGREE) + 1);
            let segment = EphemerisSegment { start_s, end_s, coefficients_m: lowest.copied().collect() };
            for ((at_s, _), state) in scheduled.iter().zip(states).filter(|((_, node), _)| node.is_none()) {
                error = error.worst(FitError::from_states(&segment.state(*at_s), state));
            }
            fitted.push(segment);
        }
        (SegmentTable { segments: fitted }, error)
    }
}

/// Epochs of a segment in the order of time, each with the number of its node; without one it is for a check.
fn schedule(start_s: f64, end_s: f64) -> Vec<(f64, Option<usize>)> {
    let nodes = Segment::<3, SAMPLES>::nodes(start_s, end_s).into_iter().enumerate();
    let last = (CHECKS - 1) as f64;
    let check = |k: usize| match k {
        0 => start_s,
        _ if k == CHECKS - 1 => end_s - END_MARGIN * (end_s - start_s),
        _ => start_s + (end_s - start_s) * (k as f64 / last),
    };
    let checks = (0..CHECKS).map(|k| (check(k), None));
    let mut all: Vec<_> = nodes.map(|(node, at_s)| (at_s, Some(node))).chain(checks).collect();
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    all
}

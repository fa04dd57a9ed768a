//! First excess of a dump threshold within a segment, located as a root of the momentum in the body frame.
//!
//! Equation: |h_i(t) - b_i| = threshold_i, with h = R(t)^-1 H(t) of the inertial total H, or the body integral itself, and the
//! wheels' bias b.
//! Method: an excess by more than rounding is sought with [`first_event`] on threshold - h_i and threshold + h_i, in pieces of
//! a limited turn, so that their fits resolve the rotation whatever it does within the segment; the dump's time is the root of
//! |h_i| = threshold before it, by bisection on the function itself.
//! Error measure: that of the fits; the time is exact to the last bit of the function.
//! Reference: `numerics::events`.

use nalgebra::{SVector, Vector3};

use crate::math;
use crate::numerics::chebyshev::Segment;
use crate::numerics::events::first_event;
use crate::numerics::intervals::first_change_s;

use super::dump::{DumpPolicy, EXCEEDED_N_M_S};

/// A piece in which the body turns by this much is resolved by a few tens of fits, in rad.
const PIECE_TURN_RAD: f64 = 32.0;
/// The start of the search for the threshold comes this often half as near to the excess.
const MOST_HALVINGS: i32 = 60;

/// An excess.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Excess {
    /// When a component comes to its threshold, in s.
    pub(super) time_s: f64,
    /// Components that continue beyond theirs from there.
    pub(super) components: [bool; 3],
}

/// Interval of the search for an excess, with the rounding of its times and the rate of the momentum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Watched {
    /// Start of the interval, in s.
    pub(super) start_s: f64,
    /// Its end, in s.
    pub(super) end_s: f64,
    /// The momentum is constant over less than this, in s.
    pub(super) rounding_s: f64,
    /// Greatest rate at which the momentum turns in its frame, in rad/s.
    pub(super) rate_rad_s: f64,
}

impl Watched {
    /// The first time after the start and before the end at which a component of the momentum, body frame, in N m s, exceeds
    /// its threshold or, having exceeded it at the start, comes back; `samples` is the momentum at the Chebyshev nodes of the
    /// whole interval.
    pub(super) fn first_excess<const N: usize>(
        &self,
        policy: &DumpPolicy,
        samples: &[Vector3<f64>; N],
        mut momentum: impl FnMut(f64) -> Vector3<f64>,
    ) -> Option<Excess> {
        let thresholds_n_m_s = policy.threshold_body_n_m_s;
        let bias_n_m_s = policy.bias_body_n_m_s;
        let below = |h: &Vector3<f64>| -> SVector<f64, 6> {
            SVector::from_fn(|row, _| {
                let limit_n_m_s = thresholds_n_m_s[row % 3] + 2.0 * EXCEEDED_N_M_S;
                let h_n_m_s = h[row % 3] - bias_n_m_s[row % 3];
                if row < 3 { limit_n_m_s - h_n_m_s } else { limit_n_m_s + h_n_m_s }
            })
        };
        let Self { start_s, end_s, rounding_s, rate_rad_s } = *self;
        let length_s = end_s - start_s;
        let pieces = (rate_rad_s * length_s / PIECE_TURN_RAD).ceil().max(1.0);
        let edge_s = |piece: f64| if piece == pieces { end_s } else { start_s + length_s * (piece / pieces) };
        let (mut piece, mut found) = (0.0, None);
        while piece < pieces && found.is_none() {
            let (from_s, to_s) = (edge_s(piece), edge_s(piece + 1.0));
            let samples = match pieces == 1.0 {
                true => samples.map(|h| below(&h)),
                false => Segment::<6, N>::nodes(from_s, to_s).map(|at_s| below(&momentum(at_s))),
            };
            let values = |at_s: f64| below(&momentum(at_s));
            found = first_event([from_s, from_s, to_s], rounding_s, &samples, values);
            piece += 1.0;
        }
        let beyond_s = found?;
        let components = policy.exceeded_by(&momentum(beyond_s));
        let Some(axis) = components.iter().position(|exceeds| *exceeds) else {
            return Some(Excess { time_s: beyond_s, components });
        };
        let mut is_below =
            |at_s: f64| (momentum(at_s)[axis] - bias_n_m_s[axis]).abs() < thresholds_n_m_s[axis];
        // Where a dump left the component at its threshold it need not be below at the start.
        let from_s = (0..MOST_HALVINGS)
            .map(|halvings| beyond_s - (beyond_s - start_s) * math::powi(0.5_f64, halvings))
            .find(|&at_s| is_below(at_s));
        let time_s = from_s.map_or(beyond_s, |from_s| first_change_s(from_s, beyond_s, is_below));
        Some(Excess { time_s, components })
    }
}

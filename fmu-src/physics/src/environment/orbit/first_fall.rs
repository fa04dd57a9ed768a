//! First time at which a height over a path segment vanishes.
//!
//! Method: signs at the ends of eight pieces; between them a lowest point is sought where the slopes to both sides leave room for one,
//! then the root is bracketed.

use crate::numerics::golden_section::{Bracket, golden_section};
use crate::numerics::roots;

/// Pieces of a segment at whose ends heights are looked at.
const PIECES: usize = 8;
/// Golden sections to a lowest point: below rounding of the time.
const LOWEST_STEPS: usize = 40;

/// A segment that begins this near the edge of a sphere of influence and goes over it counts as beyond it, in m: light moves the
/// path by centimetres after the edge was sought.
pub(super) const EDGE_M: f64 = 1.0;

/// The first time at which a height falls below zero, by its lowest points between pieces of the span too; it falls by no more than
/// `reach_m` over the span.
pub(super) fn first_fall(
    [start_s, end_s]: [f64; 2],
    reach_m: f64,
    height_m: &mut impl FnMut(f64) -> f64,
) -> Option<f64> {
    let reach_m = reach_m / PIECES as f64;
    let at = |piece: usize| start_s + (end_s - start_s) * piece as f64 / PIECES as f64;
    let heights: [f64; PIECES + 1] = core::array::from_fn(|piece| height_m(at(piece)));
    for piece in 0..=PIECES {
        let now = heights[piece];
        let [before, after] = [piece.checked_sub(1), Some(piece + 1)]
            .map(|index| index.and_then(|index| heights.get(index)).copied().unwrap_or(f64::INFINITY));
        let from_s = at(piece.saturating_sub(1));
        if piece > 0 && before > 0.0 && now < 0.0 {
            return roots::bracketed(from_s, at(piece), 0.0, height_m).ok();
        }
        // A distance is convex where it is least: it may dip below what is seen by no more than both slopes.
        let slopes = (before - now) + (after - now);
        // One that begins at an edge has just come over it.
        let begins_there = piece == 0 && now < EDGE_M;
        let dips = !begins_there && now < slopes.min(reach_m) && now <= before && now <= after;
        if dips && now > 0.0 && before > 0.0 {
            let around = Bracket { low: from_s, high: at((piece + 1).min(PIECES)) };
            let lowest_s = golden_section(around, LOWEST_STEPS, &mut *height_m).middle();
            if height_m(lowest_s) < 0.0 {
                return roots::bracketed(from_s, lowest_s, 0.0, height_m).ok();
            }
        }
    }
    None
}

//! First time at which a height over a path segment vanishes.
//!
//! Method: signs at the ends of eight pieces; between them a lowest point is sought where the slopes to both sides leave room for one,
//! then the root is bracketed.

use crate::numerics::roots;

/// Pieces of a segment at whose ends heights are looked at.
const PIECES: usize = 8;

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
            let lowest_s = lowest(from_s, at((piece + 1).min(PIECES)), height_m);
            if height_m(lowest_s) < 0.0 {
                return roots::bracketed(from_s, lowest_s, 0.0, height_m).ok();
            }
        }
    }
    None
}

/// Where a function with one lowest point is lowest, by golden sections.
fn lowest(mut from_s: f64, mut to_s: f64, function: &mut impl FnMut(f64) -> f64) -> f64 {
    const SHARE: f64 = 0.618_033_988_749_894_9;
    for _ in 0..40 {
        let [left_s, right_s] = [to_s - SHARE * (to_s - from_s), from_s + SHARE * (to_s - from_s)];
        if function(left_s) < function(right_s) {
            to_s = right_s;
        } else {
            from_s = left_s;
        }
    }
    0.5 * (from_s + to_s)
}

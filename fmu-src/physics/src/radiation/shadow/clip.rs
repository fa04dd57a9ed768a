//! Convex pieces of a plane, cut by straight lines and by one another.
//!
//! Every outline here is strictly convex: a corner that turns by less than rounding resolves is dropped
//! ([`drop_flat_corners`]), for an edge of no length, or one that rounding turned, divides nothing.

use nalgebra::Vector2;

use crate::numerics::scalar::{Scalar, scratch};

scratch! {
/// Convex pieces, counter-clockwise, one after the other in one list of points.
pub(super) struct Pieces<T: Scalar> {
    points: Vec<Vector2<T>>,
    /// End of each piece in `points`.
    ends: Vec<usize>,
    /// Corners whose triangle has no more than twice this area are dropped, in m2.
    flat_m2: f64,
}
}

impl<T: Scalar> Pieces<T> {
    /// Removes all pieces; those to come lie within `radius_m` of the origin.
    pub(super) fn clear(&mut self, radius_m: f64) {
        self.points.clear();
        self.ends.clear();
        self.flat_m2 = flat_m2(radius_m);
    }

    pub(super) fn is_empty(&self) -> bool {
        self.ends.is_empty()
    }

    pub(super) fn iter(&self) -> impl Iterator<Item = &[Vector2<T>]> + '_ {
        let starts = core::iter::once(0).chain(self.ends.iter().copied());
        starts.zip(&self.ends).map(|(start, end)| &self.points[start..*end])
    }

    pub(super) fn push(&mut self, piece: impl Iterator<Item = Vector2<T>>) {
        self.points.extend(piece);
        self.close();
    }

    /// Ends the piece under construction, or drops it if it has no area.
    fn close(&mut self) {
        let start = self.ends.last().copied().unwrap_or(0);
        drop_flat_corners(&mut self.points, start, self.flat_m2);
        if self.points.len() > start {
            self.ends.push(self.points.len());
        }
    }

    /// Area, and its first moments about the origin.
    pub(super) fn area_and_moments(&self) -> (T, Vector2<T>) {
        let mut area = T::constant(0.0);
        let mut moments = Vector2::repeat(area);
        for piece in self.iter() {
            let Some(first) = piece.first() else { continue };
            for pair in piece.windows(2).skip(1) {
                let (a, b) = (pair[0] - first, pair[1] - first);
                let part = cross(&a, &b) * 0.5;
                area += part;
                moments += (first * T::constant(3.0) + a + b) * (part * (1.0 / 3.0));
            }
        }
        (area, moments)
    }

    /// Writes into `remaining` the parts of these pieces outside a convex counter-clockwise `hole`.
    pub(super) fn subtract_into(
        &self,
        hole: &[Vector2<T>],
        scratch: &mut [Vec<Vector2<T>>; 2],
        remaining: &mut Self,
    ) {
        remaining.points.clear();
        remaining.ends.clear();
        remaining.flat_m2 = self.flat_m2;
        for piece in self.iter() {
            if separates(hole, piece) || separates(piece, hole) {
                remaining.points.extend_from_slice(piece);
                remaining.ends.push(remaining.points.len());
                continue;
            }
            let [inside, next] = scratch;
            inside.clear();
            inside.extend_from_slice(piece);
            for (a, b) in edges(hole) {
                // The part to the right of this edge is outside the hole; the rest faces the other edges.
                clip(inside, &b, &a, &mut remaining.points);
                remaining.close();
                next.clear();
                clip(inside, &a, &b, next);
                core::mem::swap(inside, next);
                if inside.len() < 3 {
                    break;
                }
            }
        }
    }
}

/// Twice the area of a triangle, in m2, up to which rounding of coordinates of this size (in m) decides its sign.
pub(super) fn flat_m2(size_m: f64) -> f64 {
    64.0 * f64::EPSILON * size_m * size_m
}

/// Makes the convex counter-clockwise outline from `start` on strictly convex: drops repeated corners, those in line with
/// their neighbours and those that turn right, up to twice the area `flat_m2` a triangle. An outline without area
/// becomes empty.
///
/// The remaining outline turns at every corner by at least 64 times the angle by which rounding can turn its edges.
pub(super) fn drop_flat_corners<T: Scalar>(points: &mut Vec<Vector2<T>>, start: usize, flat_m2: f64) {
    if points.len() < start + 3 {
        points.truncate(start);
    } else if has_flat_corner(&points[start..], flat_m2) {
        drop_those(points, start, flat_m2);
    }
}

/// Whether the outline has a corner that turns right or by a triangle of at most `flat_m2`; true of less than two corners.
#[inline]
fn has_flat_corner<T: Scalar>(outline: &[Vector2<T>], flat_m2: f64) -> bool {
    let [.., before, last] = outline else { return true };
    let (mut from, mut edge) = (last.map(T::value), (last - before).map(T::value));
    // The smallest turn; a NaN is passed over and shows.
    let mut least = f64::INFINITY;
    for point in outline {
        let to = point.map(T::value);
        let next = to - from;
        least = least.min(edge.perp(&next));
        (from, edge) = (to, next);
    }
    least <= flat_m2
}

#[cold]
fn drop_those<T: Scalar>(points: &mut Vec<Vector2<T>>, start: usize, flat_m2: f64) {
    let is_flat = |a: &Vector2<T>, b: &Vector2<T>, c: &Vector2<T>| {
        let [a, b, c] = [a, b, c].map(|p| p.map(T::value));
        // Written so that a NaN stays and shows.
        (b - a).perp(&(c - b)) <= flat_m2
    };
    let mut end = start;
    for index in start..points.len() {
        let point = points[index];
        while end >= start + 2 && is_flat(&points[end - 2], &points[end - 1], &point) {
            end -= 1;
        }
        points[end] = point;
        end += 1;
    }
    let mut first = start;
    while end >= first + 3 {
        if is_flat(&points[end - 2], &points[end - 1], &points[first]) {
            end -= 1;
        } else if is_flat(&points[end - 1], &points[first], &points[first + 1]) {
            first += 1;
        } else {
            break;
        }
    }
    if end < first + 3 {
        (first, end) = (start, start);
    }
    points.truncate(end);
    points.drain(start..first);
}

#[inline]
pub(super) fn cross<T: Scalar>(a: &Vector2<T>, b: &Vector2<T>) -> T {
    a.x * b.y - a.y * b.x
}

pub(super) fn edges<T: Scalar>(piece: &[Vector2<T>]) -> impl Iterator<Item = (Vector2<T>, Vector2<T>)> + '_ {
    let next = piece.iter().skip(1).chain(piece.first());
    piece.iter().zip(next).map(|(a, b)| (*a, *b))
}

/// Appends to `kept` what lies left of the line from `a` to `b`.
fn clip<T: Scalar>(piece: &[Vector2<T>], a: &Vector2<T>, b: &Vector2<T>, kept: &mut Vec<Vector2<T>>) {
    let along = b - a;
    let side = |p: &Vector2<T>| cross(&along, &(p - a));
    keep_positive(piece, side, |from, to, share| from + (to - from) * share, kept);
}

/// Appends to `kept` the part of a convex outline where `side` is not negative; `between` gives a point of an edge by its fraction of the
/// way from the first corner to the second.
#[inline]
pub(super) fn keep_positive<P: Copy, T: Scalar>(
    outline: &[P],
    side: impl Fn(&P) -> T,
    between: impl Fn(&P, &P, T) -> P,
    kept: &mut Vec<P>,
) {
    let Some(mut from) = outline.last() else { return };
    let mut from_side = side(from);
    for to in outline {
        let to_side = side(to);
        let (before, after) = (from_side.value(), to_side.value());
        if (before > 0.0 && after < 0.0) || (before < 0.0 && after > 0.0) {
            kept.push(between(from, to, from_side / (from_side - to_side)));
        }
        if after >= 0.0 {
            kept.push(*to);
        }
        from = to;
        from_side = to_side;
    }
}

/// Whether everything of `other` lies right of an edge of the first outline.
fn separates<T: Scalar>(edges_of: &[Vector2<T>], other: &[Vector2<T>]) -> bool {
    let Some(mut start) = edges_of.last().map(|p| p.map(T::value)) else { return false };
    for end in edges_of {
        let end = end.map(T::value);
        let along = end - start;
        if other.iter().all(|p| along.perp(&(p.map(T::value) - start)) <= 0.0) {
            return true;
        }
        start = end;
    }
    false
}

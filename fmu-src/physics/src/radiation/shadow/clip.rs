//! Convex pieces of a plane, cut by straight lines and by one another.

use nalgebra::Vector2;

use crate::numerics::scalar::Scalar;

/// Convex pieces, counter-clockwise, one after the other in one list of points.
#[derive(Clone, Debug)]
pub(super) struct Pieces<T: Scalar> {
    points: Vec<Vector2<T>>,
    /// End of each piece in `points`.
    ends: Vec<usize>,
}

impl<T: Scalar> Default for Pieces<T> {
    fn default() -> Self {
        Self { points: Vec::new(), ends: Vec::new() }
    }
}

impl<T: Scalar> Pieces<T> {
    pub fn clear(&mut self) {
        self.points.clear();
        self.ends.clear();
    }

    pub fn is_empty(&self) -> bool {
        self.ends.is_empty()
    }

    pub fn iter(&self) -> impl Iterator<Item = &[Vector2<T>]> + '_ {
        let starts = core::iter::once(0).chain(self.ends.iter().copied());
        starts.zip(&self.ends).map(|(start, end)| &self.points[start..*end])
    }

    pub fn push(&mut self, piece: impl Iterator<Item = Vector2<T>>) {
        self.points.extend(piece);
        self.close();
    }

    /// Ends the piece under construction, or drops it if it has no area.
    fn close(&mut self) {
        let start = self.ends.last().copied().unwrap_or(0);
        if self.points.len() >= start + 3 {
            self.ends.push(self.points.len());
        } else {
            self.points.truncate(start);
        }
    }

    /// Area, and its first moments about the origin.
    pub fn area_and_moments(&self) -> (T, Vector2<T>) {
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

    /// What is left of these pieces outside a convex counter-clockwise `hole`; `left` is overwritten.
    pub fn subtract_into(&self, hole: &[Vector2<T>], scratch: &mut [Vec<Vector2<T>>; 2], left: &mut Self) {
        left.clear();
        for piece in self.iter() {
            if apart(piece, hole) {
                left.push(piece.iter().copied());
                continue;
            }
            let [inside, next] = scratch;
            inside.clear();
            inside.extend_from_slice(piece);
            for (a, b) in edges(hole) {
                // What lies right of this edge is outside the hole; the rest faces the other edges.
                clip(inside, &b, &a, &mut left.points);
                left.close();
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

#[inline]
pub(super) fn cross<T: Scalar>(a: &Vector2<T>, b: &Vector2<T>) -> T {
    a.x * b.y - a.y * b.x
}

pub(super) fn edges<T: Scalar>(piece: &[Vector2<T>]) -> impl Iterator<Item = (Vector2<T>, Vector2<T>)> + '_ {
    let next = piece.iter().cycle().skip(1);
    piece.iter().zip(next).map(|(a, b)| (*a, *b))
}

/// Appends to `kept` what lies left of the line from `a` to `b`.
fn clip<T: Scalar>(piece: &[Vector2<T>], a: &Vector2<T>, b: &Vector2<T>, kept: &mut Vec<Vector2<T>>) {
    let along = b - a;
    let side = |p: &Vector2<T>| cross(&along, &(p - a));
    let Some(mut from) = piece.last() else { return };
    let mut from_side = side(from);
    for to in piece {
        let to_side = side(to);
        let (before, after) = (from_side.value(), to_side.value());
        if (before > 0.0 && after < 0.0) || (before < 0.0 && after > 0.0) {
            kept.push(from + (to - from) * (from_side / (from_side - to_side)));
        }
        if after >= 0.0 {
            kept.push(*to);
        }
        from = to;
        from_side = to_side;
    }
}

/// Whether an edge of either keeps them apart.
fn apart<T: Scalar>(piece: &[Vector2<T>], hole: &[Vector2<T>]) -> bool {
    let separates = |edges_of: &[Vector2<T>], other: &[Vector2<T>]| {
        edges(edges_of).any(|(a, b)| {
            let along = (b - a).map(T::value);
            let start = a.map(T::value);
            other.iter().all(|p| along.perp(&(p.map(T::value) - start)) <= 0.0)
        })
    };
    separates(hole, piece) || separates(piece, hole)
}

//! Splits of the range of rings, and the variable that makes each piece smooth.
//!
//! Equation: the integrand behaves like sqrt(x - a) where an arc is born at the ring a.
//! Method: breaks at every birth, and on each piece the variable y with x = a + (b - a) y2, whose derivative is 0 at the
//! birth and cancels the square root; an earlier birth remains a singularity at y2 < 0, whose distance
//! [`Segment::singularity`] gives to the quadrature.
//! Error measure: breaks closer than 1e-13 of the range are one.
//! Reference: see [`super`].

use crate::numerics::scalar::Scalar;

/// A birth of an arc this near to nadir counts as there.
pub(super) const AT_NADIR: f64 = 1e-9;

/// Breaks nearer to each other than this are one.
const SAME_BREAK: f64 = 1e-13;

/// A segment, 1 long in y, is split when an earlier birth bends the integrand nearer to its start than this ...
const FARTHEST_SINGULARITY: f64 = 0.3;

/// ... at twice the singularity and then at multiples of this ratio ...
pub(super) const SPLIT_RATIO: f64 = 30.0;

/// ... up to here.
pub(super) const FARTHEST_SPLIT: f64 = 0.6001;

/// Points at which the range is split, at most six.
pub(super) struct Breaks<T> {
    at: [T; 6],
    pub born: [bool; 6],
    count: usize,
    /// The plate sees no ring nearer than this one.
    pub unseen_before: f64,
}

/// A piece of the range of rings without a birth inside.
pub(super) struct Segment<T> {
    from: T,
    to: T,
    /// The last birth at or before `from` and the one before it (or nadir), if there was a birth.
    births: Option<(T, T)>,
}

impl<T: Scalar> Segment<T> {
    /// The range of the variable y; past a birth y2 is the distance from it, in units of that of `to`.
    pub(super) fn range(&self) -> (T, T) {
        let one = T::constant(1.0);
        match self.births {
            Some((birth, _)) if self.from.value() > birth.value() => {
                (((self.from - birth) / (self.to - birth)).sqrt(), one)
            }
            _ => (T::constant(0.0), one),
        }
    }

    /// The ring at y and its derivative by y.
    #[inline]
    pub(super) fn at(&self, y: T) -> (T, T) {
        match self.births {
            Some((birth, _)) => {
                let length = self.to - birth;
                (birth + length * (y * y), length * y * 2.0)
            }
            None => {
                let length = self.to - self.from;
                (self.from + length * y, length)
            }
        }
    }

    /// The distance of an earlier birth in units of y, as far as `closest` from this one: the integrand bends there.
    pub(super) fn singularity(&self, closest: f64) -> Option<T> {
        let (birth, earlier) = self.births?;
        let squared = (birth - earlier) / (self.to - birth);
        let range = closest * closest..FARTHEST_SINGULARITY * FARTHEST_SINGULARITY;
        range.contains(&squared.value()).then(|| squared.sqrt())
    }
}

impl<T: Scalar> Breaks<T> {
    /// The pieces in ascending order. Breaks that coincide count as the first of them.
    pub(super) fn segments(&self) -> impl Iterator<Item = Segment<T>> + '_ {
        let mut births: Option<(T, T)> = None;
        let mut from = self.at[0];
        (1..self.count).filter_map(move |i| {
            if self.born[i - 1] {
                births = Some((from, births.map_or(self.at[0], |(birth, _)| birth)));
            }
            let to = self.at[i];
            if to.value() - from.value() <= SAME_BREAK {
                return None;
            }
            let segment = Segment { from, to, births };
            from = to;
            (segment.from.value() >= self.unseen_before - SAME_BREAK).then_some(segment)
        })
    }

    /// No breaks.
    pub(super) fn none() -> Self {
        let zero = T::constant(0.0);
        Self { at: [zero; 6], born: [false; 6], count: 0, unseen_before: f64::NEG_INFINITY }
    }

    /// Puts a break in its place; at most six.
    pub(super) fn insert(&mut self, at: T, born: bool) {
        let mut i = self.count;
        while i > 0 && self.at[i - 1].value() > at.value() {
            self.at[i] = self.at[i - 1];
            self.born[i] = self.born[i - 1];
            i -= 1;
        }
        self.at[i] = at;
        self.born[i] = born;
        self.count += 1;
    }
}

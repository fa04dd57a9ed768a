//! Arcs of a ring around nadir and the integrals of sines and cosines over them, in closed form.
//!
//! Equation: int cos^i(psi) sin^j(psi) dpsi over an arc |psi - middle| < half, for i + j up to 3.
//! Method: antiderivatives about the arc's middle, where odd powers of the sine vanish, turned to the requested azimuth; the
//! common part of two arcs is an arc, or two where both are wider than half the ring.
//! Error measure: rounding, in units of the full ring's integral.
//! Reference: elementary integrals; the tests of [`super`] compare their sums with other integrations.

use core::f64::consts::PI;

use nalgebra::Vector3;

use crate::numerics::scalar::{Scalar, acos};

/// The part of a ring where `level + reach * cos(azimuth - middle) > 0`.
#[derive(Clone, Copy, Debug)]
pub(super) enum Arc<T> {
    /// Nowhere.
    Empty,
    /// Everywhere.
    Full,
    /// Within `half` of the middle; the cosine and sine of `half` are known without trigonometry.
    Part { half: T, cos_half: T, sin_half: T },
}

impl<T: Scalar> Arc<T> {
    /// The arc of a linear condition; `reach` is not negative.
    #[inline]
    pub(super) fn from_linear_condition(level: T, reach: T) -> Self {
        let (level_value, reach_value) = (level.value(), reach.value());
        if level_value >= reach_value {
            return if level_value > 0.0 { Self::Full } else { Self::Empty };
        }
        if level_value <= -reach_value {
            return Self::Empty;
        }
        let cos_half = -level / reach;
        // Rounded to a closed arc or to none, where the root has no slope.
        if cos_half.value() <= -1.0 {
            return Self::Full;
        }
        if cos_half.value() >= 1.0 {
            return Self::Empty;
        }
        let sin_half = ((cos_half * -1.0 + 1.0) * (cos_half + 1.0)).sqrt();
        Self::Part { half: acos(cos_half), cos_half, sin_half }
    }
}

/// A direction in the horizon plane.
#[derive(Clone, Copy, Debug)]
pub(super) struct Azimuth<T> {
    pub cos: T,
    pub sin: T,
}

impl<T: Scalar> Azimuth<T> {
    /// The azimuth of a horizontal vector and the vector's length; east when it has none.
    pub(super) fn with_length(east: T, north: T) -> (Self, T) {
        let length_squared = east * east + north * north;
        if length_squared.value() <= 0.0 {
            return (Self { cos: T::constant(1.0), sin: T::constant(0.0) }, T::constant(0.0));
        }
        let length = length_squared.sqrt();
        (Self { cos: east / length, sin: north / length }, length)
    }

    /// Another azimuth counted from this one.
    #[inline]
    pub(super) fn to(&self, other: &Self) -> Self {
        Self {
            cos: self.cos * other.cos + self.sin * other.sin,
            sin: self.cos * other.sin - self.sin * other.cos,
        }
    }

    /// Components in the frame whose x axis has this azimuth.
    #[inline]
    pub(super) fn turned_back(&self, v: &Vector3<T>) -> Vector3<T> {
        Vector3::new(v.x * self.cos + v.y * self.sin, v.y * self.cos - v.x * self.sin, v.z)
    }

    /// The inverse of [`Azimuth::turned_back`].
    #[inline]
    pub(super) fn turned_forth(&self, v: &Vector3<T>) -> Vector3<T> {
        Vector3::new(v.x * self.cos - v.y * self.sin, v.y * self.cos + v.x * self.sin, v.z)
    }

    /// Returns the azimuth advanced by the angle with this cosine and sine.
    #[inline]
    fn turned(&self, cos: T, sin: T) -> Self {
        Self { cos: self.cos * cos - self.sin * sin, sin: self.sin * cos + self.cos * sin }
    }
}

/// Integrals of cos^p sin^q of the azimuth over an arc about azimuth 0, where odd powers of the sine vanish.
#[derive(Clone, Copy, Debug)]
pub(super) struct EvenMoments<T> {
    pub angle: T,
    pub c1: T,
    pub c2: T,
    pub s2: T,
    pub c3: T,
    pub c1s2: T,
}

impl<T: Scalar> EvenMoments<T> {
    /// Over an arc about azimuth 0.
    #[inline]
    pub(super) fn over(arc: Arc<T>) -> Self {
        let zero = T::constant(0.0);
        match arc {
            Arc::Empty => Self { angle: zero, c1: zero, c2: zero, s2: zero, c3: zero, c1s2: zero },
            Arc::Full => {
                let pi = T::constant(PI);
                Self { angle: pi * 2.0, c1: zero, c2: pi, s2: pi, c3: zero, c1s2: zero }
            }
            Arc::Part { half, cos_half, sin_half } => {
                let product = sin_half * cos_half;
                let c1 = sin_half * 2.0;
                let c1s2 = c1 * (sin_half * sin_half) * (1.0 / 3.0);
                Self { angle: half * 2.0, c1, c2: half + product, s2: half - product, c3: c1 - c1s2, c1s2 }
            }
        }
    }
}

/// Integrals of cos^p sin^q of the azimuth; `c2s1` is that of cos^2 sin.
#[derive(Clone, Copy, Debug)]
pub(super) struct Moments<T> {
    pub angle: T,
    pub c1: T,
    pub s1: T,
    pub c2: T,
    pub c1s1: T,
    pub s2: T,
    pub c3: T,
    pub c2s1: T,
    pub c1s2: T,
    pub s3: T,
}

impl<T: Scalar> Moments<T> {
    /// Over nothing.
    fn empty() -> Self {
        let zero = T::constant(0.0);
        Self {
            angle: zero,
            c1: zero,
            s1: zero,
            c2: zero,
            c1s1: zero,
            s2: zero,
            c3: zero,
            c2s1: zero,
            c1s2: zero,
            s3: zero,
        }
    }

    /// Adds an arc of `angle` between two azimuths.
    #[inline]
    fn add(&mut self, from: Azimuth<T>, to: Azimuth<T>, angle: T) {
        let (from_c2, to_c2) = (from.cos * from.cos, to.cos * to.cos);
        let (from_s2, to_s2) = (from.sin * from.sin, to.sin * to.sin);
        let c1 = to.sin - from.sin;
        let s1 = from.cos - to.cos;
        let c2 = (angle + to.sin * to.cos - from.sin * from.cos) * 0.5;
        let c1s2 = (to_s2 * to.sin - from_s2 * from.sin) * (1.0 / 3.0);
        let c2s1 = (from_c2 * from.cos - to_c2 * to.cos) * (1.0 / 3.0);
        self.angle += angle;
        self.c1 += c1;
        self.s1 += s1;
        self.c2 += c2;
        self.c1s1 += (to_s2 - from_s2) * 0.5;
        self.s2 += angle - c2;
        self.c3 += c1 - c1s2;
        self.c2s1 += c2s1;
        self.c1s2 += c1s2;
        self.s3 += s1 - c2s1;
    }

    /// Over what an arc about azimuth 0, or the whole ring, has in common with a part of the ring about azimuth
    /// `ahead`, in (-pi, pi], whose cosine and sine are given.
    #[inline]
    pub(super) fn common(
        seen: Arc<T>,
        (half, cos_half, sin_half): (T, T, T),
        ahead: T,
        middle: Azimuth<T>,
    ) -> Self {
        let mut sum = Self::empty();
        let start = middle.turned(cos_half, -sin_half);
        let end = middle.turned(cos_half, sin_half);
        let Arc::Part { half: seen_half, cos_half: seen_cos, sin_half: seen_sin } = seen else {
            if matches!(seen, Arc::Full) {
                sum.add(start, end, half * 2.0);
            }
            return sum;
        };
        // The part repeats every turn; the copy beyond the far side can reach into the arc too.
        let other_turn = if ahead.value() >= 0.0 { -2.0 * PI } else { 2.0 * PI };
        for turn in [0.0, other_turn] {
            let (low, high) = (ahead - half + turn, ahead + half + turn);
            let (from, from_azimuth) = if -seen_half.value() >= low.value() {
                (-seen_half, Azimuth { cos: seen_cos, sin: -seen_sin })
            } else {
                (low, start)
            };
            let (to, to_azimuth) = if seen_half.value() <= high.value() {
                (seen_half, Azimuth { cos: seen_cos, sin: seen_sin })
            } else {
                (high, end)
            };
            if to.value() > from.value() {
                sum.add(from_azimuth, to_azimuth, to - from);
            }
        }
        sum
    }
}

//! Truncated power series in time, and the rotation of a body as one over a segment of its motion.
//!
//! Equations: dm/dt = T + m x w, dq/dt = q w / 2, m the body's momentum and w its rate, in body components. How w follows
//! from m, and the torque T, are the caller's.
//! Method: the right-hand sides are products, so the coefficients follow from one another by Cauchy products.
//! Order: N - 1, or as many terms as count.
//! Error measure: the last terms relative to the whole, [`ROUNDING`].
//! Reference: Hairer, Norsett, Wanner, Solving Ordinary Differential Equations I, I.8.

use core::iter::Sum;
use core::ops::{Add, Mul};

use nalgebra::{Vector3, Vector4};
use serde::{Deserialize, Serialize};

use super::quaternion::Quaternion;

use crate::math;

/// Highest order of a gyrostat's series.
pub(super) const ORDER: usize = 10;
/// Its terms.
pub(super) const TERMS: usize = ORDER + 1;
/// Terms below this fraction of the whole are rounding.
pub(crate) const ROUNDING: f64 = 1e-17;

/// Coefficient of a polynomial in time.
pub(crate) trait Term: Copy + Default + Add<Output = Self> + Mul<f64, Output = Self> + Sum {}

impl<T: Copy + Default + Add<Output = T> + Mul<f64, Output = T> + Sum> Term for T {}

/// Value of a polynomial.
#[inline]
pub(crate) fn polynomial<T: Term>(terms: &[T], at: f64) -> T {
    terms.iter().rev().fold(T::default(), |sum, term| sum * at + *term)
}

/// Slope of a polynomial.
pub(crate) fn slope<T: Term>(terms: &[T], at: f64) -> T {
    let terms = terms.iter().enumerate().skip(1).rev();
    terms.fold(T::default(), |sum, (j, term)| sum * at + *term * j as f64)
}

/// Coefficient `j` of a product with a series that may have fewer terms.
pub(crate) fn product<T: Term>(a: &[f64], b: &[T], j: usize) -> T {
    a.iter().take(j + 1).zip(b[..=j].iter().rev()).map(|(x, y)| *y * *x).sum()
}

/// The polynomial through values at different nodes: Newton's divided differences, then its coefficients.
pub(crate) fn through<const N: usize>(nodes: &[f64; N], mut values: [f64; N]) -> [f64; N] {
    for level in 1..N {
        for i in (level..N).rev() {
            values[i] = (values[i] - values[i - 1]) / (nodes[i] - nodes[i - level]);
        }
    }
    let mut terms = [0.0; N];
    for i in (0..N).rev() {
        for k in (0..N).rev() {
            let below = if k > 0 { terms[k - 1] } else { 0.0 };
            terms[k] = below - nodes[i] * terms[k];
        }
        terms[0] += values[i];
    }
    terms
}

/// How long a series whose terms `j` have these sizes relative to the whole is exact to rounding, at most `longest_s`, in s.
pub(crate) fn exact_length_s(longest_s: f64, sizes: impl Iterator<Item = (usize, f64)>) -> f64 {
    sizes.fold(longest_s, |length_s, (j, size)| {
        let is_longer = size * math::powi(length_s, j as i32) > ROUNDING;
        if is_longer { math::powf(ROUNDING / size, 1.0 / j as f64) } else { length_s }
    })
}

/// Attitude, rate and momentum of a body as series in time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(bound(
    serialize = "[Vector3<f64>; N]: Serialize, [Vector4<f64>; N]: Serialize",
    deserialize = "[Vector3<f64>; N]: Deserialize<'de>, [Vector4<f64>; N]: Deserialize<'de>"
))]
pub(crate) struct RotationSeries<const N: usize> {
    /// How many terms count beside the first.
    pub order: usize,
    /// EME2000 to body, scalar last.
    pub attitude: [Vector4<f64>; N],
    /// Body frame, in rad/s.
    pub rate: [Vector3<f64>; N],
    /// Body frame, in N m s.
    pub momentum: [Vector3<f64>; N],
}

impl<const N: usize> RotationSeries<N> {
    /// The state at the start alone.
    pub(crate) fn new(attitude: Quaternion, rate: Vector3<f64>, momentum: Vector3<f64>) -> Self {
        let mut series = Self {
            order: 0,
            attitude: [Vector4::zeros(); N],
            rate: [Vector3::zeros(); N],
            momentum: [Vector3::zeros(); N],
        };
        series.attitude[0] = attitude.0.into();
        (series.rate[0], series.momentum[0]) = (rate, momentum);
        series
    }

    /// Terms of the rate that count.
    pub(crate) fn rates(&self) -> &[Vector3<f64>] {
        &self.rate[..=self.order]
    }

    /// The next terms of attitude and momentum, from the torque's present one and the rate's up to that.
    #[inline]
    pub(crate) fn extend(&mut self, torque: Vector3<f64>) {
        let j = self.order;
        let (mut momentum_rate, mut attitude_rate) = (torque, Vector4::zeros());
        let rates = self.rate[..=j].iter().rev();
        for ((momentum, attitude), rate) in self.momentum.iter().zip(&self.attitude).zip(rates) {
            momentum_rate += momentum.cross(rate);
            let [[x, y, z, w]] = attitude.data.0;
            attitude_rate += Vector4::new(
                w * rate.x + y * rate.z - z * rate.y,
                w * rate.y + z * rate.x - x * rate.z,
                w * rate.z + x * rate.y - y * rate.x,
                -(x * rate.x + y * rate.y + z * rate.z),
            );
        }
        let divisor = (j + 1) as f64;
        self.momentum[j + 1] = momentum_rate / divisor;
        self.attitude[j + 1] = attitude_rate * 0.5 / divisor;
        self.order = j + 1;
    }

    /// EME2000 to body, `elapsed_s` after the start.
    #[inline]
    pub(crate) fn attitude_after(&self, elapsed_s: f64) -> Quaternion {
        Quaternion(polynomial(&self.attitude[..=self.order], elapsed_s).into()).normalized()
    }

    /// Whether its numbers can come from a simulation.
    pub(crate) fn is_valid(&self) -> bool {
        self.order < N && (self.attitude[0].norm_squared() - 1.0).abs() < 1e-9
    }
}

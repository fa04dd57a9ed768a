//! A vector function of time on one interval as a Chebyshev series of fixed size.
//!
//! Equation: f(t) = sum over k < N of c_k T_k(x), x = (t - centre) / half length.
//! Method: interpolation at the Chebyshev nodes of the first kind, c_k = (2/N) sum f(t_j) T_k(x_j) (half of that for k = 0);
//! evaluation by Clenshaw's recurrence, stable on the whole interval; derivative by the differentiated recurrence,
//! antiderivative by the relation of T_k to T_(k+1) and T_(k-1). Outside of its interval a segment extrapolates and grows
//! like `T_N`.
//! Order: N; for an analytic function the coefficients fall by a constant factor each.
//! Error measure: within a factor `(2/pi) ln N + 2` of the best polynomial of the same degree; the last coefficients tell
//! its size ([`super::adaptive`] keeps them below a tolerance).
//! Reference: Press et al., Numerical Recipes, 5.8 to 5.9; Trefethen, Approximation Theory and Approximation Practice, ch. 15
//! (the factor).

use core::f64::consts::PI;

use nalgebra::{SMatrix, SVector};
use serde::{Deserialize, Serialize};

use super::roots::{self, Roots};

/// `N` Chebyshev coefficients (degree `N - 1`) of a function with `D` components on `[start, end]`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Segment<const D: usize, const N: usize> {
    center: f64,
    half_length: f64,
    /// Column k belongs to `T_k`.
    coefficients: SMatrix<f64, D, N>,
}

impl<const D: usize, const N: usize> Segment<D, N> {
    /// The nodes on -1 to 1, in falling order.
    const UNIT_NODES: [f64; N] = unit_nodes();

    /// Whether `from`..`to` lies inside, up to rounding: there no value exceeds the sum of the coefficients.
    pub fn spans(&self, from: f64, to: f64) -> bool {
        let rounding = 1e-9 * self.half_length + 16.0 * f64::EPSILON * from.abs().max(to.abs());
        from >= self.start() - rounding && to <= self.end() + rounding
    }

    /// Whether a decoded interval is not reversed.
    pub fn is_valid(&self) -> bool {
        self.half_length >= 0.0
    }

    /// The abscissae at which [`Segment::from_samples`] wants the function, on `[start, end]`, in falling order.
    pub fn nodes(start: f64, end: f64) -> [f64; N] {
        let (center, half_length) = center_and_half_length(start, end);
        Self::UNIT_NODES.map(|x| center + half_length * x)
    }

    /// The polynomial through `samples`, taken at [`Segment::nodes`] of the same interval. Needs `N >= 1`.
    pub fn from_samples(start: f64, end: f64, samples: &[SVector<f64, D>; N]) -> Self {
        let mut coefficients = SMatrix::<f64, D, N>::zeros();
        for (sample, x) in samples.iter().zip(Self::UNIT_NODES) {
            let weighted = sample * (2.0 / N as f64);
            let (mut previous, mut current) = (x, 1.0);
            for mut column in coefficients.column_iter_mut() {
                column += weighted * current;
                (previous, current) = (current, 2.0 * x * current - previous);
            }
        }
        if N > 0 {
            let mut mean = coefficients.column_mut(0);
            mean *= 0.5;
        }
        Self::from_coefficients(start, end, coefficients)
    }

    /// Interpolates `function` on `[start, end]`.
    pub fn fit(start: f64, end: f64, function: impl FnMut(f64) -> SVector<f64, D>) -> Self {
        Self::from_samples(start, end, &Self::nodes(start, end).map(function))
    }

    /// The function on a part of its interval, by integrating `K` Chebyshev terms of its derivative. Interpolated values would
    /// give a derivative with their rounding error over the part's length. `M` must be `K + 1`.
    pub fn part<const K: usize, const M: usize>(&self, start: f64, end: f64) -> Segment<D, M> {
        let derivative = Segment::<D, K>::fit(start, end, |at| self.value_and_derivative(at).1);
        derivative.integral(self.value(start))
    }

    /// The series with these coefficients, column k for `T_k`.
    pub fn from_coefficients(start: f64, end: f64, coefficients: SMatrix<f64, D, N>) -> Self {
        let (center, half_length) = center_and_half_length(start, end);
        Self { center, half_length, coefficients }
    }

    /// The polynomial of four degrees more that equals this one at its `N` nodes and has `[value, derivative]` at start and end
    /// (Hermite): segments with ends in common continue smoothly. `M` must be `N + 4`.
    pub fn with_ends<const M: usize>(&self, ends: &[[SVector<f64, D>; 2]; 2]) -> Segment<D, M> {
        const { assert!(M == N + 4 && N > 3, "two conditions more at each end") }
        // This one plus T_N, which is zero at the nodes, times a cubic, whose values and slopes at -1 and 1 follow.
        let parity = if N.is_multiple_of(2) { 1.0 } else { -1.0 };
        let slope_of_last = (N * N) as f64;
        let [at_start, at_end] =
            [(0, -1.0, parity), (1, 1.0, 1.0)].map(|(end, x, last): (usize, f64, f64)| {
                let [value, derivative] = &ends[end];
                let (own, slope) = series_at(&self.coefficients.data.0, x);
                let missing = (value - SVector::from(own)) * last;
                let missing_slope = derivative * self.half_length - SVector::from(slope);
                [missing, missing_slope * last - missing * (x * slope_of_last)]
            });
        let even = (at_end[0] + at_start[0]) * 0.5;
        let odd = (at_end[0] - at_start[0]) * 0.5;
        let odd_slope = (at_end[1] + at_start[1]) * 0.5;
        let even_slope = (at_end[1] - at_start[1]) * 0.5;
        // a0 + a2 = even, 2 a2 = even slope, a1 + a3 = odd, a1 + 3 a3 = odd slope; in T_0 to T_3.
        let (square, cube) = (even_slope * 0.5, (odd_slope - odd) * 0.5);
        let cubic = [even - square * 0.5, odd - cube * 0.25, square * 0.5, cube * 0.25];
        let mut coefficients = SMatrix::<f64, D, M>::zeros();
        coefficients.fixed_columns_mut::<N>(0).copy_from(&self.coefficients);
        for (k, term) in cubic.iter().enumerate() {
            for index in [N + k, N - k] {
                let mut column = coefficients.column_mut(index);
                column += term * 0.5;
            }
        }
        Segment { center: self.center, half_length: self.half_length, coefficients }
    }

    /// Start of the segment.
    pub fn start(&self) -> f64 {
        self.center - self.half_length
    }

    /// End of the segment.
    pub fn end(&self) -> f64 {
        self.center + self.half_length
    }

    /// The coefficients, column k for `T_k`.
    pub fn coefficients(&self) -> &SMatrix<f64, D, N> {
        &self.coefficients
    }

    /// Largest magnitude of the coefficients from this term on.
    pub fn largest_term(&self, from: usize) -> f64 {
        let columns = self.coefficients.data.0.get(from..).unwrap_or_default();
        largest_magnitude(columns.iter().flatten())
    }

    /// The function at `at`.
    pub fn value(&self, at: f64) -> SVector<f64, D> {
        let x = (at - self.center) / self.half_length;
        let (first, others) = constant_and_others(&self.coefficients.data.0);
        let (mut b1, mut b2) = ([0.0; D], [0.0; D]);
        for column in others.iter().rev() {
            for i in 0..D {
                (b1[i], b2[i]) = (2.0 * x * b1[i] + (column[i] - b2[i]), b1[i]);
            }
        }
        SVector::from_fn(|i, _| x * b1[i] + (first[i] - b2[i]))
    }

    /// The function and its first derivative at `at`.
    pub fn value_and_derivative(&self, at: f64) -> (SVector<f64, D>, SVector<f64, D>) {
        let per_half_length = 1.0 / self.half_length;
        let x = (at - self.center) * per_half_length;
        let (value, derivative) = series_at(&self.coefficients.data.0, x);
        (SVector::from(value), SVector::from_fn(|i, _| derivative[i] * per_half_length))
    }

    /// The exact antiderivative that equals `value_at_start` at the segment's start; `M` must be `N + 1`.
    pub fn integral<const M: usize>(&self, value_at_start: SVector<f64, D>) -> Segment<D, M> {
        const { assert!(M == N + 1, "an antiderivative has one coefficient more") }
        let mut coefficients = SMatrix::<f64, D, M>::zeros();
        let column = |k: usize| {
            if k < N { self.coefficients.column(k).clone_owned() } else { SVector::zeros() }
        };
        let mut at_start = SVector::<f64, D>::zeros();
        for k in 1..M {
            let below = if k == 1 { column(0) * 2.0 } else { column(k - 1) };
            let term = (below - column(k + 1)) * (self.half_length / (2.0 * k as f64));
            coefficients.set_column(k, &term);
            at_start += if k % 2 == 0 { term } else { -term };
        }
        coefficients.set_column(0, &(value_at_start - at_start));
        Segment { center: self.center, half_length: self.half_length, coefficients }
    }

    /// One function of the segment times `factor`, plus `offset`; the others, which may not be finite, have no part in it.
    pub fn row(&self, row: usize, factor: f64, offset: f64) -> Segment<1, N> {
        let mut coefficients = self.coefficients.fixed_rows::<1>(row) * factor;
        if N > 0 {
            coefficients[0] += offset;
        }
        Segment { center: self.center, half_length: self.half_length, coefficients }
    }
}

impl<const N: usize> Segment<1, N> {
    /// Every abscissa in `[from, to]`, within the segment, at which the function changes sign, in rising order.
    ///
    /// Complete: found by sign counts of Bernstein coefficients, which never overlook a pair of roots, unless two
    /// roots are closer than 1e-12 of the segment. A touch without a change of sign is not reported; a root that
    /// is exactly `from` is not reported either, a root that is exactly `to` is (the function leaves zero or
    /// arrives there). Accuracy: 4e-16 of the segment, or where rounding of the function takes over.
    pub fn sign_changes(&self, from: f64, to: f64) -> Roots<N> {
        let u_from = ((from - self.start()) / (2.0 * self.half_length)).clamp(0.0, 1.0);
        let u_to = ((to - self.start()) / (2.0 * self.half_length)).clamp(0.0, 1.0);
        let coefficients: [f64; N] = core::array::from_fn(|k| self.coefficients[k]);
        let bound: f64 = coefficients.iter().skip(1).map(|c| c.abs()).sum();
        if N < 2 || coefficients[0].abs() > bound {
            return Roots::default();
        }
        let bernstein = bernstein_from_chebyshev(&coefficients);
        let mut found = roots::bernstein_sign_changes(&bernstein, u_from, u_to);
        found.map(|u| self.start() + u * 2.0 * self.half_length);
        found
    }
}

/// The series with these coefficients, item k for `T_k`, and its derivative, at `x` in -1 to 1 (Clenshaw's recurrence).
#[inline]
pub fn series_at<const D: usize>(coefficients: &[[f64; D]], x: f64) -> ([f64; D], [f64; D]) {
    let (mut b1, mut b2, mut d1, mut d2) = ([0.0; D], [0.0; D], [0.0; D], [0.0; D]);
    let (first, others) = constant_and_others(coefficients);
    for column in others.iter().rev() {
        for i in 0..D {
            (d1[i], d2[i]) = (2.0 * x * d1[i] + (2.0 * b1[i] - d2[i]), d1[i]);
            (b1[i], b2[i]) = (2.0 * x * b1[i] + (column[i] - b2[i]), b1[i]);
        }
    }
    let value = core::array::from_fn(|i| x * b1[i] + (first[i] - b2[i]));
    let derivative = core::array::from_fn(|i| x * d1[i] + (b1[i] - d2[i]));
    (value, derivative)
}

/// Largest magnitude, NaN ignored; faster than a fold by `f64::max`.
#[inline]
pub fn largest_magnitude<'a>(values: impl IntoIterator<Item = &'a f64>) -> f64 {
    values.into_iter().fold(0.0, |most, value| if value.abs() > most { value.abs() } else { most })
}

/// The coefficient of `T_0` and the others.
fn constant_and_others<const D: usize>(coefficients: &[[f64; D]]) -> ([f64; D], &[[f64; D]]) {
    coefficients.split_first().map_or(([0.0; D], &[]), |(first, others)| (*first, others))
}

/// The Bernstein coefficients on `[0, 1]` of a Chebyshev series on `[-1, 1]`, both of degree `N - 1`.
fn bernstein_from_chebyshev<const N: usize>(coefficients: &[f64; N]) -> [f64; N] {
    let mut sum = [0.0; N];
    for (degree, &coefficient) in coefficients.iter().enumerate() {
        // T_k = sum (-1)^(k-i) C(2k, 2i) / C(k, i) B_i^k, by the ratio of neighbouring terms.
        let mut basis = [0.0; N];
        let mut magnitude = coefficient;
        for (i, b) in basis.iter_mut().enumerate().take(degree + 1) {
            *b = if (degree - i).is_multiple_of(2) { magnitude } else { -magnitude };
            let (k, j) = (degree as f64, i as f64);
            magnitude *= (2.0 * k - 2.0 * j - 1.0) / (2.0 * j + 1.0);
        }
        for from in degree..N - 1 {
            let to = (from + 1) as f64;
            basis[from + 1] = basis[from];
            for i in (1..=from).rev() {
                let share = i as f64 / to;
                basis[i] = share * basis[i - 1] + (1.0 - share) * basis[i];
            }
        }
        for (total, term) in sum.iter_mut().zip(basis) {
            *total += term;
        }
    }
    sum
}

fn center_and_half_length(start: f64, end: f64) -> (f64, f64) {
    (0.5 * (start + end), 0.5 * (end - start))
}

/// A fit needs them again and again, so they are computed where the library is built.
const fn unit_nodes<const N: usize>() -> [f64; N] {
    let mut nodes = [0.0; N];
    let mut j = 0;
    while j < N {
        // The middle node of an odd count is zero, which the rounded angle misses by 6e-17.
        if 2 * j + 1 != N {
            nodes[j] = cosine(PI * (j as f64 + 0.5) / N as f64);
        }
        j += 1;
    }
    nodes
}

/// Cosine of an angle of 0 to pi, by Taylor's series in integers of 62 binary places: rounded from what is right to 1e-17.
const fn cosine(angle_rad: f64) -> f64 {
    const ONE: i128 = 1 << 62;
    const HALF_TURN: i128 = 14_488_038_916_154_245_685;
    let angle = (angle_rad * ONE as f64) as i128;
    let is_obtuse = 2 * angle > HALF_TURN;
    let acute = if is_obtuse { HALF_TURN - angle } else { angle };
    let square = (acute * acute) / ONE;
    let (mut sum, mut term, mut order) = (ONE, ONE, 2);
    while term != 0 {
        term = -(term * square / ONE) / (order * (order - 1));
        sum += term;
        order += 2;
    }
    let cosine = sum as f64 / ONE as f64;
    if is_obtuse { -cosine } else { cosine }
}

#[cfg(test)]
mod tests;

//! Partials of quantities by the state of a spacecraft at earlier times of a given path.
//!
//! Equation: with x' = f(t, x) and A = [[0, 1], [G, 0]], G the gradient of the acceleration by the position, partials L of
//! quantities by x obey L' = -L A backward in time (the adjoint equation). From the identity on they are the transition matrix.
//! Method: Gauss collocation over one interval, rows apart; G is evaluated once a node.
//! Order: 16 at the interval's start, 9 within it.
//! Error measure: none; an interval is as short as the gradient changes little in it: within 0.3 of the distance over the speed
//! partials err by 1e-9 (tested).
//! Reference: Battin, An Introduction to the Mathematics and Methods of Astrodynamics, 9.5.

use nalgebra::{Matrix3, Matrix6, SMatrix, SVector, Vector3, Vector6};

use physics::environment::orbit::{OrbitMethod, TERMS};
use physics::numerics::{Span, chebyshev::Segment, collocation::IntegrationError};

/// Partials of `R` quantities by position (m) and velocity (m/s), EME2000, at all times of an interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Partials<const R: usize> {
    /// Interval.
    pub span: Span,
    /// A row a quantity, by time before the end.
    rows: [Segment<6, TERMS>; R],
    /// The rows at its start.
    pub at_start: SMatrix<f64, R, 6>,
}

impl<const R: usize> Partials<R> {
    /// By the state at a time of the interval, s.
    pub fn at(&self, time_s: f64) -> SMatrix<f64, R, 6> {
        let Span { start_s, end_s } = self.span;
        if time_s <= start_s {
            return self.at_start;
        }
        let mut found = SMatrix::<f64, R, 6>::zeros();
        for (row, segment) in self.rows.iter().enumerate() {
            found.set_row(row, &segment.value((end_s - time_s).max(0.0)).transpose());
        }
        found
    }
}

/// Partials over an interval of quantities whose partials by the state at its end are `at_end`;
/// `gradient_per_s2(t)` is that of the acceleration along the path, in EME2000.
///
/// # Errors
/// [`IntegrationError`]: a gradient that is not finite, an interval that is too long.
pub fn partials_over<const R: usize>(
    method: &OrbitMethod,
    span: Span,
    at_end: &SMatrix<f64, R, 6>,
    mut gradient_per_s2: impl FnMut(f64) -> Matrix3<f64>,
) -> Result<Partials<R>, IntegrationError> {
    let Span { start_s, end_s } = span;
    let mut computed: Vec<(f64, Matrix3<f64>)> = Vec::with_capacity(TERMS);
    let mut gradient = |before_end_s: f64| {
        if let Some((_, gradient)) = computed.iter().find(|(at_s, _)| *at_s == before_end_s) {
            return *gradient;
        }
        let gradient = gradient_per_s2(end_s - before_end_s);
        computed.push((before_end_s, gradient));
        gradient
    };
    let mut at_start = SMatrix::<f64, R, 6>::zeros();
    let mut rows = [Segment::from_coefficients(0.0, end_s - start_s, SMatrix::zeros()); R];
    for (row, segment) in rows.iter_mut().enumerate() {
        let at_end: SVector<f64, 6> = at_end.row(row).transpose();
        let (found, at_the_start) =
            method.solve(0.0, end_s - start_s, &at_end, None, |before_end_s, row: &Vector6<f64>| {
                let [by_position, by_velocity] =
                    [0, 3].map(|at| Vector3::new(row[at], row[at + 1], row[at + 2]));
                let by_position_rate = gradient(before_end_s).tr_mul(&by_velocity);
                let mut rate = Vector6::zeros();
                rate.fixed_rows_mut::<3>(0).copy_from(&by_position_rate);
                rate.fixed_rows_mut::<3>(3).copy_from(&by_position);
                rate
            })?;
        *segment = found;
        at_start.set_row(row, &at_the_start.transpose());
    }
    Ok(Partials { span, rows, at_start })
}

/// The transition matrix from the start of an interval to its end: partials of the state there by that here.
///
/// # Errors
/// See [`partials_over`].
pub fn transition(
    method: &OrbitMethod,
    span: Span,
    gradient_per_s2: impl FnMut(f64) -> Matrix3<f64>,
) -> Result<Matrix6<f64>, IntegrationError> {
    Ok(partials_over(method, span, &Matrix6::identity(), gradient_per_s2)?.at_start)
}

#[cfg(test)]
mod tests;

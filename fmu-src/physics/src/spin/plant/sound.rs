//! Numbers and vectors that a decoded flight can have.

use nalgebra::Vector3;

/// Squares and products of numbers up to this are finite.
const GREATEST: f64 = 1e100;
/// How far the norm of a unit vector may be off 1.
const UNIT: f64 = 1e-6;

/// Whether a number and its square are finite; written so that a NaN is none.
pub(super) fn is_moderate(value: f64) -> bool {
    value.abs() <= GREATEST
}

pub(super) fn are_moderate<'a>(values: impl IntoIterator<Item = &'a f64>) -> bool {
    values.into_iter().all(|&value| is_moderate(value))
}

pub(super) fn is_unit(vector: &Vector3<f64>) -> bool {
    (vector.norm() - 1.0).abs() <= UNIT
}

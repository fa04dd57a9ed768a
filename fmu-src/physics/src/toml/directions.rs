//! Unit vectors as files write them: lengths off 1 by rounding are renormalised, others refused.

use nalgebra::Vector3;

use super::numbers::{rounded, short};

/// How far a direction's length, or a matrix's orthonormality, may be off before it is refused.
///
/// Printed tables round to three or four digits; a larger error is a mistake, not rounding.
pub(super) const UNIT_TOLERANCE: f64 = 1e-3;

/// Returns the direction renormalised; `None` if its length is off 1 by more than the tolerance.
pub(super) fn unit(written: [f64; 3]) -> Option<Vector3<f64>> {
    let vector = Vector3::from(written);
    let norm = vector.norm();
    ((norm - 1.0).abs() <= UNIT_TOLERANCE).then(|| vector / norm)
}

/// Returns the words that refuse a direction: found and allowed.
pub(super) fn refusal(written: [f64; 3]) -> (String, String) {
    let vector = Vector3::from(written);
    let norm = vector.norm();
    let unit = (norm > f64::MIN_POSITIVE && norm.is_finite()).then(|| vector / norm);
    let shown = unit.map(|unit| {
        let [x, y, z] = unit.map(|component| (component * 1e6).round() / 1e6 + 0.0).into();
        format!(", here [{x}, {y}, {z}]")
    });
    let found = format!("{written:?} of length {}", short(rounded(norm)));
    let shown = shown.unwrap_or_default();
    (found, format!("a unit vector (length 1 within 1e-3; it is then renormalised){shown}"))
}

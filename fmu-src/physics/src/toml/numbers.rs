//! Numbers as messages show them.

/// A number without a row of zeros.
pub(super) fn short(value: f64) -> String {
    if value == 0.0 || (1e-5..1e16).contains(&value.abs()) { value.to_string() } else { format!("{value:e}") }
}

/// To twelve significant digits: without the noise of a sum.
pub(crate) fn rounded(value: f64) -> f64 {
    format!("{value:.11e}").parse().unwrap_or(value)
}

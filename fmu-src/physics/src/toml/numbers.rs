//! Numbers as messages show them.

/// A number without a row of zeros.
pub(super) fn short(value: f64) -> String {
    if value == 0.0 || (1e-5..1e16).contains(&value.abs()) { value.to_string() } else { format!("{value:e}") }
}

/// To twelve significant digits: without the noise of a sum.
pub(crate) fn rounded(value: f64) -> f64 {
    format!("{value:.11e}").parse().unwrap_or(value)
}

/// Splits a text into its number and the unit behind it, which may be empty; `None` without a number.
pub(crate) fn with_unit(text: &str) -> Option<(f64, &str)> {
    let text = text.trim();
    // A unit holds no digit, a number ends in a digit or in a point right behind one.
    let digits = text.rfind(|c: char| c.is_ascii_digit())? + 1;
    let end = digits + usize::from(text[digits..].starts_with('.'));
    let (number, unit) = text.split_at_checked(end)?;
    Some((number.parse().ok()?, unit.trim()))
}

/// The number with one of these units; `None` without a number or with another unit.
pub(crate) fn in_units(text: &str, units: &[(&str, f64)]) -> Option<f64> {
    let (number, unit) = with_unit(text)?;
    Some(number * units.iter().find(|(name, _)| *name == unit)?.1)
}

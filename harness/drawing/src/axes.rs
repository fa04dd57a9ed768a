//! Round steps of an axis, and the texts of their multiples.

/// Greatest magnitude that is drawn: spans of what is beyond overflow, so it is as good as infinite.
const GREATEST: f64 = 1e300;

/// Whether a value has a place in a picture.
pub fn is_drawable(value: f64) -> bool {
    value.abs() <= GREATEST
}

/// Multiples drawn at most.
const MAX_TICKS: i64 = 100;

/// The least round number (1, 2 or 5 times a power of ten) that is not below a value above 0.
pub fn round_up(value: f64) -> f64 {
    let power = 10_f64.powf(value.log10().floor());
    [1.0, 2.0, 5.0]
        .map(|digit| digit * power)
        .into_iter()
        .find(|round| *round >= value * (1.0 - 1e-9))
        .unwrap_or(10.0 * power)
}

/// Multiples of a step from the one end to the other; none of a step that is not above 0.
pub fn ticks([low, high]: [f64; 2], step: f64) -> Vec<f64> {
    if step.is_nan() || step <= 0.0 {
        return Vec::new();
    }
    let (first, last) = ((low / step - 1e-9).ceil() as i64, (high / step + 1e-9).floor() as i64);
    (first..=last.min(first.saturating_add(MAX_TICKS))).map(|k| k as f64 * step).collect()
}

/// The text of a multiple of a step, with as many digits as the step needs.
pub fn tick_text(value: f64, step: f64) -> String {
    // A tick within rounding of zero is zero.
    let value = if value.abs() < step * 1e-6 { 0.0 } else { value };
    let (magnitude, decade) = (value.abs().max(step), (step.log10() + 1e-9).floor());
    if (1e-3..1e6).contains(&magnitude) && step >= 1e-5 {
        let digits = (-decade).clamp(0.0, 6.0);
        return format!("{value:.*}", digits as usize);
    }
    if value == 0.0 {
        return "0".to_owned();
    }
    let digits = (magnitude.log10().floor() - decade).clamp(0.0, 6.0);
    format!("{value:.*e}", digits as usize)
}

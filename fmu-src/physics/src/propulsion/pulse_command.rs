//! A thruster's command within a step, as a master gives it.

use serde::{Deserialize, Serialize};

use crate::numerics::spacing::spacing;

/// A thruster command within a step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PulseCommand {
    /// From the start of the step, in s.
    pub delay_s: f64,
    /// How long, in s.
    pub on_s: f64,
}

impl PulseCommand {
    /// A pulse whose times are rounded to whole steps of `resolution_s`; 0 = not rounded.
    pub fn rounded(delay_s: f64, on_s: f64, resolution_s: f64) -> Self {
        let rounded = |time_s: f64| {
            let time_s = time_s.max(0.0);
            let steps = time_s / resolution_s;
            // So many steps that doubles do not count them are as fine as no rounding.
            if resolution_s > 0.0 && steps < 1e15 { steps.round() * resolution_s } else { time_s }
        };
        Self { delay_s: rounded(delay_s), on_s: rounded(on_s) }
    }

    /// Whether decoded numbers can be some.
    pub fn is_valid(&self) -> bool {
        self.delay_s >= 0.0 && self.on_s >= 0.0
    }

    /// Whether it does not end within a step, by more than the rounding of times.
    pub fn is_cut(&self, start_s: f64, end_s: f64) -> bool {
        self.on_s > 0.0 && self.delay_s + self.on_s > end_s - start_s + Self::rounding_s(start_s, end_s)
    }

    /// By how much times within a step from `start_s` to `end_s`, in s, are taken for the same.
    pub(super) fn rounding_s(start_s: f64, end_s: f64) -> f64 {
        1e-9 * (end_s - start_s) + 8.0 * spacing(start_s.abs().max(end_s.abs()))
    }
}

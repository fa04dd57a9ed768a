//! The horizontal axis of a picture over time: its unit, and dates where the epoch is known.

use super::date_axis::DateAxis;

/// Time units: from how long a span on, name, seconds.
const TIME_UNITS: [(f64, &str, f64); 4] =
    [(3.0 * 86_400.0, "d", 86_400.0), (3.0 * 3600.0, "h", 3600.0), (600.0, "min", 60.0), (0.0, "s", 1.0)];

/// The axis.
#[derive(Clone, Debug, PartialEq)]
pub struct TimeAxis {
    /// Seconds of a unit of it.
    pub seconds: f64,
    /// Label of the axis.
    pub label: String,
    /// Places with their dates; empty: numbers.
    pub names: Vec<(f64, String)>,
}

impl TimeAxis {
    /// From one time to another in s, with dates where the epoch of time 0 is known in s past J2000 TDB.
    pub fn over([first_s, last_s]: [f64; 2], zero_epoch_s: Option<f64>) -> Self {
        let unit = TIME_UNITS.into_iter().find(|(from_s, _, _)| last_s - first_s >= *from_s);
        let (_, unit, seconds) = unit.unwrap_or((0.0, "s", 1.0));
        let dated = zero_epoch_s
            .and_then(|zero_s| Some((zero_s, DateAxis::over(zero_s + first_s, zero_s + last_s)?)))
            .map(|(zero_s, DateAxis { ticks, label })| {
                let names = ticks.into_iter().map(|(at_s, text)| ((at_s - zero_s) / seconds, text)).collect();
                (names, label)
            });
        let (names, label) = dated.unwrap_or_else(|| (Vec::new(), format!("time [{unit}]")));
        Self { seconds, label, names }
    }
}

//! Dates on the horizontal axis of a picture: round times of UTC, and what stands at them.

use inputs::epoch;
use physics::{constants::DAY_S, environment::dates};

/// Ticks at most, but for the ends.
const MAX_TICKS: f64 = 10.0;
const MONTH_S: f64 = 30.437 * DAY_S;
/// Steps within a day, in s.
const STEPS_S: [u32; 17] =
    [1, 2, 5, 10, 15, 30, 60, 120, 300, 600, 900, 1800, 3600, 7200, 10_800, 21_600, 43_200];
/// Steps in days, and in months.
const STEPS_D: [u32; 4] = [1, 2, 5, 10];
const STEPS_MONTHS: [u32; 9] = [1, 2, 3, 6, 12, 24, 60, 120, 240];

/// The ticks of an axis, and its label.
pub(super) struct DateAxis {
    /// Epochs in s past J2000 TDB, with their texts.
    pub ticks: Vec<(f64, String)>,
    /// Label of the axis.
    pub label: String,
}

impl DateAxis {
    /// From one epoch to another, in s past J2000 TDB; `None` before UTC, and where hardly a round time lies within.
    pub(super) fn over(first_s: f64, last_s: f64) -> Option<Self> {
        let interval_s = (last_s - first_s) / MAX_TICKS;
        let day = day_of(first_s)?;
        let step = |steps: &[u32], unit_s: f64| {
            steps.iter().copied().find(|step| f64::from(*step) * unit_s >= interval_s * (1.0 - 1e-9))
        };
        let (ticks, label) = if let Some(step_s) = step(&STEPS_S, 1.0) {
            (within_days(first_s, last_s, step_s)?, format!("UTC, from {day}"))
        } else if let Some(days) = step(&STEPS_D, DAY_S) {
            (by_days(first_s, last_s, days)?, "UTC".to_owned())
        } else {
            (by_months(&day, last_s, step(&STEPS_MONTHS, MONTH_S)?), "UTC".to_owned())
        };
        let ticks: Vec<_> = ticks.into_iter().filter(|(at_s, _)| (first_s..=last_s).contains(at_s)).collect();
        (ticks.len() > 1).then_some(Self { ticks, label })
    }
}

/// The day of an epoch: `2011-04-06`.
fn day_of(epoch_s: f64) -> Option<String> {
    epoch::date(epoch_s)?.get(..10).map(str::to_owned)
}

fn begin_s(day: &str) -> Option<f64> {
    dates::epoch_s(&format!("{day} UTC")).ok()
}

/// Days with their beginnings, from that of the first epoch to that of the last.
fn days(first_s: f64, last_s: f64) -> Option<Vec<(String, f64)>> {
    let mut days = Vec::new();
    let mut at_s = first_s;
    loop {
        let day = day_of(at_s)?;
        let begin_s = begin_s(&day)?;
        if begin_s > last_s {
            return Some(days);
        }
        days.push((day, begin_s));
        // The middle of the next day, whether or not a leap second lies between.
        at_s = begin_s + 1.5 * DAY_S;
    }
}

fn within_days(first_s: f64, last_s: f64, step_s: u32) -> Option<Vec<(f64, String)>> {
    let mut ticks = Vec::new();
    for (day, begin_s) in days(first_s, last_s)? {
        for second in (0..DAY_S as u32).step_by(step_s as usize) {
            let (hour, minute, second_of_minute) = (second / 3600, second / 60 % 60, second % 60);
            let text = match second {
                0 => day[5..].to_owned(),
                _ if step_s < 60 => format!("{hour:02}:{minute:02}:{second_of_minute:02}"),
                _ => format!("{hour:02}:{minute:02}"),
            };
            ticks.push((begin_s + f64::from(second), text));
        }
    }
    Some(ticks)
}

fn by_days(first_s: f64, last_s: f64, step: u32) -> Option<Vec<(f64, String)>> {
    // From the first day that begins within.
    let begun = days(first_s, last_s)?.into_iter().filter(|(_, begin_s)| *begin_s >= first_s);
    Some(begun.step_by(step as usize).map(|(day, begin_s)| (begin_s, day)).collect())
}

fn by_months(first_day: &str, last_s: f64, step: u32) -> Vec<(f64, String)> {
    let first_year: u32 = first_day[..4].parse().unwrap_or_default();
    let whole_years = (step / 12).max(1);
    let first = 12 * (first_year / whole_years * whole_years);
    let months = (first..).step_by(step as usize).map(|month| (month / 12, month % 12 + 1));
    let ticks = months.map_while(|(year, month)| {
        let at_s = begin_s(&format!("{year:04}-{month:02}-01"));
        // A year before UTC is none of the ticks.
        let at_s = if year < 1972 { Some(f64::NEG_INFINITY) } else { at_s };
        let text = if step < 12 { format!("{year:04}-{month:02}") } else { format!("{year:04}") };
        at_s.filter(|at_s| *at_s <= last_s).map(|at_s| (at_s, text))
    });
    ticks.collect()
}

#[cfg(test)]
mod tests {
    //! Ticks are read back as the dates that they say.

    use super::*;

    fn axis(first: &str, last: &str) -> (Vec<String>, String) {
        let [first_s, last_s] = [first, last].map(|date| dates::epoch_s(date).unwrap());
        let axis = DateAxis::over(first_s, last_s).unwrap();
        assert!(axis.ticks.len() <= 12 && axis.ticks.is_sorted_by(|a, b| a.0 < b.0));
        (axis.ticks.into_iter().map(|(_, text)| text).collect(), axis.label)
    }

    #[test]
    fn round_times_are_ticks() {
        let (ticks, label) = axis("2011-04-06T05:30:00 UTC", "2011-04-07T01:00:00 UTC");
        assert_eq!(ticks[..2], ["06:00", "08:00"]);
        assert!(ticks.contains(&"04-07".to_owned()) && label == "UTC, from 2011-04-06", "{ticks:?} {label}");
        assert_eq!(axis("2011-04-06T00:00:00 UTC", "2011-04-06T00:00:10 UTC").0[1], "00:00:01");
        let (ticks, label) = axis("2011-04-06T12:00:00 UTC", "2011-04-16T12:00:00 UTC");
        assert_eq!((ticks.len(), ticks[0].as_str(), label.as_str()), (10, "2011-04-07", "UTC"));
        assert_eq!(
            axis("2011-02-10 UTC", "2011-07-10 UTC").0,
            ["2011-03", "2011-04", "2011-05", "2011-06", "2011-07"]
        );
        assert_eq!(axis("2004-08-03 UTC", "2015-04-30 UTC").0[..2], ["2006", "2008"]);
    }

    #[test]
    fn a_leap_second_moves_no_tick() {
        let [first_s, last_s] =
            ["2016-12-31T12:00:00 UTC", "2017-01-01T12:00:00 UTC"].map(|date| dates::epoch_s(date).unwrap());
        let ticks = DateAxis::over(first_s, last_s).unwrap().ticks;
        let new_year_s = dates::epoch_s("2017-01-01 UTC").unwrap();
        assert_eq!(ticks.iter().find(|(_, text)| text == "01-01").unwrap().0, new_year_s);
        assert!(DateAxis::over(first_s, first_s + 0.1).is_none());
    }
}

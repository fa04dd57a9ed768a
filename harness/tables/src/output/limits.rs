//! Whether a run keeps its mission's limits: when each was first broken, and what it came to.

use fmi::Recording;
use inputs::{epoch, mission::Limit};
use model_description::Description;

use super::display_form::DisplayForm;

/// How a limit fares.
struct LimitCheck {
    limit: Limit,
    /// Time in s and value when it was first broken.
    broken: Option<(f64, f64)>,
    smallest: f64,
    largest: f64,
}

/// The limits of a run.
pub struct LimitChecks {
    checks: Vec<LimitCheck>,
    rows: usize,
}

impl LimitChecks {
    /// Before the first row.
    pub fn new(limits: Vec<Limit>) -> Self {
        let checks = limits.into_iter().map(|limit| LimitCheck {
            limit,
            broken: None,
            smallest: f64::INFINITY,
            largest: f64::NEG_INFINITY,
        });
        Self { checks: checks.collect(), rows: 0 }
    }

    /// Checks the rows that were added.
    pub fn update(&mut self, recording: &Recording) {
        let rows = recording.times_s.len();
        for check in &mut self.checks {
            let Some(column) = recording.column(&check.limit.name) else { continue };
            for row in self.rows..rows {
                let value = column.number(row);
                check.smallest = check.smallest.min(value);
                check.largest = check.largest.max(value);
                let is_kept = check.limit.min.is_none_or(|min| value >= min)
                    && check.limit.max.is_none_or(|max| value <= max);
                if !is_kept && check.broken.is_none() {
                    check.broken = Some((recording.times_s[row], value));
                }
            }
        }
        self.rows = rows;
    }

    /// Whether all were kept.
    pub fn is_kept(&self) -> bool {
        self.checks.iter().all(|check| check.broken.is_none())
    }

    /// A line for each limit; `epoch_minus_time_s` gives dates.
    pub fn report(&self, described: &Description, epoch_minus_time_s: Option<f64>) -> Vec<String> {
        self.checks.iter().map(|check| check.line(described, epoch_minus_time_s)).collect()
    }
}

impl LimitCheck {
    fn line(&self, described: &Description, epoch_minus_time_s: Option<f64>) -> String {
        let shown = DisplayForm::new(described, &self.limit.name);
        let number = |value: f64| shown.text(shown.value(value));
        let unit = if shown.unit.is_empty() || shown.unit == "1" {
            String::new()
        } else {
            format!(" {}", shown.unit)
        };
        let bounds = match (self.limit.min, self.limit.max) {
            (Some(min), Some(max)) => format!("from {} to {}{unit}", number(min), number(max)),
            (Some(min), None) => format!("from {}{unit} up", number(min)),
            (None, Some(max)) => format!("up to {}{unit}", number(max)),
            (None, None) => String::new(),
        };
        let range = format!("it went from {} to {}{unit}", number(self.smallest), number(self.largest));
        let Some((time_s, value)) = self.broken else {
            return format!("kept: {} {bounds}; {range}", self.limit.name);
        };
        let date = epoch_minus_time_s.and_then(|zero_s| epoch::date(zero_s + time_s));
        let date = date.map(|date| format!(" ({date})")).unwrap_or_default();
        format!(
            "{}: found {}{unit} at {} s{date}, the first time, allowed: {} {bounds}; {range}",
            self.limit.at,
            number(value),
            terminal::short(time_s),
            self.limit.name,
        )
    }
}

#[cfg(test)]
mod tests {
    //! The first row outside is the one that is reported; NaN is outside.

    use fmi::Column;

    use super::*;

    fn checked(values: &[f64], min: Option<f64>, max: Option<f64>) -> LimitChecks {
        let limit = Limit { name: "x".to_owned(), min, max, at: "m.toml:3: limits.x".to_owned() };
        let mut checks = LimitChecks::new(vec![limit]);
        // Row by row, as a run would show them.
        for rows in 1..=values.len() {
            checks.update(&Recording {
                times_s: (0..rows).map(|k| 60.0 * k as f64).collect(),
                names: vec!["x".to_owned()],
                units: vec![String::new()],
                columns: vec![Column::Real(values[..rows].to_vec())],
            });
        }
        checks
    }

    #[test]
    fn the_first_row_outside_is_reported() {
        let checked_of = |values: &[f64]| checked(values, Some(-1.0), Some(2.0));
        assert!(checked_of(&[-1.0, 0.0, 2.0]).is_kept(), "bounds are kept at themselves");
        let broken = checked_of(&[0.0, 3.0, -5.0, 1.0]);
        assert!(!broken.is_kept());
        let [line] = broken.report(&Description::default(), None).try_into().unwrap();
        assert_eq!(
            line,
            "m.toml:3: limits.x: found 3 at 60 s, the first time, allowed: x from -1 to 2; it went from -5 to 3"
        );
        let dated = broken.report(&Description::default(), Some(0.0)).remove(0);
        assert!(dated.contains("at 60 s (2000-01-01T11:59:55.816 UTC)"), "{dated}");
        assert!(!checked(&[1.0, f64::NAN], Some(0.0), None).is_kept());
    }
}

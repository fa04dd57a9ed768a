//! The scaffold of every study: cases chosen by their labels, simulated on all cores, their recorded columns.

use loader::{Fmu, Value};
use rayon::prelude::*;

use crate::{Options, StudyError};

/// One simulation: what is set, how long and how finely.
#[derive(Clone, Debug)]
pub(crate) struct Case {
    /// For messages and tables.
    pub label: String,
    sets: Vec<(String, Value)>,
    stop_s: f64,
    step_s: f64,
    apart: Option<String>,
}

/// Recorded columns, in the order of the names, and the communication points.
#[derive(Clone, Debug)]
pub(crate) struct Recorded {
    /// Communication points, in s.
    pub times_s: Vec<f64>,
    /// Columns.
    pub columns: Vec<Vec<f64>>,
}

impl Recorded {
    /// Last value of a column.
    pub fn last(&self, column: usize) -> f64 {
        self.columns[column].last().copied().unwrap_or(f64::NAN)
    }

    /// Greatest value of a column.
    pub fn most(&self, column: usize) -> f64 {
        self.columns[column].iter().copied().fold(f64::NEG_INFINITY, f64::max)
    }
}

impl Case {
    /// The FMU as it is packed, for `stop_s` in steps of `step_s`.
    pub fn new(label: impl Into<String>, stop_s: f64, step_s: f64) -> Self {
        Self { label: label.into(), sets: Vec::new(), stop_s, step_s, apart: None }
    }

    /// For `stop_s` in steps of `step_s` instead.
    pub fn grid(mut self, stop_s: f64, step_s: f64) -> Self {
        (self.stop_s, self.step_s) = (stop_s, step_s);
        self
    }

    /// With more points between those of the grid, so that the Integer `counter` rises by one from point to point.
    pub fn apart(mut self, counter: &str) -> Self {
        self.apart = Some(counter.to_owned());
        self
    }

    fn set(mut self, name: &str, value: Value) -> Self {
        self.sets.retain(|(known, _)| known != name);
        self.sets.push((name.to_owned(), value));
        self
    }

    /// Sets a Real.
    pub fn real(self, name: &str, value: f64) -> Self {
        self.set(name, Value::Real(value))
    }

    /// Sets an Integer or the number of an option.
    pub fn integer(self, name: &str, value: i32) -> Self {
        self.set(name, Value::Integer(value))
    }

    /// Sets a Boolean.
    pub fn boolean(self, name: &str, value: bool) -> Self {
        self.set(name, Value::Boolean(value))
    }

    /// The error of this case.
    pub fn failed(&self, source: impl Into<Box<dyn std::error::Error + Send + Sync>>) -> StudyError {
        StudyError::Simulation { case: self.label.clone(), source: source.into() }
    }

    /// Simulates it and returns the columns of `names`.
    pub fn simulate<S: AsRef<str>>(&self, fmu: &Fmu, names: &[S]) -> Result<Recorded, StudyError> {
        let missing = |name: &str| self.failed(format!("{} has no variable {name}", fmu.name()));
        let position = |name: &str| fmu.position(name).ok_or_else(|| missing(name));
        let options = loader::Options {
            stop_s: Some(self.stop_s),
            step_s: Some(self.step_s),
            sets: self.sets.clone(),
            record: Some(names.iter().map(|name| position(name.as_ref())).collect::<Result<_, _>>()?),
            apart: self.apart.as_deref().map(position).transpose()?,
            ..loader::Options::default()
        };
        let recording = loader::simulate(fmu, options).map_err(|stopped| self.failed(*stopped))?.recording;
        let column = |name: &S| {
            let column = recording.column(name.as_ref()).map(loader::Column::numbers);
            column.ok_or_else(|| missing(name.as_ref()))
        };
        let columns = names.iter().map(column).collect::<Result<_, _>>()?;
        Ok(Recorded { times_s: recording.times_s, columns })
    }
}

/// Those of `cases` whose label the options name; an error if none.
pub(crate) fn chosen<T>(
    study: &'static str,
    options: &Options,
    cases: impl IntoIterator<Item = T>,
    label: impl Fn(&T) -> String,
) -> Result<Vec<T>, StudyError> {
    let only = options.only.as_deref().unwrap_or_default();
    let (mut chosen, mut known) = (Vec::new(), Vec::new());
    for case in cases {
        known.push(label(&case));
        if known.last().is_some_and(|label| label.contains(only)) {
            chosen.push(case);
        }
    }
    if chosen.is_empty() {
        let known = listed(&known.iter().map(String::as_str).collect::<Vec<_>>());
        return Err(StudyError::NothingLeft { study, only: only.to_owned(), known });
    }
    Ok(chosen)
}

/// Runs every case on all cores behind a progress bar; the order of results is that of the cases.
pub(crate) fn run_all<T: Sync, R: Send>(
    options: &Options,
    cases: &[T],
    run: impl Fn(&T) -> Result<R, StudyError> + Sync,
) -> Result<Vec<R>, StudyError> {
    let bar = terminal::progress(cases.len() as u64, "cases", !options.progress);
    let results = cases
        .par_iter()
        .map(|case| {
            let result = run(case);
            bar.inc(1);
            result
        })
        .collect();
    bar.finish_and_clear();
    results
}

/// Most labels that are listed one by one.
const MOST_LISTED: usize = 12;

/// The labels one below the other; of many the first and the last.
fn listed(labels: &[&str]) -> String {
    if labels.len() <= MOST_LISTED {
        return labels.join("\n  ");
    }
    let ends = [&labels[..2], &["..."], &labels[labels.len() - 1..]].concat();
    format!("{} ({} of them)", ends.join(", "), labels.len())
}

#[cfg(test)]
mod tests {
    //! The error of a filter that leaves nothing lists the cases, in a few lines.
    use super::*;

    #[test]
    fn many_cases_are_not_listed_one_by_one() {
        assert_eq!(listed(&["a", "b"]), "a\n  b");
        let labels: Vec<String> = (1..=120).map(|n| format!("n = {n}")).collect();
        let text = listed(&labels.iter().map(String::as_str).collect::<Vec<_>>());
        assert_eq!(text, "n = 1, n = 2, ..., n = 120 (120 of them)");
    }
}

//! The scaffold of every study: cases chosen by their labels, simulated on all cores, their recorded columns.

use loader::{Fmu, Rows, Value};
use model_description::{BaseType, Description};
use nalgebra::SVector;
use rayon::prelude::*;
use systems::{FirstExchange, Master, System};

use crate::attitude::{Attitude, Vector};
use crate::settings::{Settings, elements, flag, item, number, real};
use crate::{Options, StudyError};

/// One simulation: what is set, how long and how finely.
#[derive(Clone, Debug)]
pub(crate) struct Case {
    /// For messages and tables.
    pub label: String,
    sets: Settings,
    stop_s: f64,
    step_s: f64,
    every_s: Option<f64>,
    apart: Option<String>,
}

/// What is simulated: one FMU, or a system, whose variables are named `component.variable`.
#[derive(Clone, Copy)]
pub(crate) enum Model<'a> {
    Fmu(&'a Fmu),
    System(&'a System),
}

impl<'a> From<&'a Fmu> for Model<'a> {
    fn from(fmu: &'a Fmu) -> Self {
        Self::Fmu(fmu)
    }
}

impl<'a> From<&'a System> for Model<'a> {
    fn from(system: &'a System) -> Self {
        Self::System(system)
    }
}

impl Model<'_> {
    fn description(&self) -> &Description {
        match self {
            Self::Fmu(fmu) => fmu.description(),
            Self::System(system) => system.description(),
        }
    }

    /// Positions of the variables that names of variables and vectors mean, in this order.
    fn positions<S: AsRef<str>>(&self, names: &[S]) -> Result<Vec<usize>, loader::Error> {
        let select = |name: &S| match self {
            Self::Fmu(fmu) => fmu.select(name.as_ref()),
            Self::System(system) => loader::select(system.description(), name.as_ref()),
        };
        Ok(names.iter().map(select).collect::<Result<Vec<_>, _>>()?.concat())
    }
}

/// Recorded columns, in the order of the names, and the recorded points.
#[derive(Clone, Debug, Default)]
pub(crate) struct Recorded {
    /// Recorded points, in s.
    pub times_s: Vec<f64>,
    /// Columns: of a flag 1 or 0, of an option its number.
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

    /// The values of one point from a column on.
    pub fn row(&self, row: usize, column: usize) -> Row<'_> {
        let time_s = self.times_s.get(row).copied().unwrap_or(f64::NAN);
        Row { time_s, row, columns: self.columns[column..].iter() }
    }

    /// The vectors in three columns from one on.
    pub fn vectors(&self, column: usize) -> Vec<Vector> {
        (0..self.times_s.len()).map(|row| self.row(row, column).vector()).collect()
    }

    /// All points.
    pub fn rows(&self) -> impl Iterator<Item = Row<'_>> {
        (0..self.times_s.len()).map(|row| self.row(row, 0))
    }
}

/// The values of one point, one after the other.
pub(crate) struct Row<'a> {
    /// When, in s.
    pub time_s: f64,
    row: usize,
    columns: std::slice::Iter<'a, Vec<f64>>,
}

impl Row<'_> {
    /// The next; not a number beyond the last.
    pub fn real(&mut self) -> f64 {
        self.columns.next().and_then(|column| column.get(self.row)).copied().unwrap_or(f64::NAN)
    }

    /// The next `N`.
    pub fn vector<const N: usize>(&mut self) -> SVector<f64, N> {
        SVector::from_fn(|_, _| self.real())
    }

    /// The next four.
    pub fn attitude(&mut self) -> Attitude {
        Attitude::new_unchecked(self.vector::<4>().into())
    }

    /// Whether the next is true.
    pub fn flag(&mut self) -> bool {
        self.real() != 0.0
    }
}

/// Keeps rows and sets what is answered to each.
struct Steered<'a> {
    recorded: Recorded,
    types: Vec<BaseType>,
    steer: &'a mut dyn FnMut(Row<'_>) -> Settings,
}

impl Rows for Steered<'_> {
    fn take(&mut self, row: &loader::Row<'_>) -> Result<(), loader::Error> {
        let (mut reals, mut integers) = (row.reals.iter(), row.integers.iter());
        let mut booleans = row.booleans.iter();
        self.recorded.times_s.push(row.time_s);
        for (column, base) in self.recorded.columns.iter_mut().zip(&self.types) {
            let value = match base {
                BaseType::Real => reals.next().copied(),
                BaseType::Integer => integers.next().copied().map(f64::from),
                BaseType::Boolean => booleans.next().map(|is| f64::from(u8::from(*is != 0))),
                BaseType::String => None,
            };
            column.push(value.unwrap_or(f64::NAN));
        }
        Ok(())
    }

    fn sets(&mut self) -> Settings {
        (self.steer)(self.recorded.row(self.recorded.times_s.len() - 1, 0))
    }
}

impl Case {
    /// The model as it is packed, for `stop_s` in steps of `step_s`.
    pub fn new(label: impl Into<String>, stop_s: f64, step_s: f64) -> Self {
        Self { label: label.into(), sets: Vec::new(), stop_s, step_s, every_s: None, apart: None }
    }

    /// For `stop_s` in steps of `step_s` instead.
    pub fn grid(mut self, stop_s: f64, step_s: f64) -> Self {
        (self.stop_s, self.step_s) = (stop_s, step_s);
        self
    }

    /// Recorded every `every_s`, a whole number of steps.
    pub fn every(mut self, every_s: f64) -> Self {
        self.every_s = Some(every_s);
        self
    }

    /// With more points between those of the grid, so that the Integer `counter` rises by one from point to point.
    pub fn apart(mut self, counter: &str) -> Self {
        self.apart = Some(counter.to_owned());
        self
    }

    /// Sets what is listed.
    pub fn with(mut self, settings: impl IntoIterator<Item = (String, Value)>) -> Self {
        for (name, value) in settings {
            self.sets.retain(|(known, _)| *known != name);
            self.sets.push((name, value));
        }
        self
    }

    /// Sets a Real.
    pub fn real(self, name: &str, value: f64) -> Self {
        self.with([real(name, value)])
    }

    /// Sets an Integer.
    pub fn integer(self, name: &str, value: i32) -> Self {
        self.with([number(name, value)])
    }

    /// Sets an Enumeration to an item.
    pub fn item(self, name: &str, value: &str) -> Self {
        self.with([item(name, value)])
    }

    /// Sets a Boolean.
    pub fn boolean(self, name: &str, value: bool) -> Self {
        self.with([flag(name, value)])
    }

    /// Sets a vector or quaternion.
    pub fn elements(self, name: &str, values: impl IntoIterator<Item = f64>) -> Self {
        self.with(elements(name, values))
    }

    /// The error of this case.
    pub fn failed(&self, source: impl Into<Box<dyn std::error::Error + Send + Sync>>) -> StudyError {
        StudyError::Simulation { case: self.label.clone(), source: source.into() }
    }

    /// Simulates it and returns the columns of `names`, of variables and vectors.
    pub fn simulate<'m, S: AsRef<str>>(
        &self,
        model: impl Into<Model<'m>>,
        names: &[S],
    ) -> Result<Recorded, StudyError> {
        self.steer(model, names, &mut |_| Settings::new())
    }

    /// As [`Self::simulate`]; what `steer` answers to a recorded point is set there.
    pub fn steer<'m, S: AsRef<str>>(
        &self,
        model: impl Into<Model<'m>>,
        names: &[S],
        steer: &mut dyn FnMut(Row<'_>) -> Settings,
    ) -> Result<Recorded, StudyError> {
        self.run(model.into(), names, steer).map_err(|error| self.failed(error))
    }

    fn run<S: AsRef<str>>(
        &self,
        model: Model<'_>,
        names: &[S],
        steer: &mut dyn FnMut(Row<'_>) -> Settings,
    ) -> Result<Recorded, loader::Error> {
        let positions = model.positions(names)?;
        let variables = &model.description().variables;
        let types: Vec<_> = positions.iter().map(|position| variables[*position].kind.base_type()).collect();
        let columns = vec![Vec::new(); types.len()];
        let mut rows = Steered { recorded: Recorded { columns, ..Recorded::default() }, types, steer };
        let options = loader::Options {
            stop_s: Some(self.stop_s),
            step_s: Some(self.step_s),
            record_every_s: self.every_s,
            sets: self.sets.clone(),
            record: Some(positions),
            apart: model.positions(self.apart.as_slice())?.first().copied(),
            ..loader::Options::default()
        };
        match model {
            Model::Fmu(fmu) => loader::simulate_into(fmu, options, &mut rows)?,
            Model::System(system) => {
                let way = (Master::default(), FirstExchange::Separate);
                systems::simulate_into(system, way, options, &mut rows)?
            }
        };
        Ok(rows.recorded)
    }
}

/// The values of variables and vectors at the start, as nobody sets them.
pub(crate) fn at_start<'m, S: AsRef<str>>(
    model: impl Into<Model<'m>>,
    names: &[S],
) -> Result<Recorded, StudyError> {
    Case::new("start values", 1.0, 1.0).simulate(model, names)
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

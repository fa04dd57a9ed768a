//! One simulation of a study: what is set, how long and how finely, and its recorded columns.

use campaign::{Design, Distribution, Sampling, Varied};
use loader::{Fmu, Rows, Value};
use model_description::{BaseType, Description};
use nalgebra::SVector;
use systems::{FirstExchange, Master, System};

use crate::StudyError;
use crate::attitude::Attitude;
use crate::options::Cause;
use crate::settings::{Setting, Settings};

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
pub(crate) trait Model {
    fn description(&self) -> &Description;
    fn simulate_into(&self, options: loader::Options<'_>, rows: &mut dyn Rows) -> Result<(), loader::Error>;
}

impl Model for Fmu {
    fn description(&self) -> &Description {
        self.description()
    }

    fn simulate_into(&self, options: loader::Options<'_>, rows: &mut dyn Rows) -> Result<(), loader::Error> {
        loader::simulate_into(self, options, rows).map(|_| ())
    }
}

impl Model for System {
    fn description(&self) -> &Description {
        self.description()
    }

    fn simulate_into(&self, options: loader::Options<'_>, rows: &mut dyn Rows) -> Result<(), loader::Error> {
        let way = (Master::default(), FirstExchange::Separate);
        systems::simulate_into(self, way, options, rows).map(|_| ())
    }
}

/// Names of every member of a numbered group.
pub(crate) fn numbered(fmu: &Fmu, group: &str, names: &[&str]) -> Vec<String> {
    let all = (1..).map(|k| names.iter().map(move |name| format!("{group}[{k}].{name}")).collect::<Vec<_>>());
    all.take_while(|member| fmu.position(&member[0]).is_some()).flatten().collect()
}

/// Positions of the variables that names of variables and vectors mean, in this order.
fn positions<S: AsRef<str>>(model: &dyn Model, names: &[S]) -> Result<Vec<usize>, loader::Error> {
    let select = |name: &S| loader::select(model.description(), name.as_ref());
    Ok(names.iter().map(select).collect::<Result<Vec<_>, _>>()?.concat())
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
    pub(crate) fn last(&self, column: usize) -> f64 {
        self.columns[column].last().copied().unwrap_or(f64::NAN)
    }

    /// Greatest value of a column.
    pub(crate) fn most(&self, column: usize) -> f64 {
        self.columns[column].iter().copied().fold(f64::NEG_INFINITY, f64::max)
    }

    /// The values of one point from a column on.
    pub(crate) fn row(&self, row: usize, column: usize) -> Row<'_> {
        let time_s = self.times_s.get(row).copied().unwrap_or(f64::NAN);
        Row { time_s, row, columns: self.columns[column..].iter() }
    }

    /// The values of the first point.
    pub(crate) fn first<T: Recordable>(&self) -> T {
        self.row(0, 0).read()
    }

    /// Those of the last point.
    pub(crate) fn last_row(&self) -> Row<'_> {
        self.row(self.times_s.len().saturating_sub(1), 0)
    }

    /// What stands in the columns from one on.
    pub(crate) fn all<T: Recordable>(&self, column: usize) -> Vec<T> {
        (0..self.times_s.len()).map(|row| self.row(row, column).read()).collect()
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
    /// The next.
    pub(crate) fn read<T: Recordable>(&mut self) -> T {
        T::read(self)
    }
}

/// What stands in one column, or in several beside each other.
pub(crate) trait Recordable {
    /// Takes its columns; not a number beyond the last.
    fn read(row: &mut Row<'_>) -> Self;
}

impl Recordable for f64 {
    fn read(row: &mut Row<'_>) -> Self {
        row.columns.next().and_then(|column| column.get(row.row)).copied().unwrap_or(f64::NAN)
    }
}

impl Recordable for i32 {
    fn read(row: &mut Row<'_>) -> Self {
        row.read::<f64>() as i32
    }
}

impl Recordable for bool {
    fn read(row: &mut Row<'_>) -> Self {
        row.read::<f64>() != 0.0
    }
}

impl<const N: usize> Recordable for SVector<f64, N> {
    fn read(row: &mut Row<'_>) -> Self {
        Self::from_fn(|_, _| row.read())
    }
}

impl<T: Recordable, const N: usize> Recordable for [T; N] {
    fn read(row: &mut Row<'_>) -> Self {
        std::array::from_fn(|_| row.read())
    }
}

/// All that are left.
impl<T: Recordable> Recordable for Vec<T> {
    fn read(row: &mut Row<'_>) -> Self {
        let mut all = Self::new();
        while row.columns.len() > 0 {
            all.push(row.read());
        }
        all
    }
}

impl<A: Recordable, B: Recordable> Recordable for (A, B) {
    fn read(row: &mut Row<'_>) -> Self {
        (row.read(), row.read())
    }
}

impl Recordable for Attitude {
    fn read(row: &mut Row<'_>) -> Self {
        Self::new_unchecked(row.read::<SVector<f64, 4>>().into())
    }
}

/// A struct of what is recorded: each field with its variable, vector or quaternion; `@` is the time.
macro_rules! recorded {
    ($(#[$doc:meta])* $scope:vis struct $name:ident {
        $(@$time:ident,)?
        $($(#[$about:meta])* $field_scope:vis $field:ident: $type:ty = $($variable:literal)+,)+
    }) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug)]
        $scope struct $name {
            $(/// In s.
            pub $time: f64,)?
            $($(#[$about])* $field_scope $field: $type,)+
        }

        impl $name {
            /// What is recorded, in the order of the fields.
            pub(crate) const NAMES: &[&str] = &[$($($variable),+),+];
        }

        impl $crate::case::Recordable for $name {
            fn read(row: &mut $crate::case::Row<'_>) -> Self {
                Self { $($time: row.time_s,)? $($field: row.read(),)+ }
            }
        }
    };
}
pub(crate) use recorded;

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
    pub(crate) fn new(label: impl Into<String>, stop_s: f64, step_s: f64) -> Self {
        Self { label: label.into(), sets: Vec::new(), stop_s, step_s, every_s: None, apart: None }
    }

    /// For `stop_s` in steps of `step_s` instead.
    pub(crate) fn grid(mut self, stop_s: f64, step_s: f64) -> Self {
        (self.stop_s, self.step_s) = (stop_s, step_s);
        self
    }

    /// Recorded every `every_s`, a whole number of steps.
    pub(crate) fn every(mut self, every_s: f64) -> Self {
        self.every_s = Some(every_s);
        self
    }

    /// With more points between those of the grid, so that the Integer `counter` rises by one from point to point.
    pub(crate) fn apart(mut self, counter: &str) -> Self {
        self.apart = Some(counter.to_owned());
        self
    }

    /// Sets what is listed.
    pub(crate) fn with(mut self, settings: impl IntoIterator<Item = (String, Value)>) -> Self {
        for (name, value) in settings {
            self.sets.retain(|(known, _)| *known != name);
            self.sets.push((name, value));
        }
        self
    }

    /// Sets a variable, by its item's name an Enumeration, a vector or a quaternion.
    pub(crate) fn set(self, name: &str, value: impl Setting) -> Self {
        self.with(value.of(name))
    }

    /// The runs of a campaign of it: every combination of these numbers, the last variable changing first.
    pub(crate) fn campaign(&self, model: &dyn Model, varied: &[(&str, &[f64])]) -> Result<Vec<Self>, Cause> {
        let of = |(name, values): &(&str, &[f64])| Varied {
            name: (*name).to_owned(),
            distribution: Distribution::Values(values.to_vec()),
        };
        let design = Design::new(varied.iter().map(of).collect(), (Sampling::Grid, None), &[], 0)?;
        let names: Vec<&str> = varied.iter().map(|(name, _)| *name).collect();
        let positions = positions(model, &names)?;
        let variables = || positions.iter().map(|it| &model.description().variables[*it]);
        let of_run = |run| {
            let sets = variables().zip(design.values(run));
            sets.map(|(it, number)| (it.name.clone(), Value::of_f64(it.kind.base_type(), number)))
        };
        Ok((0..design.runs()).map(|run| self.clone().with(of_run(run))).collect())
    }

    /// What is set, in order.
    pub(crate) fn sets(&self) -> &Settings {
        &self.sets
    }

    /// Simulates it and returns the columns of `names`, of variables and vectors.
    pub(crate) fn simulate<S: AsRef<str>>(
        &self,
        model: &dyn Model,
        names: &[S],
    ) -> Result<Recorded, StudyError> {
        self.steer(model, names, &mut |_| Settings::new())
    }

    /// As [`Self::simulate`]; what `steer` answers to a recorded point is set there.
    pub(crate) fn steer<S: AsRef<str>>(
        &self,
        model: &dyn Model,
        names: &[S],
        steer: &mut dyn FnMut(Row<'_>) -> Settings,
    ) -> Result<Recorded, StudyError> {
        let failed = |error| StudyError::Simulation { case: self.label.clone(), source: Box::new(error) };
        self.run(model, names, steer).map_err(failed)
    }

    fn run<S: AsRef<str>>(
        &self,
        model: &dyn Model,
        names: &[S],
        steer: &mut dyn FnMut(Row<'_>) -> Settings,
    ) -> Result<Recorded, loader::Error> {
        let record = positions(model, names)?;
        let base_type = |position: &usize| model.description().variables[*position].kind.base_type();
        let types: Vec<_> = record.iter().map(base_type).collect();
        let recorded = Recorded { times_s: Vec::new(), columns: vec![Vec::new(); types.len()] };
        let mut rows = Steered { recorded, types, steer };
        let options = loader::Options {
            stop_s: Some(self.stop_s),
            step_s: Some(self.step_s),
            record_every_s: self.every_s,
            sets: self.sets.clone(),
            record: Some(record),
            apart: positions(model, self.apart.as_slice())?.first().copied(),
            ..loader::Options::default()
        };
        model.simulate_into(options, &mut rows)?;
        Ok(rows.recorded)
    }
}

/// The values of variables and vectors at the start, as nobody sets them.
pub(crate) fn at_start<S: AsRef<str>>(model: &dyn Model, names: &[S]) -> Result<Recorded, StudyError> {
    Case::new("start values", 1.0, 1.0).simulate(model, names)
}

//! A mission's names and values in the FMU that simulates it.

use std::collections::BTreeSet;

use files::outcome::Refusal;
use fmi::{InputTable, Value};
use model_description::{Causality, Description, ScalarVariable, VariableKind, value};
use physics::toml::MOST_PROBLEMS;

use super::{file::Mission, inputs::Inputs, keys::Bounds};
use crate::{
    epoch::{self, Dates},
    reading::At,
};

/// Bounds of one variable.
#[derive(Clone, Debug, PartialEq)]
pub struct Limit {
    /// The variable.
    pub name: String,
    /// The smallest value that is kept, in the variable's unit.
    pub min: Option<f64>,
    /// The largest.
    pub max: Option<f64>,
    /// Place in the file.
    pub at: String,
}

/// Mission resolved for an FMU.
#[derive(Debug, Default)]
pub struct Resolved {
    /// Values set before the run.
    pub sets: Vec<(String, Value)>,
    /// Inputs over time, if the file has them itself.
    pub inputs: Option<InputTable>,
    /// Positions of what `record` names; `None`: every output.
    pub record: Option<Vec<usize>>,
    /// Positions of what each plot names; `None`: everything recorded.
    pub plots: Vec<Option<Vec<usize>>>,
    /// Bounds.
    pub limits: Vec<Limit>,
}

impl Mission {
    /// Finds every name and reads every value. `later` is set after it, as for `--set`, and `start_s` where the run starts.
    ///
    /// # Errors
    /// Everything that the FMU does not have or take, a line for each problem.
    pub fn resolve(
        &self,
        described: &Description,
        later: &[String],
        start_s: Option<f64>,
    ) -> Result<Resolved, Refusal> {
        let settings = self.settings(described);
        let together = settings.iter().map(|(_, setting)| setting).chain(later).map(String::as_str);
        let dates = Dates::new(described, together, start_s.or(self.start_s()));
        let mut resolver = Resolver { mission: self, described, dates: &dates, problems: Vec::new() };
        let resolved = Resolved {
            sets: resolver.sets(),
            inputs: resolver.inputs(),
            record: self.record.as_ref().map(|names| resolver.names(names)),
            plots: self.plots.iter().map(|plot| Some(resolver.names(plot.names.as_ref()?))).collect(),
            limits: self.limits.iter().flat_map(|limit| resolver.limit(limit)).collect(),
        };
        resolver.problems.sort_by_key(|(line, _)| *line);
        let problems: Vec<String> = resolver.problems.into_iter().map(|(_, problem)| problem).collect();
        Refusal::of_all(&problems).map_or(Ok(resolved), Err)
    }

    /// Its values as `--set` would take them, the date of its start among them, each with the place that it stands in.
    pub fn settings(&self, described: &Description) -> Vec<(String, String)> {
        let epochs = self.epoch_s().into_iter().flat_map(|at| {
            let starts = epoch::starts(described);
            starts.map(move |it| (at.place(&self.file), format!("{}={}", it.name, at.it)))
        });
        let sets = self.sets.iter().map(|at| (at.place(&self.file), format!("{}={}", at.it.0, at.it.1)));
        epochs.chain(sets).collect()
    }
}

/// Message of an error at a key of a file.
pub fn in_file(key: &str, error: fmi::Error) -> String {
    match error {
        // The key names the variable.
        fmi::Error::Value { what, variable } if key.contains(&variable) => what,
        fmi::Error::Inputs(what) => what,
        fmi::Error::UnknownVariable { name, hint, .. } => {
            format!("found the unknown variable {name:?}, allowed: one that the FMU has{hint}")
        }
        fmi::Error::NoOutput { pattern, example, .. } => {
            format!(
                "found {pattern:?}, which no output fits, allowed: * for outputs, anything else by its name: {example}"
            )
        }
        other => other.to_string(),
    }
}

struct Resolver<'m, 's> {
    mission: &'m Mission,
    described: &'m Description,
    dates: &'s Dates<'s>,
    problems: Vec<(usize, String)>,
}

impl<'m> Resolver<'m, '_> {
    fn report<T>(&mut self, at: &At<T>, what: &str) {
        self.problems.push((at.line, at.problem(&self.mission.file, what)));
    }

    fn refuse<T>(&mut self, at: &At<T>, error: fmi::Error) {
        self.report(at, &in_file(&at.key, error));
    }

    fn sets(&mut self) -> Vec<(String, Value)> {
        let mut sets = Vec::new();
        let epoch_s = self.mission.epoch_s();
        if let Some(at) = &epoch_s {
            sets.extend(epoch::starts(self.described).map(|it| (it.name.clone(), Value::Real(at.it))));
            if sets.is_empty() {
                let found = "found a date, but the FMU has no epoch of the start";
                self.report(at, &format!("{found}, allowed: simulation time, 0 or \"10 d\""));
            }
        }
        for (index, at) in self.mission.sets.iter().enumerate() {
            if self.problems.len() >= MOST_PROBLEMS {
                let left = self.mission.sets.len() - index;
                self.report(at, &format!("found {left} more values, not checked yet"));
                break;
            }
            let (name, written) = &at.it;
            for (variable, value) in self.assigned(at, name, written) {
                if epoch_s.is_some() && epoch::starts(self.described).any(|it| it.name == variable.name) {
                    let found = format!("found {} beside a date in `start`", variable.name);
                    self.report(at, &format!("{found}, allowed: one of them"));
                    continue;
                }
                if fmi::set_early(variable).is_err() {
                    let found = format!("the {} {}", variable.causality, variable.name);
                    self.report(at, &format!("found {found}, allowed: a parameter or an input"));
                    continue;
                }
                match value::check(self.described, variable, &value) {
                    Ok(()) => sets.push((variable.name.clone(), value)),
                    Err(misfit) => self.report(at, &misfit.to_string()),
                }
            }
        }
        sets
    }

    fn assigned<T>(&mut self, at: &At<T>, name: &str, written: &str) -> Vec<(&'m ScalarVariable, Value)> {
        let setting = format!("{name}={written}");
        let read = self
            .dates
            .in_seconds(&setting)
            .and_then(|setting| fmi::parse_assignment(self.described, &setting));
        let values = read.map_err(|error| self.refuse(at, error)).unwrap_or_default().into_iter();
        let variable = |name: &str| self.described.variables.iter().find(|variable| variable.name == name);
        values.filter_map(|(name, value)| Some((variable(&name)?, value))).collect()
    }

    fn inputs(&mut self) -> Option<InputTable> {
        let Some(Inputs::Columns(inputs)) = &self.mission.inputs else { return None };
        let zero_epoch_s = self.mission.epoch_s().map(|at| at.it);
        let mut table = InputTable::default();
        for at in inputs {
            let (name, column) = &at.it;
            let mut columns: Vec<(&str, Vec<(f64, Value)>)> = Vec::new();
            for (time_s, values) in column.rows(zero_epoch_s) {
                let row = self.assigned(at, name, &values);
                if row.is_empty() {
                    columns.clear();
                    break;
                }
                for (k, (variable, value)) in row.into_iter().enumerate() {
                    if columns.len() <= k {
                        columns.push((&variable.name, Vec::new()));
                    }
                    columns[k].1.push((time_s, value));
                }
            }
            for (name, rows) in columns {
                if let Err(error) = table.add(self.described, name, rows) {
                    self.refuse(at, error);
                }
            }
        }
        Some(table)
    }

    fn names(&mut self, names: &[At<String>]) -> Vec<usize> {
        let mut positions = Vec::new();
        for at in names {
            match fmi::select_outputs(self.described, &at.it) {
                Ok(found) => positions.extend(found),
                Err(error) => self.refuse(at, error),
            }
        }
        let mut seen = BTreeSet::new();
        positions.retain(|position| seen.insert(*position));
        positions
    }

    fn limit(&mut self, at: &At<(String, Bounds)>) -> Vec<Limit> {
        let (name, Bounds { min, max }) = &at.it;
        let found = fmi::select(self.described, name);
        let positions = found.map_err(|error| self.refuse(at, error)).unwrap_or_default();
        let mut limits = Vec::new();
        for variable in positions.into_iter().map(|position| &self.described.variables[position]) {
            let name = &variable.name;
            if !matches!(variable.kind, VariableKind::Real { .. } | VariableKind::Integer { .. }) {
                self.report(at, &format!("found {name}, which is no number, allowed: a Real or an Integer"));
                continue;
            }
            if variable.causality == Causality::Parameter {
                self.report(at, &format!("found the parameter {name}, allowed: what changes during a run"));
                continue;
            }
            let mut bound = |written: &Option<String>| {
                let read = fmi::parse_value(self.described, variable, written.as_ref()?);
                read.map_err(|error| self.refuse(at, error)).ok().map(|value| value.to_f64())
            };
            let (min, max) = (bound(min), bound(max));
            if let (Some(low), Some(high)) = (min, max)
                && low > high
            {
                let [low, high] = [&at.it.1.min, &at.it.1.max].map(|it| it.as_deref().unwrap_or_default());
                self.report(at, &format!("found min {low} above max {high}, allowed: a min up to max"));
            }
            limits.push(Limit { name: name.clone(), min, max, at: at.place(&self.mission.file) });
        }
        limits
    }
}

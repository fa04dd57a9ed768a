//! Inputs over time: a table of rows, interpolated where the variable is continuous.

use std::sync::Arc;

use model_description::{Causality, Description, ScalarVariable, Variability, VariableKind};

use crate::{Error, Value, parse_value, select};

/// Values of inputs (and tunable parameters) over time.
///
/// Between rows a continuous Real is interpolated linearly, anything else keeps the last row's value; before
/// the first row and after the last the nearest row holds. Two rows at one time make a jump: the later one
/// holds from there on.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct InputTable {
    columns: Vec<InputColumn>,
}

#[derive(Clone, Debug, PartialEq)]
struct InputColumn {
    position: usize,
    linear: bool,
    /// Shared by the columns of one file.
    times_s: Arc<[f64]>,
    values: Vec<Value>,
}

impl InputTable {
    /// Builds a table from texts, as read from a file: `header` starts with `time`, every row has its length.
    pub fn parse<S: AsRef<str>>(
        description: &Description,
        header: &[S],
        rows: &[Vec<S>],
    ) -> Result<Self, Error> {
        let wrong = |what: String| Error::Inputs(what);
        let Some((time, names)) = header.split_first() else {
            return Err(wrong("it is empty; the first line names its columns: time,<input>,...".to_owned()));
        };
        if time.as_ref().trim() != "time" {
            return Err(wrong(format!("the first column is {:?} and must be time, in s", time.as_ref())));
        }
        let variables = names.iter().map(|name| settable(description, name.as_ref().trim()));
        let variables: Vec<(usize, &ScalarVariable)> = variables.collect::<Result<_, _>>()?;
        for (index, (position, variable)) in variables.iter().enumerate() {
            if variables[..index].iter().any(|(earlier, _)| earlier == position) {
                return Err(wrong(format!("column {} stands twice", variable.name)));
            }
        }
        let mut times_s: Vec<f64> = Vec::with_capacity(rows.len());
        let mut values = vec![Vec::with_capacity(rows.len()); variables.len()];
        for (index, row) in rows.iter().enumerate() {
            let line = index + 2;
            if row.len() != header.len() {
                return Err(wrong(format!(
                    "line {line} has {} cells, the header has {}",
                    row.len(),
                    header.len()
                )));
            }
            let text = row[0].as_ref().trim();
            let time_s = text
                .parse::<f64>()
                .ok()
                .filter(|time_s| time_s.is_finite())
                .ok_or_else(|| wrong(format!("line {line}: time {text:?} is no number")))?;
            if times_s.last().is_some_and(|last| *last > time_s) {
                return Err(wrong(format!("line {line}: time {time_s} is before the line above")));
            }
            times_s.push(time_s);
            for ((column, (_, variable)), cell) in values.iter_mut().zip(&variables).zip(&row[1..]) {
                let value = parse_value(description, variable, cell.as_ref())
                    .map_err(|error| wrong(format!("line {line}: {error}")))?;
                column.push(value);
            }
        }
        if times_s.is_empty() {
            return Err(wrong("it has a header but no rows".to_owned()));
        }
        let times_s: Arc<[f64]> = times_s.into();
        let columns = variables.iter().zip(values).map(|(&(position, variable), values)| InputColumn {
            position,
            linear: is_linear(variable),
            times_s: Arc::clone(&times_s),
            values,
        });
        Ok(Self { columns: columns.collect() })
    }

    /// Adds a variable with rows of its own: a time in s, that does not fall, and a value.
    ///
    /// # Errors
    /// No rows, times that fall, a variable that cannot change during a run or has rows already.
    pub fn add(
        &mut self,
        description: &Description,
        name: &str,
        rows: Vec<(f64, Value)>,
    ) -> Result<(), Error> {
        let (position, variable) = settable(description, name)?;
        if self.positions().any(|other| other == position) {
            return Err(Error::Inputs(format!("{name} stands twice")));
        }
        let (times_s, values): (Vec<f64>, Vec<Value>) = rows.into_iter().unzip();
        if times_s.is_empty() || times_s.windows(2).any(|pair| pair[1] < pair[0]) {
            return Err(Error::Inputs(format!("{name} has no rows, or rows whose times fall")));
        }
        let linear = is_linear(variable);
        self.columns.push(InputColumn { position, linear, times_s: times_s.into(), values });
        Ok(())
    }

    /// Positions in `ModelVariables` of the columns.
    pub fn positions(&self) -> impl Iterator<Item = usize> {
        self.columns.iter().map(|column| column.position)
    }

    /// The value of a column at a time.
    pub fn value(&self, column: usize, time_s: f64) -> Value {
        let column = &self.columns[column];
        // The first row later than the time.
        let after = column.times_s.partition_point(|row_s| *row_s <= time_s);
        let before = after.saturating_sub(1);
        let held = &column.values[before];
        match (held, column.values.get(after)) {
            (Value::Real(left), Some(Value::Real(right))) if column.linear && after > 0 => {
                let (left_s, right_s) = (column.times_s[before], column.times_s[after]);
                Value::Real(left + (right - left) * ((time_s - left_s) / (right_s - left_s)))
            }
            _ => held.clone(),
        }
    }

    /// Time derivative, just after a time, of a column that is interpolated; `None` for one that is held.
    pub fn slope(&self, column: usize, time_s: f64) -> Option<f64> {
        let column = &self.columns[column];
        if !column.linear {
            return None;
        }
        let after = column.times_s.partition_point(|row_s| *row_s <= time_s);
        let Some(before) = after.checked_sub(1) else { return Some(0.0) };
        match (&column.values[before], column.values.get(after)) {
            (Value::Real(left), Some(Value::Real(right))) => {
                Some((right - left) / (column.times_s[after] - column.times_s[before]))
            }
            _ => Some(0.0),
        }
    }
}

fn is_linear(variable: &ScalarVariable) -> bool {
    matches!(variable.kind, VariableKind::Real { .. })
        && variable.causality == Causality::Input
        && variable.variability == Variability::Continuous
}

/// Position and variable of a name, one that can change during a run.
fn settable<'a>(description: &'a Description, name: &str) -> Result<(usize, &'a ScalarVariable), Error> {
    let position = select::named(description, name).ok_or_else(|| select::unknown(description, name))?;
    let variable = &description.variables[position];
    let tunable = variable.causality == Causality::Parameter && variable.variability == Variability::Tunable;
    if variable.causality == Causality::Input || tunable {
        return Ok((position, variable));
    }
    let what = "cannot change during a run: only inputs and tunable parameters can";
    Err(Error::Inputs(format!("{} {what}", variable.name)))
}

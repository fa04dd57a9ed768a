//! A recorded simulation: time and one typed column per recorded variable.

use std::collections::BTreeSet;

use crate::Value;

/// Values of one variable at every recorded time.
#[derive(Clone, Debug, PartialEq)]
pub enum Column {
    /// Reals, in the variable's unit.
    Real(Vec<f64>),
    /// Integers and Enumerations.
    Integer(Vec<i32>),
    /// Booleans.
    Boolean(Vec<bool>),
    /// Strings.
    Text(Vec<String>),
}

impl Column {
    /// The value of a row; `None` beyond the last.
    pub fn value(&self, row: usize) -> Option<Value> {
        match self {
            Self::Real(values) => values.get(row).copied().map(Value::Real),
            Self::Integer(values) => values.get(row).copied().map(Value::Integer),
            Self::Boolean(values) => values.get(row).copied().map(Value::Boolean),
            Self::Text(values) => values.get(row).cloned().map(Value::Text),
        }
    }

    /// The value of a row as a number: Booleans are 0 and 1, texts NaN.
    pub fn number(&self, row: usize) -> f64 {
        self.value(row).map_or(f64::NAN, |value| value.to_f64())
    }

    /// All values as numbers.
    pub fn numbers(&self) -> Vec<f64> {
        match self {
            Self::Real(values) => values.clone(),
            Self::Integer(values) => values.iter().copied().map(f64::from).collect(),
            Self::Boolean(values) => values.iter().map(|value| f64::from(u8::from(*value))).collect(),
            Self::Text(values) => vec![f64::NAN; values.len()],
        }
    }
}

/// A recorded simulation.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Recording {
    /// Times in s.
    pub times_s: Vec<f64>,
    /// Names of the columns.
    pub names: Vec<String>,
    /// Units of the columns; empty where a variable has none.
    pub units: Vec<String>,
    /// The values, one column per name, each as long as `times_s`.
    pub columns: Vec<Column>,
}

impl Recording {
    /// The columns of these names, at the same times.
    pub fn only(&self, names: &[String]) -> Self {
        let names: BTreeSet<&String> = names.iter().collect();
        let kept = (0..self.names.len()).filter(|&index| names.contains(&self.names[index]));
        let mut only = Self { times_s: self.times_s.clone(), ..Self::default() };
        for index in kept {
            only.names.push(self.names[index].clone());
            only.units.push(self.units[index].clone());
            only.columns.push(self.columns[index].clone());
        }
        only
    }

    /// The first columns, at the same times.
    pub fn leading(&self, columns: usize) -> Self {
        Self {
            times_s: self.times_s.clone(),
            names: self.names.iter().take(columns).cloned().collect(),
            units: self.units.iter().take(columns).cloned().collect(),
            columns: self.columns.iter().take(columns).cloned().collect(),
        }
    }

    /// The column of a variable.
    pub fn column(&self, name: &str) -> Option<&Column> {
        self.names.iter().position(|candidate| candidate == name).map(|index| &self.columns[index])
    }

    /// The values of a Real.
    pub fn reals(&self, name: &str) -> Option<&[f64]> {
        match self.column(name)? {
            Column::Real(values) => Some(values),
            _ => None,
        }
    }
}

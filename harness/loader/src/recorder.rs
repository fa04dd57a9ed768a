//! Takes the rows of a recording from an instance, and bounds how many there may be.

use model_description::VariableKind;

use crate::{Column, Error, Fmu, Instance, Recording, values};

/// Most that a recording may take, in bytes: about ten million points of a dozen Reals.
const MAX_BYTES: u64 = 1_000_000_000;
/// A row's time.
const TIME_BYTES: u64 = 8;

/// What one more row adds to a column; a short text counts with its bookkeeping.
fn column_bytes(column: &Column) -> u64 {
    match column {
        Column::Real(_) => 8,
        Column::Integer(_) => 4,
        Column::Boolean(_) => 1,
        Column::Text(_) => 64,
    }
}

/// Reads the recorded variables, one call per base type.
pub(crate) struct Recorder {
    pub(crate) recording: Recording,
    groups: [Group; 4],
    reals: Vec<f64>,
    integers: Vec<i32>,
    booleans: Vec<i32>,
}

/// The recorded variables of one base type: their columns and value references.
#[derive(Default)]
struct Group {
    columns: Vec<usize>,
    references: Vec<u32>,
}

impl Recorder {
    pub(crate) fn new(fmu: &Fmu, positions: &[usize]) -> Self {
        let mut recording = Recording::default();
        let mut groups: [Group; 4] = Default::default();
        for &position in positions {
            let variable = &fmu.description().variables[position];
            let (group, column) = match variable.kind {
                VariableKind::Real { .. } => (0, Column::Real(Vec::new())),
                VariableKind::Integer { .. } | VariableKind::Enumeration { .. } => {
                    (1, Column::Integer(Vec::new()))
                }
                VariableKind::Boolean { .. } => (2, Column::Boolean(Vec::new())),
                VariableKind::String { .. } => (3, Column::Text(Vec::new())),
            };
            groups[group].columns.push(recording.columns.len());
            groups[group].references.push(variable.value_reference);
            recording.names.push(variable.name.clone());
            recording.units.push(values::unit(fmu.description(), variable).unwrap_or_default().to_owned());
            recording.columns.push(column);
        }
        let reals = vec![0.0; groups[0].columns.len()];
        let integers = vec![0; groups[1].columns.len()];
        let booleans = vec![0; groups[2].columns.len()];
        Self { recording, groups, reals, integers, booleans }
    }

    /// Refuses more points than memory is given for, before anything is flown.
    pub(crate) fn fits(&self, points: u64) -> Result<(), Error> {
        let row: u64 = self.recording.columns.iter().map(column_bytes).sum::<u64>() + TIME_BYTES;
        if points <= MAX_BYTES / row {
            return Ok(());
        }
        Err(Error::TooMuch { points, columns: self.recording.columns.len(), allowed: MAX_BYTES / row })
    }

    /// Appends a row; an error leaves none.
    pub(crate) fn record(&mut self, instance: &mut Instance, time_s: f64) -> Result<(), Error> {
        let [reals, integers, booleans, strings] = &self.groups;
        if !reals.columns.is_empty() {
            instance.get_reals(&reals.references, &mut self.reals)?;
        }
        let texts = if strings.columns.is_empty() {
            Vec::new()
        } else {
            instance.get_strings(&strings.references)?
        };
        if !integers.columns.is_empty() {
            instance.get_integers(&integers.references, &mut self.integers)?;
        }
        if !booleans.columns.is_empty() {
            instance.get_booleans(&booleans.references, &mut self.booleans)?;
        }
        self.recording.times_s.push(time_s);
        let columns = &mut self.recording.columns;
        for (&column, &value) in reals.columns.iter().zip(&self.reals) {
            if let Column::Real(values) = &mut columns[column] {
                values.push(value);
            }
        }
        for (&column, &value) in integers.columns.iter().zip(&self.integers) {
            if let Column::Integer(values) = &mut columns[column] {
                values.push(value);
            }
        }
        for (&column, &value) in booleans.columns.iter().zip(&self.booleans) {
            if let Column::Boolean(values) = &mut columns[column] {
                values.push(value != 0);
            }
        }
        for (&column, value) in strings.columns.iter().zip(texts) {
            if let Column::Text(values) = &mut columns[column] {
                values.push(value);
            }
        }
        Ok(())
    }
}

//! Takes the rows of a recording from an instance, and bounds how many there may be.

use std::borrow::Cow;

use model_description::{BaseType, Description, value::unit};
use serde::{Deserialize, Serialize};

use crate::{Column, Error, Fmu, Instance, Recording};

/// Most that a recording may take, in bytes: about ten million points of a dozen Reals.
const MAX_BYTES: u64 = 1_000_000_000;
/// A row's time.
const TIME_BYTES: u64 = 8;
/// Memory of a short text with its bookkeeping, in bytes.
const TEXT_BYTES: u64 = 64;

/// Memory of one more row of a column, in bytes.
fn column_bytes(column: &Column) -> u64 {
    match column {
        Column::Real(_) => 8,
        Column::Integer(_) => 4,
        Column::Boolean(_) => 1,
        Column::Text(_) => TEXT_BYTES,
    }
}

/// One row of a recording: its time, and the recorded variables of each base type in their order.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Row<'a> {
    /// Time in s.
    pub time_s: f64,
    /// Reals, in their units.
    #[serde(with = "reals")]
    pub reals: Cow<'a, [f64]>,
    /// Integers and Enumerations.
    pub integers: Cow<'a, [i32]>,
    /// Booleans; 0 is false.
    pub booleans: Cow<'a, [i32]>,
    /// Strings.
    pub texts: Cow<'a, [String]>,
}

/// Reals in a frame: their bytes, which are copied at once.
mod reals {
    use std::borrow::Cow;

    use serde::{Deserialize, Deserializer, Serializer, de::Error};

    #[expect(clippy::ptr_arg, reason = "serde hands over the field")]
    pub(super) fn serialize<S: Serializer>(reals: &Cow<'_, [f64]>, to: S) -> Result<S::Ok, S::Error> {
        let mut bytes = vec![0; size_of_val(&**reals)];
        let (places, _) = bytes.as_chunks_mut();
        places.iter_mut().zip(&**reals).for_each(|(place, real)| *place = real.to_le_bytes());
        to.serialize_bytes(&bytes)
    }

    pub(super) fn deserialize<'de, 'a, D: Deserializer<'de>>(from: D) -> Result<Cow<'a, [f64]>, D::Error> {
        match <&[u8]>::deserialize(from)?.as_chunks() {
            (reals, []) => Ok(reals.iter().map(|bytes| f64::from_le_bytes(*bytes)).collect()),
            (_, rest) => Err(Error::invalid_length(rest.len(), &"whole Reals")),
        }
    }
}

impl Row<'_> {
    /// Number of values of each base type: Reals, Integers, Booleans, Strings.
    pub fn widths(&self) -> [usize; 4] {
        [self.reals.len(), self.integers.len(), self.booleans.len(), self.texts.len()]
    }
}

/// Recipient of rows as they are recorded.
pub trait Rows {
    /// Takes one more row.
    fn take(&mut self, row: &Row<'_>) -> Result<(), Error>;
}

/// The recorded variables of one base type: their columns and value references.
#[derive(Default)]
struct Group {
    columns: Vec<usize>,
    references: Vec<u32>,
}

/// The recorded variables by base type: Reals, Integers, Booleans, Strings.
fn groups(description: &Description, positions: &[usize]) -> [Group; 4] {
    let mut groups: [Group; 4] = Default::default();
    for (column, &position) in positions.iter().enumerate() {
        let variable = &description.variables[position];
        let group = &mut groups[variable.kind.base_type() as usize];
        group.columns.push(column);
        group.references.push(variable.value_reference);
    }
    groups
}

/// Makes a [`Recording`] of rows.
pub struct Collector {
    recording: Recording,
    columns: [Vec<usize>; 4],
    text_bytes: u64,
}

impl Collector {
    /// For the variables at these positions in `ModelVariables`.
    pub fn new(description: &Description, positions: &[usize]) -> Self {
        let mut recording = Recording::default();
        for &position in positions {
            let variable = &description.variables[position];
            recording.names.push(variable.name.clone());
            recording.units.push(unit(description, variable).unwrap_or_default().to_owned());
            recording.columns.push(match variable.kind.base_type() {
                BaseType::Real => Column::Real(Vec::new()),
                BaseType::Integer => Column::Integer(Vec::new()),
                BaseType::Boolean => Column::Boolean(Vec::new()),
                BaseType::String => Column::Text(Vec::new()),
            });
        }
        Self { recording, columns: groups(description, positions).map(|group| group.columns), text_bytes: 0 }
    }

    /// Refuses more points than memory is given for, before anything is simulated.
    pub fn fits(&self, points: u64) -> Result<(), Error> {
        let row: u64 = self.recording.columns.iter().map(column_bytes).sum::<u64>() + TIME_BYTES;
        if points <= MAX_BYTES / row {
            return Ok(());
        }
        Err(Error::Rows(format!(
            "the run would record {points} points of {} variables, allowed are {} points of them: record less often \
             (--every), fewer variables (--record) or take longer steps (--step)",
            self.recording.columns.len(),
            MAX_BYTES / row
        )))
    }

    /// How many values of each base type a row has: Reals, Integers, Booleans, Strings.
    pub fn widths(&self) -> [usize; 4] {
        self.columns.each_ref().map(Vec::len)
    }

    /// The recording so far.
    pub fn recording(&self) -> &Recording {
        &self.recording
    }

    /// The recording.
    pub fn into_recording(self) -> Recording {
        self.recording
    }
}

impl Rows for Collector {
    fn take(&mut self, row: &Row<'_>) -> Result<(), Error> {
        self.text_bytes += row.texts.iter().map(|text| text.len() as u64 + TEXT_BYTES).sum::<u64>();
        if self.text_bytes > MAX_BYTES {
            return Err(Error::Rows(format!(
                "the texts recorded take more than {MAX_BYTES} bytes: record less often (--every) or fewer (--record)"
            )));
        }
        self.recording.times_s.push(row.time_s);
        let columns = &mut self.recording.columns;
        let [reals, integers, booleans, texts] = &self.columns;
        macro_rules! push {
            ($kind:ident, $places:ident, $values:expr) => {
                for (&column, value) in $places.iter().zip($values) {
                    if let Column::$kind(values) = &mut columns[column] {
                        values.push(value);
                    }
                }
            };
        }
        push!(Real, reals, row.reals.iter().copied());
        push!(Integer, integers, row.integers.iter().copied());
        push!(Boolean, booleans, row.booleans.iter().map(|value| *value != 0));
        push!(Text, texts, row.texts.iter().cloned());
        Ok(())
    }
}

/// Reads the recorded variables, one call per base type.
pub(crate) struct Reader {
    groups: [Group; 4],
    reals: Vec<f64>,
    integers: Vec<i32>,
    booleans: Vec<i32>,
}

impl Reader {
    pub(crate) fn new(fmu: &Fmu, positions: &[usize]) -> Self {
        let groups = groups(fmu.description(), positions);
        let [reals, integers, booleans, _] = groups.each_ref().map(|group| group.columns.len());
        Self { groups, reals: vec![0.0; reals], integers: vec![0; integers], booleans: vec![0; booleans] }
    }

    /// Hands one row on; an error hands on none. A Real that is NaN is one.
    pub(crate) fn read(
        &mut self,
        instance: &mut Instance,
        time_s: f64,
        rows: &mut dyn Rows,
    ) -> Result<(), Error> {
        let [reals, integers, booleans, strings] = &self.groups;
        if !reals.columns.is_empty() {
            instance.get_reals(&reals.references, &mut self.reals)?;
            if let Some(at) = self.reals.iter().position(|value| value.is_nan()) {
                return Err(instance.not_a_number(reals.references[at], time_s));
            }
        }
        let mut texts = Vec::new();
        if !strings.columns.is_empty() {
            texts = instance.get_strings(&strings.references)?;
        }
        if !integers.columns.is_empty() {
            instance.get_integers(&integers.references, &mut self.integers)?;
        }
        if !booleans.columns.is_empty() {
            instance.get_booleans(&booleans.references, &mut self.booleans)?;
        }
        let (reals, texts) = (Cow::from(&self.reals), Cow::from(&texts));
        let [integers, booleans] = [&self.integers, &self.booleans].map(Cow::from);
        rows.take(&Row { time_s, reals, integers, booleans, texts })
    }
}

//! Inputs of a mission over time: a CSV file, or columns by name.

use core::fmt::Display;
use std::path::{Path, PathBuf};

use physics::toml::Place;
use serde::Deserialize;

use crate::{
    reading::{
        At, Checked, InputFile, Named, Written,
        quantities::{ALLOWED_TIME, Moment, Setting},
    },
    values::Instant,
};

/// Inputs over time, as they are written.
#[derive(Clone, Debug, Deserialize)]
#[serde(untagged)]
pub(crate) enum InputsKey {
    /// A CSV file.
    File(InputFile),
    /// Columns by name.
    Columns(Named<Column>),
    /// Anything else.
    Other(Written),
}

/// Inputs over time.
#[derive(Clone, Debug)]
pub enum Inputs {
    /// A CSV file.
    File(PathBuf),
    /// Columns by name.
    Columns(Vec<At<(String, Column)>>),
}

/// An input over time: a value that stays, or rows of a time and a value.
#[derive(Clone, Debug, Deserialize)]
#[serde(transparent)]
pub struct Column(Written);

impl Checked for Column {}

impl Checked for InputsKey {
    fn check(&mut self, at: &Place<'_>, folder: &Path) {
        match self {
            Self::File(file) => file.check(at, folder),
            Self::Columns(columns) => columns.check(at, folder),
            Self::Other(other) => at.report(other, "a CSV file, or a table of inputs by name"),
        }
    }
}

impl physics::toml::Written for Column {
    type Value = Self;

    fn value(&self) -> Self {
        self.clone()
    }
}

impl physics::toml::Written for InputsKey {
    type Value = Inputs;

    fn value(&self) -> Inputs {
        match self {
            Self::File(file) => Inputs::File(file.value()),
            Self::Columns(columns) => Inputs::Columns(columns.value()),
            Self::Other(_) => Inputs::Columns(Vec::new()),
        }
    }
}

impl Column {
    /// Times in s, where time 0 has this epoch, and values as `--set` takes them.
    pub(super) fn rows(&self, zero_epoch_s: Option<f64>) -> Vec<(f64, String)> {
        self.read(zero_epoch_s, None)
    }

    /// The same; what is wrong is reported where there is a place.
    pub(super) fn read(&self, zero_epoch_s: Option<f64>, at: Option<&Place<'_>>) -> Vec<(f64, String)> {
        let report = |items: &[usize], found: &dyn Display, allowed: &str| {
            let place = at.map(|at| items.iter().fold(at.clone(), |at, item| at.item(*item)));
            place.into_iter().for_each(|place| place.report(found, allowed));
        };
        let list = match &self.0 {
            Written::List(list) if list.iter().any(|row| matches!(row, Written::List(_))) => list,
            constant => {
                let value = constant.setting();
                if value.is_none() {
                    report(&[], constant, &Setting::allowed());
                }
                return vec![(0.0, value.unwrap_or_default())];
            }
        };
        let mut rows: Vec<(f64, String)> = Vec::new();
        for (i, row) in list.iter().enumerate() {
            let parts = if let Written::List(parts) = row { &parts[..] } else { &[] };
            let [time, values @ ..] = parts else {
                report(&[i], row, "a list of a time and a value: [\"10 min\", 0.5]");
                continue;
            };
            let mut moment = Moment(time.clone());
            if let Some(at) = at.map(|at| at.item(i).item(0)) {
                moment.check(&at, Path::new(""));
                check_time(&moment, &at, zero_epoch_s);
            }
            let Some(time_s) = moment.read().and_then(|instant| instant.time_s(zero_epoch_s)) else {
                continue;
            };
            if rows.last().is_some_and(|(before_s, _)| time_s < *before_s) {
                report(&[i, 0], &format_args!("{time}, before the row above"), "a time that does not fall");
            }
            match Written::List(values.to_vec()).setting() {
                Some(value) => rows.push((time_s, value)),
                None => report(&[i], &"a table", &Setting::allowed()),
            }
        }
        rows
    }
}

/// Reports a date where the mission does not start at one.
pub(super) fn check_time(written: &Moment, at: &Place<'_>, zero_epoch_s: Option<f64>) {
    let start = at.of_file("start");
    if let (Some(Instant::Epoch(_)), None) = (written.read(), zero_epoch_s)
        && !start.has_stand_in()
        && !start.has_reported()
    {
        let allowed = format_args!("simulation time, {ALLOWED_TIME}; or a date, where `start` is one");
        at.report(format_args!("the date {written}"), allowed);
    }
}

impl schemars::JsonSchema for InputsKey {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "Inputs".into()
    }

    fn json_schema(_: &mut schemars::SchemaGenerator) -> schemars::Schema {
        schemars::json_schema!({
            "description": "A CSV file, or inputs by name.",
            "type": ["string", "object"],
            "additionalProperties": {
                "description": "A value that stays, or rows of a time and a value: [[0, \"65 deg\"], [\"5 d\", \"60 deg\"]].",
                "type": ["number", "string", "boolean", "array"]
            }
        })
    }
}

//! Start values of a setup file, from the file's own words to the exporter's.

use fmi_export::{SetupValue, StartValue};
use physics::spacecraft::{StartEntry, StartValue as FileValue};

/// The entries of a file's `[start]` as start values of variables.
pub fn start_values(entries: &[StartEntry]) -> Vec<StartValue> {
    let convert = |entry: &StartEntry| StartValue {
        key: entry.key.clone(),
        line: Some(entry.line),
        model: entry.model.clone(),
        name: entry.name.clone(),
        value: given(&entry.value),
    };
    entries.iter().map(convert).collect()
}

fn given(value: &FileValue) -> SetupValue {
    match value {
        FileValue::Real(number) => SetupValue::Number(*number),
        FileValue::Integer(number) => SetupValue::Integer(*number),
        FileValue::Boolean(truth) => SetupValue::Boolean(*truth),
        FileValue::Text(text) => SetupValue::Text(text.clone()),
        FileValue::List(items) => SetupValue::List(items.iter().map(given).collect()),
    }
}

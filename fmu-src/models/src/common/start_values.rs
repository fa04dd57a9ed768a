//! Start values of a setup file, from the file's own words to the exporter's.

use fmi_export::{Enumeration, SetupValue, StartValue};
use physics::{
    environment::dates,
    spacecraft::{StartEntry, StartValue as FileValue},
};

/// The variable that takes a date: in s past J2000 TDB.
const EPOCH: &str = "start.epoch";

/// The entries of a file's `[start]` and `[fixed]` as start values of variables.
pub fn start_values(entries: &[StartEntry]) -> Vec<StartValue> {
    let convert = |entry: &StartEntry| StartValue {
        key: entry.key.clone(),
        line: Some(entry.line),
        model: entry.model.clone(),
        is_fixed: entry.is_fixed,
        name: entry.name.clone(),
        value: match &entry.value {
            FileValue::Text(text) if entry.name == EPOCH && dates::looks_like_date(text) => date(text),
            value => given(value),
        },
    };
    entries.iter().map(convert).collect()
}

fn date(text: &str) -> SetupValue {
    match dates::epoch_s(text) {
        Ok(epoch_s) => SetupValue::Number(epoch_s),
        Err(error) => SetupValue::Refused {
            found: format!("{text:?}, {error}"),
            allowed: dates::ALLOWED_DATE.to_owned(),
        },
    }
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

/// The entry that counts for a variable of `model`: a constant goes before a start value, one for this model alone before one
/// for all.
pub fn entry_of<'a>(entries: &'a [StartEntry], model: &str, name: &str) -> Option<&'a StartEntry> {
    let counts = |entry: &&StartEntry| {
        entry.name == name && entry.model.as_deref().is_none_or(|requested| requested == model)
    };
    entries.iter().filter(counts).max_by_key(|entry| (entry.is_fixed, entry.model.is_some()))
}

/// The item at which a choice of `model` is fixed; `None` where it is open.
pub fn fixed_item<E: Enumeration>(entries: &[StartEntry], model: &str, name: &str) -> Option<E> {
    entry_of(entries, model, name).filter(|entry| entry.is_fixed).and_then(|entry| item(&entry.value))
}

/// The item that a start value names or numbers.
pub fn item<E: Enumeration>(value: &FileValue) -> Option<E> {
    let number = match value {
        FileValue::Integer(number) => i32::try_from(*number).ok()?,
        FileValue::Text(name) => E::TYPE.items.iter().find(|item| item.name == name.as_str())?.value,
        _ => return None,
    };
    E::from_value(number)
}

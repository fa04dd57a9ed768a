//! Start values of a setup file, from the file's own words to the exporter's.

use fmi_export::{Enumeration, SetupValue, StartValue};
use physics::{
    bodies::Body,
    enumeration::Enumerated,
    environment::dates,
    spacecraft::{Spacecraft, StartEntry, StartValue as FileValue},
    toml::nearest,
};

use super::choices::{DownlinkReference, OrbitCenter};

/// Variables that take a body, which the spacecraft's file may describe.
const BODIES: [&str; 2] = ["orbit.center", "target.planet"];

/// The variable that takes a date: in s past J2000 TDB.
const EPOCH: &str = "start.epoch";

/// The time of the simulation at which a burn begins.
const BURN: &str = "burn.start";
/// Times after the start, where downlinks are counted from there.
const DOWNLINKS: [&str; 2] = ["guided.downlinkStart", "guided.downlinkEnd"];
/// From where downlinks are counted.
const REFERENCE: &str = "guided.downlinkReference";

/// Start values of a spacecraft's file, which may describe a body of its own.
pub(crate) fn of_spacecraft(
    spacecraft: &Spacecraft,
    model: &str,
    default_epoch_s: Option<f64>,
) -> Vec<StartValue> {
    start_values(&spacecraft.start, model, default_epoch_s, spacecraft.body.is_some())
}

/// The entries of a file's `[start]` and `[fixed]` as start values of variables of `model`, in which times count from
/// `default_epoch_s` unless the file says another epoch; `None`: the model has none.
///
/// A spacecraft's file may describe a body of its own (`has_body`).
pub(crate) fn start_values(
    entries: &[StartEntry],
    model: &str,
    default_epoch_s: Option<f64>,
    has_body: bool,
) -> Vec<StartValue> {
    let value = |entry: &StartEntry| {
        let FileValue::Text(text) = &entry.value else { return given(&entry.value) };
        let is_of_model = entry.model.as_deref().is_none_or(|of| of == model);
        match entry.name.as_str() {
            name if BODIES.contains(&name) => body(text, has_body),
            _ if !dates::looks_like_date(text) => given(&entry.value),
            EPOCH => date(text),
            name if is_of_model && (name == BURN || DOWNLINKS.contains(&name)) => match default_epoch_s {
                Some(default_epoch_s) => time(entries, model, entry, text, default_epoch_s),
                None => given(&entry.value),
            },
            _ => given(&entry.value),
        }
    };
    let convert = |entry: &StartEntry| StartValue {
        key: entry.key.clone(),
        line: Some(entry.line),
        model: entry.model.clone(),
        is_fixed: entry.is_fixed,
        name: entry.name.clone(),
        value: value(entry),
    };
    entries.iter().map(convert).collect()
}

/// The time of a date after the start, which is FMI time 0 in whatever starts there.
fn time(
    entries: &[StartEntry],
    model: &str,
    entry: &StartEntry,
    text: &str,
    default_epoch_s: f64,
) -> SetupValue {
    let refused = |found: String, allowed: String| SetupValue::Refused { found, allowed };
    let of_model = |name: &str| entry_of(entries, model, name).map(|entry| &entry.value);
    let is_from_start = of_model(REFERENCE).and_then(item) == Some(DownlinkReference::Start);
    if DOWNLINKS.contains(&entry.name.as_str()) && !is_from_start {
        let found = format!("the date {text:?}, while downlinks count from periapsis");
        return refused(found, format!("a time after periapsis, or \"{REFERENCE}\" = \"start\" beside it"));
    }
    let epoch_s = match of_model(EPOCH).map_or(Ok(SetupValue::Number(default_epoch_s)), |value| match value {
        FileValue::Text(written) => dates::epoch_s(written).map(SetupValue::Number),
        value => Ok(given(value)),
    }) {
        Ok(SetupValue::Number(epoch_s)) => epoch_s,
        Ok(SetupValue::Integer(epoch_s)) => epoch_s as f64,
        _ => {
            let found = format!("the date {text:?}, while {EPOCH} is neither a date nor a number in s");
            return refused(found, format!("{EPOCH} as one of them, or a time"));
        }
    };
    match date(text) {
        SetupValue::Number(at_s) => SetupValue::Number(dates::span_s(epoch_s, at_s)),
        refused => refused,
    }
}

/// A body by name; `custom` where the file describes one.
fn body(text: &str, has_own: bool) -> SetupValue {
    let known = OrbitCenter::TYPE.items;
    if known.iter().any(|item| item.name == text) || (has_own && text == Body::Custom.name()) {
        return SetupValue::Text(text.to_owned());
    }
    let names: Vec<&str> = known.iter().map(|item| item.name).collect();
    let hint = nearest(text, &names).map_or(String::new(), |it| format!(" (did you mean \"{it}\"?)"));
    let mut items: Vec<String> = known.iter().map(|item| format!("{} ({})", item.name, item.value)).collect();
    items.push("and custom where the file has a table [body]".to_owned());
    SetupValue::Refused { found: format!("{text:?}{hint}"), allowed: items.join(", ") }
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
pub(crate) fn entry_of<'a>(entries: &'a [StartEntry], model: &str, name: &str) -> Option<&'a StartEntry> {
    let counts = |entry: &&StartEntry| {
        entry.name == name && entry.model.as_deref().is_none_or(|requested| requested == model)
    };
    entries.iter().filter(counts).max_by_key(|entry| (entry.is_fixed, entry.model.is_some()))
}

/// The item at which a choice of `model` is fixed; `None` where it is open.
pub(crate) fn fixed_item<E: Enumeration>(entries: &[StartEntry], model: &str, name: &str) -> Option<E> {
    entry_of(entries, model, name).filter(|entry| entry.is_fixed).and_then(|entry| item(&entry.value))
}

/// The item that a start value names or numbers.
pub(crate) fn item<E: Enumeration>(value: &FileValue) -> Option<E> {
    let number = match value {
        FileValue::Integer(number) => i32::try_from(*number).ok()?,
        FileValue::Text(name) => E::TYPE.items.iter().find(|item| item.name == name.as_str())?.value,
        _ => return None,
    };
    E::from_value(number)
}

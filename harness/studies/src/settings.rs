//! Names and values that a study sets, and how it writes numbers.

use loader::Value;

/// Names and values to be set.
pub(crate) type Settings = Vec<(String, Value)>;

/// The elements of a vector or quaternion as settings.
pub(crate) fn elements(name: &str, values: impl IntoIterator<Item = f64>) -> Settings {
    (1..).zip(values).map(|(i, value)| real(&format!("{name}[{i}]"), value)).collect()
}

/// A Real as a setting.
pub(crate) fn real(name: &str, value: f64) -> (String, Value) {
    (name.to_owned(), Value::Real(value))
}

/// An Integer as a setting.
pub(crate) fn number(name: &str, value: i32) -> (String, Value) {
    (name.to_owned(), Value::Integer(value))
}

/// An item of an Enumeration as a setting.
pub(crate) fn item(name: &str, item: &str) -> (String, Value) {
    (name.to_owned(), Value::Text(item.to_owned()))
}

/// A Boolean as a setting.
pub(crate) fn flag(name: &str, value: bool) -> (String, Value) {
    (name.to_owned(), Value::Boolean(value))
}

/// The settings of a component.
pub(crate) fn of(component: &str, settings: Settings) -> Settings {
    settings.into_iter().map(|(name, value)| (format!("{component}.{name}"), value)).collect()
}

/// All digits that a number has.
pub(crate) fn digits(x: f64) -> String {
    format!("{x:?}")
}

/// All digits of every number.
pub(crate) fn cells(numbers: &[&[f64]]) -> Vec<String> {
    numbers.iter().flat_map(|numbers| numbers.iter().copied().map(digits)).collect()
}

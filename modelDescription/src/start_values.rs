//! Variables at the start: the last value that was set, or the description's.

use crate::Description;
use crate::value::{self, Value};

/// The value of a variable.
pub fn start(description: &Description, sets: &[(String, Value)], name: &str) -> Option<Value> {
    if let Some((_, value)) = sets.iter().rev().find(|(set, _)| set == name) {
        return Some(value.clone());
    }
    let variable = description.variables.iter().find(|it| it.name == name)?;
    value::start(variable)
}

/// The value of a Real.
pub fn real(description: &Description, sets: &[(String, Value)], name: &str) -> Option<f64> {
    match start(description, sets, name)? {
        Value::Real(value) => Some(value),
        _ => None,
    }
}

/// The name of an option's item, set by its number or its name.
pub fn item<'a>(description: &'a Description, sets: &[(String, Value)], name: &str) -> Option<&'a str> {
    let variable = description.variables.iter().find(|it| it.name == name)?;
    let value = start(description, sets, name)?;
    let items = value::items(description, variable).iter();
    let found = items.into_iter().find(|it| match &value {
        Value::Integer(number) => it.value == *number,
        Value::Text(text) => it.name == *text,
        _ => false,
    });
    found.map(|it| it.name.as_str())
}

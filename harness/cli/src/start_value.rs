//! The value that a variable begins with: its start, unless something else was set.

use loader::Value;
use model_description::{Description, value};

/// The value of a variable at the start, the last one that was set or the description's.
pub fn of(description: &Description, sets: &[(String, Value)], name: &str) -> Option<Value> {
    if let Some((_, value)) = sets.iter().rev().find(|(set, _)| set == name) {
        return Some(value.clone());
    }
    let variable = description.variables.iter().find(|it| it.name == name)?;
    value::start(variable)
}

/// The value of a Real.
pub fn real(description: &Description, sets: &[(String, Value)], name: &str) -> Option<f64> {
    match of(description, sets, name)? {
        Value::Real(value) => Some(value),
        _ => None,
    }
}

/// The name of an option's item.
pub fn item<'a>(description: &'a Description, sets: &[(String, Value)], name: &str) -> Option<&'a str> {
    let variable = description.variables.iter().find(|it| it.name == name)?;
    let Value::Integer(number) = of(description, sets, name)? else { return None };
    value::items(description, variable).iter().find(|it| it.value == number).map(|it| it.name.as_str())
}

//! Variables by what people write of them: start values, settings, selections.

use loader::{Error, Value};
use model_description::{Description, value};

use crate::epoch;

/// The value of a variable at the start, the last one that was set or the description's.
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

/// The name of an option's item.
pub fn item<'a>(description: &'a Description, sets: &[(String, Value)], name: &str) -> Option<&'a str> {
    let variable = description.variables.iter().find(|it| it.name == name)?;
    let Value::Integer(number) = start(description, sets, name)? else { return None };
    value::items(description, variable).iter().find(|it| it.value == number).map(|it| it.name.as_str())
}

/// The values of settings, written as for `--set`.
///
/// # Errors
/// What is no variable, and what it does not take.
pub fn assigned(description: &Description, settings: &[String]) -> Result<Vec<(String, Value)>, Error> {
    let mut sets = Vec::new();
    for setting in settings {
        sets.extend(loader::parse_assignment(description, &epoch::in_seconds(description, setting)?)?);
    }
    Ok(sets)
}

/// Positions of everything that some patterns mean, each once; `select` says what one means.
///
/// # Errors
/// A pattern that means nothing.
pub fn selected(
    description: &Description,
    patterns: &[String],
    select: fn(&Description, &str) -> Result<Vec<usize>, Error>,
) -> Result<Vec<usize>, Error> {
    let mut positions = Vec::new();
    for pattern in patterns {
        let found = select(description, pattern)?;
        positions
            .extend(found.into_iter().filter(|position| !positions.contains(position)).collect::<Vec<_>>());
    }
    Ok(positions)
}

/// The vector that an element is of.
pub fn vector(name: &str) -> Option<&str> {
    name.strip_suffix(']').and_then(|name| name.rsplit_once('[')).map(|(vector, _)| vector)
}

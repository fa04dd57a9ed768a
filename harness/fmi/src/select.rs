//! Names of variables as people write them: exact, a whole vector, or with `*`.

use model_description::{
    Causality, Description, ScalarVariable,
    names::{element, similar},
};

use crate::Error;

/// Positions in `ModelVariables` of everything `pattern` means: see [`crate::Fmu::select`].
pub fn select(description: &Description, pattern: &str) -> Result<Vec<usize>, Error> {
    let pattern = pattern.trim();
    let found = find(description, pattern);
    if found.is_empty() { Err(unknown(description, pattern)) } else { Ok(found) }
}

/// As [`crate::Fmu::select`], but a `*` takes outputs only: anything else is named.
pub fn select_outputs(description: &Description, pattern: &str) -> Result<Vec<usize>, Error> {
    let mut found = select(description, pattern)?;
    let pattern = pattern.trim();
    if !pattern.contains('*') || named(description, pattern).is_some() {
        return Ok(found);
    }
    let first = found.first().and_then(|&index| description.variables.get(index));
    let first = first.map_or_else(String::new, |variable| variable.name.clone());
    found.retain(|&index| description.variables[index].causality == Causality::Output);
    if found.is_empty() {
        return Err(Error::NoOutput {
            fmu: description.model_name.clone(),
            pattern: pattern.to_owned(),
            example: first,
        });
    }
    Ok(found)
}

/// Position of the variable of this name; in another case where only one has it so.
pub(crate) fn named(description: &Description, name: &str) -> Option<usize> {
    if let Some(index) = description.variables.iter().position(|variable| variable.name == name) {
        return Some(index);
    }
    let mut others = all(description, |variable| is_same(&variable.name, name)).into_iter();
    others.next().filter(|_| others.next().is_none())
}

/// Whether two names differ in case at most.
pub(crate) fn is_same(one: &str, other: &str) -> bool {
    one.to_lowercase() == other.to_lowercase()
}

fn find(description: &Description, pattern: &str) -> Vec<usize> {
    if let Some(index) = named(description, pattern) {
        return vec![index];
    }
    let lower = pattern.to_lowercase();
    if pattern.contains('*') {
        let fits = |pattern: &str, name: &str| matches(pattern, name) || matches(pattern, vector(name));
        let exact = all(description, |variable| fits(pattern, &variable.name));
        if !exact.is_empty() {
            return exact;
        }
        return all(description, |variable| fits(&lower, &variable.name.to_lowercase()));
    }
    let exact = all(description, |variable| vector(&variable.name) == pattern);
    if !exact.is_empty() {
        return exact;
    }
    let elements = all(description, |variable| is_same(vector(&variable.name), pattern));
    let first = elements.first().map(|&index| vector(&description.variables[index].name));
    let is_one = elements.iter().all(|&index| Some(vector(&description.variables[index].name)) == first);
    if is_one { elements } else { Vec::new() }
}

fn all(description: &Description, fits: impl Fn(&ScalarVariable) -> bool) -> Vec<usize> {
    let variables = description.variables.iter().enumerate();
    variables.filter(|(_, variable)| fits(variable)).map(|(index, _)| index).collect()
}

/// The vector or matrix that an element is of; of any other variable its name.
fn vector(name: &str) -> &str {
    let is_indices = |text: &str| text.bytes().all(|byte| byte.is_ascii_digit() || byte == b',');
    element(name).filter(|(_, indices)| is_indices(indices)).map_or(name, |(vector, _)| vector)
}

/// Returns the error that there is no variable of this name, with similar ones.
pub(crate) fn unknown(description: &Description, name: &str) -> Error {
    let near = similar(name, description.variables.iter().map(|variable| variable.name.as_str()));
    let hint = if near.is_empty() {
        "; `heliotorque info --variables` lists them".to_owned()
    } else {
        format!("; near it: {}", near.join(", "))
    };
    Error::UnknownVariable { fmu: description.model_name.clone(), name: name.to_owned(), hint }
}

/// Whether `text` fits `pattern`, in which `*` stands for any text.
fn matches(pattern: &str, text: &str) -> bool {
    let mut parts = pattern.split('*');
    let Some(mut rest) = parts.next().and_then(|first| text.strip_prefix(first)) else { return false };
    let mut last = None;
    for part in parts {
        if let Some(previous) = last.replace(part) {
            let Some(at) = rest.find(previous) else { return false };
            rest = &rest[at + previous.len()..];
        }
    }
    match last {
        Some(last) => rest.len() >= last.len() && rest.ends_with(last),
        None => rest.is_empty(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stars_stand_for_any_text() {
        assert!(matches("torque.*", "torque.solar[1]"));
        assert!(matches("momentum.body[*]", "momentum.body[3]"));
        assert!(matches("*.solar[*]", "force.solar[2]"));
        assert!(matches("a*a", "aa"));
        assert!(!matches("a*a", "a"));
        assert!(!matches("torque.*[1]", "torque.solar[1][2]"));
        assert!(!matches("torque.*", "force.solar[1]"));
        assert!(!matches("momentum.body", "momentum.body[1]"));
    }
}

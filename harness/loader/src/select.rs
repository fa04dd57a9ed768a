//! Names of variables as people write them: exact, a whole vector, or with `*`.

use model_description::{Description, names::similar};

use crate::Error;

/// Positions in `ModelVariables` of everything `pattern` means: see [`crate::Fmu::select`].
pub(crate) fn select(description: &Description, pattern: &str) -> Result<Vec<usize>, Error> {
    let pattern = pattern.trim();
    if let Some(index) = description.variables.iter().position(|variable| variable.name == pattern) {
        return Ok(vec![index]);
    }
    let vector = format!("{pattern}[*]");
    let pattern_or_vector = if pattern.contains('*') { pattern } else { &vector };
    let found: Vec<usize> = description
        .variables
        .iter()
        .enumerate()
        .filter(|(_, variable)| matches(pattern_or_vector, &variable.name))
        .map(|(index, _)| index)
        .collect();
    if found.is_empty() { Err(unknown(description, pattern)) } else { Ok(found) }
}

/// That there is no variable of this name, with similar ones.
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

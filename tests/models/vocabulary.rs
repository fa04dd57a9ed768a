//! One vocabulary: what has the same name in two models is the same, in type, unit, limits, default and the words of its
//! description.

use std::collections::BTreeMap;

use super::named_model::LIBRARY;
use model_description::{Causality, ScalarVariable, VariableKind};

const MODELS: [&str; 4] = ["MomentumPlant", "SpinPlant", "DisturbanceTorque", "Guidance"];

/// A model's description by a file, by its own without one; none of a file that it does not take.
fn described(model: &str, file: Option<(&str, &str)>) -> Option<Vec<ScalarVariable>> {
    let entry = LIBRARY.find(model).unwrap();
    let found = LIBRARY.describe(entry, file.map(|it| it.0), file.map(|it| it.1));
    found.ok().map(|description| description.variables)
}

/// Files that the three-axis models share, and the spinner's own.
const FILES: &[(&str, &str)] = &[
    ("messenger.toml", include_str!("../../fmu-src/resources/messenger.toml")),
    ("messenger-full.toml", include_str!("../../fmu-src/resources/messenger-full.toml")),
    ("messenger-thermal.toml", include_str!("../../fmu-src/resources/messenger-thermal.toml")),
    ("solar-sailer.toml", include_str!("../../fmu-src/resources/examples/solar-sailer.toml")),
    ("ace.toml", include_str!("../../fmu-src/resources/ace.toml")),
];

/// Names that may differ in one respect between models, and why.
const EXCEPTIONS: &[(&str, &str, &str)] = &[
    ("burn.start", "min", "of the spinner's train of pulses, and of a delta-v"),
    ("burn.start", "max", "of the spinner's train of pulses, and of a delta-v"),
    ("burn.start", "description", "of the spinner's train of pulses, and of a delta-v"),
    ("deltaV", "description", "the spinner feels its thrusters alone"),
    ("keepIn.azimuth", "max", "Guidance points within a half of the sky at most"),
    ("keepIn.azimuth", "default", "Guidance points within a half of the sky at most"),
    ("sun.azimuth", "description", "Guidance gives it of the commanded attitude"),
    ("sun.elevation", "description", "Guidance gives it of the commanded attitude"),
];

/// Everything that is to be equal, by what it is.
fn facts(variable: &ScalarVariable) -> BTreeMap<&'static str, String> {
    let number = |value: Option<f64>| value.map_or_else(String::new, |value| format!("{value:?}"));
    let whole = |value: Option<i32>| value.map_or_else(String::new, |value| value.to_string());
    let mut facts = BTreeMap::new();
    match &variable.kind {
        VariableKind::Real { attributes, start, .. } => {
            facts.insert("type", "Real".to_owned());
            facts.insert("unit", attributes.unit.clone().unwrap_or_default());
            facts.insert("displayUnit", attributes.display_unit.clone().unwrap_or_default());
            facts.insert("min", number(attributes.min));
            facts.insert("max", number(attributes.max));
            facts.insert("default", number(*start));
        }
        VariableKind::Integer { min, max, start, .. } => {
            facts.insert("type", "Integer".to_owned());
            facts.insert("min", whole(*min));
            facts.insert("max", whole(*max));
            facts.insert("default", whole(*start));
        }
        VariableKind::Enumeration { declared_type, start, .. } => {
            facts.insert("type", declared_type.clone());
            facts.insert("default", whole(*start));
        }
        VariableKind::Boolean { start, .. } => {
            facts.insert("type", "Boolean".to_owned());
            facts.insert("default", start.map_or_else(String::new, |start| start.to_string()));
        }
        VariableKind::String { start, .. } => {
            facts.insert("type", "String".to_owned());
            facts.insert("default", start.clone().unwrap_or_default());
        }
    }
    let text = variable.description.clone().unwrap_or_default();
    let end = text.find(['.', ';', ':', ',']).unwrap_or(text.len());
    facts.insert("description", text[..end].to_owned());
    facts
}

/// Whether a master sets it.
fn is_set(variable: &ScalarVariable) -> bool {
    matches!(variable.causality, Causality::Input | Causality::Parameter)
}

/// Differences of two variables of one name.
fn differences(a: &ScalarVariable, b: &ScalarVariable) -> Vec<String> {
    let compared: &[&str] = if a.causality == b.causality {
        &["type", "unit", "displayUnit", "min", "max", "default", "description"]
    } else if is_set(a) && is_set(b) {
        // A parameter here and an input there: as an input it has words of its own.
        &["type", "unit", "displayUnit", "min", "max", "default"]
    } else {
        // One connects to the other.
        &["type", "unit", "displayUnit"]
    };
    let (of_a, of_b) = (facts(a), facts(b));
    let differ = compared.iter().filter(|fact| of_a.get(**fact) != of_b.get(**fact));
    differ.map(|fact| (*fact).to_owned()).collect()
}

#[test]
fn what_has_one_name_is_one_thing() {
    let mut found = Vec::new();
    let mut used = vec![false; EXCEPTIONS.len()];
    for (file, text) in FILES {
        let described: Vec<_> =
            MODELS.iter().filter_map(|model| Some((*model, described(model, Some((file, text)))?))).collect();
        assert!(!described.is_empty(), "{file}");
        for (at, (one, a)) in described.iter().enumerate() {
            for (other, b) in &described[at + 1..] {
                compare(file, (one, a), (other, b), &mut used, &mut found);
            }
        }
    }
    // SpinPlant has a spacecraft file of its own.
    let shipped = MODELS.map(|model| (model, described(model, None).unwrap()));
    let spinner = shipped.iter().find(|(name, _)| *name == "SpinPlant").unwrap();
    for (name, variables) in shipped.iter().filter(|(name, _)| *name != "SpinPlant") {
        compare("", (name, variables), (spinner.0, &spinner.1), &mut used, &mut found);
    }
    assert!(found.is_empty(), "{} differ:\n{}", found.len(), found.join("\n"));
    let unused: Vec<_> = EXCEPTIONS.iter().zip(used).filter(|(_, used)| !used).map(|(it, _)| it).collect();
    assert!(unused.is_empty(), "{unused:?}");
}

fn compare(
    file: &str,
    (one, a): (&str, &[ScalarVariable]),
    (other, b): (&str, &[ScalarVariable]),
    used: &mut [bool],
    found: &mut Vec<String>,
) {
    let b: BTreeMap<&str, &ScalarVariable> = b.iter().map(|it| (it.name.as_str(), it)).collect();
    for variable in a {
        let Some(same) = b.get(variable.name.as_str()) else { continue };
        for fact in differences(variable, same) {
            // A default goes by the file.
            if file.is_empty() && fact == "default" {
                continue;
            }
            let bare = variable.name.split('[').next().unwrap_or_default();
            let exception =
                EXCEPTIONS.iter().position(|(name, what, _)| *name == bare && *what == fact.as_str());
            match exception {
                Some(at) => used[at] = true,
                None => {
                    let (of_a, of_b) = (facts(variable), facts(same));
                    let reported =
                        |facts: &BTreeMap<_, String>| facts.get(fact.as_str()).cloned().unwrap_or_default();
                    let line = format!(
                        "{} {fact}: {one} {:?}, {other} {:?}",
                        variable.name,
                        reported(&of_a),
                        reported(&of_b)
                    );
                    if !found.contains(&line) {
                        found.push(line);
                    }
                }
            }
        }
    }
}

/// Names of different models that differ in case, a plural or one letter alone, and are meant.
const ALIKE: &[(&str, &str)] = &[
    // One of the spinner's, and a set of them.
    ("burn.thruster", "burn.thrusters"),
];

/// A name that is almost another model's is a slip, unless it is known here.
#[test]
fn names_that_look_alike_are_the_same() {
    let names = MODELS.map(|model| {
        let mut bare: Vec<String> =
            described(model, None).unwrap().iter().map(|it| bare_of(&it.name)).collect();
        bare.sort();
        bare.dedup();
        (model, bare)
    });
    let mut found = Vec::new();
    for (at, (one, a)) in names.iter().enumerate() {
        for (other, b) in &names[at + 1..] {
            for (x, y) in a.iter().flat_map(|x| b.iter().map(move |y| (x, y))) {
                let known = |pair: &(&str, &str)| [(x.as_str(), y.as_str()), (y, x)].contains(pair);
                let is_of_both = b.contains(x) || a.contains(y);
                if x != y && !is_of_both && folded(x) == folded(y) && !ALIKE.iter().any(known) {
                    found.push(format!("{one} {x}, {other} {y}"));
                }
            }
        }
    }
    assert!(found.is_empty(), "{}", found.join("\n"));
}

#[test]
fn every_source_of_a_manual_says_by_what() {
    for model in MODELS {
        let manual = LIBRARY.find(model).unwrap().manual;
        assert!(manual.sources().count() > 10, "{model}");
        for (what, by) in manual.sources() {
            assert!(!by.is_empty(), "{model}: {what}");
        }
    }
}

/// The name without its indices.
fn bare_of(name: &str) -> String {
    let mut bare = String::new();
    let mut inside = false;
    for letter in name.chars() {
        match letter {
            '[' => inside = true,
            ']' => inside = false,
            other if !inside => bare.push(other),
            _ => {}
        }
    }
    bare
}

/// A word without its spelling: case, plurals, British and American endings.
fn folded(name: &str) -> String {
    let words = name.to_lowercase().replace("centre", "center").replace("colour", "color");
    words.split('.').map(|word| word.trim_end_matches('s')).collect()
}

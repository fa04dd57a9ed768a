//! Sets of thrusters, by the file's own names.

use super::description::Description;
use crate::spacecraft::thruster::ThrusterSet;
use crate::toml::{Checker, Place};

/// Words that no enumeration of Modelica may have as an item (Modelica 3.6, 2.3.3).
const MODELICA_KEYWORDS: &[&str] = &[
    "algorithm",
    "and",
    "annotation",
    "block",
    "break",
    "class",
    "connect",
    "connector",
    "constant",
    "constrainedby",
    "der",
    "discrete",
    "each",
    "else",
    "elseif",
    "elsewhen",
    "encapsulated",
    "end",
    "enumeration",
    "equation",
    "expandable",
    "extends",
    "external",
    "false",
    "final",
    "flow",
    "for",
    "function",
    "if",
    "import",
    "impure",
    "in",
    "initial",
    "inner",
    "input",
    "loop",
    "model",
    "not",
    "operator",
    "or",
    "outer",
    "output",
    "package",
    "parameter",
    "partial",
    "protected",
    "public",
    "pure",
    "record",
    "redeclare",
    "replaceable",
    "return",
    "stream",
    "then",
    "true",
    "type",
    "when",
    "while",
    "within",
];

/// What a name may be.
const ALLOWED: &str = "letters and digits, the first a letter; not `none` and no keyword of Modelica";

/// The names of the sets: those that `sets` lists, then others in the order of their first thruster.
pub(crate) fn thruster_sets(check: &mut Checker<'_>, description: &Description) -> Vec<String> {
    let mut sets: Vec<String> = Vec::new();
    let place = Place::root().key("sets");
    for (index, name) in description.sets.iter().flat_map(|sets| sets.iter()).enumerate() {
        let at = place.item(index);
        check_name(check, &at, name);
        if sets.contains(name) {
            check.report(&at, format_args!("`{name}` once more"), "each set once");
        } else {
            sets.push(name.clone());
        }
    }
    let place = Place::root().key("thrusters");
    for (index, thruster) in description.thrusters.iter().flat_map(|list| list.iter()).enumerate() {
        let Some(name) = thruster.set.as_ref().filter(|name| !sets.contains(name)) else { continue };
        check_name(check, &place.item(index).key("set"), name);
        sets.push(name.clone());
    }
    sets
}

/// The set of this name, which is among `sets`.
pub(crate) fn set_of(sets: &[String], name: Option<&str>) -> Option<ThrusterSet> {
    let index = sets.iter().position(|set| Some(set.as_str()) == name)?;
    u16::try_from(index).ok().map(ThrusterSet)
}

fn check_name(check: &mut Checker<'_>, at: &Place, name: &str) {
    let begins = name.starts_with(|first: char| first.is_ascii_alphabetic());
    let is_word = begins && name.chars().all(|letter| letter.is_ascii_alphanumeric());
    if !is_word || name == "none" || MODELICA_KEYWORDS.contains(&name) {
        check.report(at, format_args!("{name:?}"), ALLOWED);
    }
}

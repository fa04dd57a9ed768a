//! Names that items of enumerations and variables can have.

use crate::toml::Place;

/// Words that no enumeration of Modelica may have as an item (Modelica 3.6, 2.3.3).
const MODELICA_KEYWORDS: &str = "algorithm and annotation block break class connect connector constant constrainedby der discrete \
    each else elseif elsewhen encapsulated end enumeration equation expandable extends external false \
    final flow for function if import impure in initial inner input loop model not operator or outer \
    output package parameter partial protected public pure record redeclare replaceable return stream \
    then true type when while within";

/// Form of an item's name, for messages.
const ALLOWED: &str = "letters and digits, the first a letter; not `none` and no keyword of Modelica";

/// Refuses a name that no item of an enumeration can have.
pub(super) fn check_item_name(at: &Place<'_>, name: &str) {
    let begins = name.starts_with(|first: char| first.is_ascii_alphabetic());
    let is_word = begins && name.chars().all(|letter| letter.is_ascii_alphanumeric());
    if !is_word || name == "none" || MODELICA_KEYWORDS.split(' ').any(|word| word == name) {
        at.report(format_args!("{name:?}"), ALLOWED);
    }
}

/// The name in camel case, as variables have it: `shieldFilm` of `shield-film`; `None` of one that no variable can have.
pub(super) fn variable_name(name: &str) -> Option<String> {
    let mut words = name.split(['-', '_', ' ']).filter(|word| !word.is_empty());
    let is_word = |word: &str| word.chars().all(|letter| letter.is_ascii_alphanumeric());
    let mut called =
        words.next().filter(|first| first.starts_with(|it: char| it.is_ascii_alphabetic()))?.to_owned();
    for word in words {
        let (first, others) = word.split_at_checked(1)?;
        called.push_str(&first.to_ascii_uppercase());
        called.push_str(others);
    }
    is_word(&called).then_some(called)
}

//! Lists of parts and what each part is called: the names of one kind are distinct.

use std::collections::BTreeMap;

use super::description::SpacecraftDescription;
use crate::toml::{Checker, KeyPath, Named};

/// Key path of a part, its name, and whether the file gives the name.
type Name = (KeyPath, String, bool);

fn names<D: Named>(at: KeyPath, items: Option<&[D]>) -> Vec<Name> {
    let items = items.unwrap_or_default().iter().enumerate();
    items.map(|(i, item)| (at.item(i), item.called(i), item.name().is_some())).collect()
}

/// Names of the lists of these keys.
macro_rules! names_of {
    ($description:ident: $($key:ident),+) => {
        [$(names(KeyPath::root().key(stringify!($key)), $description.$key.as_deref())),+]
    };
}

/// Two parts of one kind with one name could not be distinguished; all plates are one kind, the shade's among them.
pub(crate) fn check_names(check: &mut Checker<'_>, description: &SpacecraftDescription) {
    let of_shade = description.sunshade.as_ref().map_or_else(Vec::new, |shade| {
        names(KeyPath::root().key("sunshade").key("plates"), shade.plates.as_deref())
    });
    let plates = names_of!(description: plates, boxes, cylinders, discs, dishes);
    let others = names_of!(
        description: panels, wheels, sun_sensors, instruments, antennas, tanks, thrusters, flexible_modes, slosh
    );
    let kinds = [plates.into_iter().chain([of_shade]).flatten().collect()].into_iter().chain(others);
    for kind in kinds {
        check_kind(check, &kind);
    }
}

fn check_kind(check: &mut Checker<'_>, names: &[Name]) {
    let mut known: BTreeMap<&str, &Name> = BTreeMap::new();
    for part in names {
        let (at, name, is_given) = part;
        let (other, _, other_is_given) = *known.entry(name).or_insert(part);
        // A plate and one of the shade that nobody named are both called by their number.
        if at != other && (*is_given || *other_is_given) {
            let unnamed = if *is_given { "" } else { " as what has no name is called" };
            let found = format!("`{name}`{unnamed}, the name of {other} too");
            check.report(&at.key("name"), found, "a name of its own");
        }
    }
}

/// Words that no enumeration of Modelica may have as an item (Modelica 3.6, 2.3.3).
const MODELICA_KEYWORDS: &str = "algorithm and annotation block break class connect connector constant constrainedby der discrete \
    each else elseif elsewhen encapsulated end enumeration equation expandable extends external false \
    final flow for function if import impure in initial inner input loop model not operator or outer \
    output package parameter partial protected public pure record redeclare replaceable return stream \
    then true type when while within";

/// Form of an item's name, for messages.
const ALLOWED: &str = "letters and digits, the first a letter; not `none` and no keyword of Modelica";

/// Refuses a name that no item of an enumeration can have.
pub(crate) fn check_item_name(check: &mut Checker<'_>, at: &KeyPath, name: &str) {
    let begins = name.starts_with(|first: char| first.is_ascii_alphabetic());
    let is_word = begins && name.chars().all(|letter| letter.is_ascii_alphanumeric());
    if !is_word || name == "none" || MODELICA_KEYWORDS.split(' ').any(|word| word == name) {
        check.report(at, format_args!("{name:?}"), ALLOWED);
    }
}

/// The name in camel case, as variables have it: `shieldFilm` of `shield-film`; `None` of one that no variable can have.
pub(crate) fn variable_name(name: &str) -> Option<String> {
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

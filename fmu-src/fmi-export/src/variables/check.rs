//! Checks of a declaration at run time: roles, ranges and texts that may come from a setup file.

use core::fmt::Display;

use model_description::{
    names,
    rules::{self, RoleFault},
};

use super::variable::{DeclaredItem, Item, Role};

/// Result of a check: the problem in words.
pub(super) type Checked = Result<(), String>;

/// Checks causality, variability, initial and the presence of a start value (FMI 2.0.5, 2.2.7).
pub(super) fn role(role: Role, is_real: bool, has_start: bool) -> Checked {
    let Role { causality, variability, initial } = role;
    rules::check_role(causality, variability, initial, is_real, has_start).map_err(|fault| match fault {
        RoleFault::Role(problem) => problem,
        RoleFault::StartMissing(problem) | RoleFault::StartForbidden(problem) => problem.to_owned(),
    })
}

/// Checks a structured name.
pub(super) fn name(full: &str) -> Checked {
    names::check_structured(full).map_err(|problem| format!("the name {problem}"))
}

/// Checks that a Real attribute is a number the XML can carry.
pub(super) fn finite(what: &str, value: Option<f64>) -> Checked {
    match value {
        Some(value) if !value.is_finite() => Err(format!("{what} is {value}; it must be finite")),
        _ => Ok(()),
    }
}

/// Checks min <= start <= max.
pub(super) fn range<T: PartialOrd + Display>(start: Option<T>, min: Option<T>, max: Option<T>) -> Checked {
    if let (Some(min), Some(max)) = (&min, &max)
        && min > max
    {
        return Err(format!("min {min} is above max {max}"));
    }
    match (start, min, max) {
        (Some(start), Some(min), _) if start < min => Err(format!("start {start} is below min {min}")),
        (Some(start), _, Some(max)) if start > max => Err(format!("start {start} is above max {max}")),
        _ => Ok(()),
    }
}

/// Checks that XML 1.0 and C strings can carry a text.
pub(super) fn text(what: &str, text: &str) -> Checked {
    let bad = |letter: &char| {
        matches!(letter, '\u{FFFE}' | '\u{FFFF}' | '\0'..='\u{1F}') && !matches!(letter, '\t' | '\n' | '\r')
    };
    match text.chars().find(bad) {
        Some(letter) => Err(format!("{what} holds the character {letter:?}, which XML cannot carry")),
        None => Ok(()),
    }
}

/// Checks the items of an enumeration type: some, with distinct names and values.
pub(super) fn items(items: &[DeclaredItem]) -> Checked {
    if items.is_empty() {
        return Err("its enumeration has no items".to_owned());
    }
    for (position, item) in items.iter().enumerate() {
        let before = &items[..position];
        if before.iter().any(|other| other.name == item.name || other.value == item.value) {
            return Err(format!(
                "its enumeration has two items named `{}` or valued {}",
                item.name, item.value
            ));
        }
    }
    Ok(())
}

/// Checks that an enumeration can be an input: masters send 0 before the first exchange.
pub(super) fn has_none(items: &[Item]) -> Checked {
    match items.iter().any(|item| item.value == 0 && item.name == "none") {
        true => Ok(()),
        false => {
            Err("is an input whose enumeration has no item 0 `none`, which masters send first".to_owned())
        }
    }
}

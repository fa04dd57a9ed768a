//! Values of any base type: how people write them, and which of them a variable admits.

use core::fmt;

use crate::{
    BaseType, Description, DisplayUnit, EnumerationItem, RealAttributes, ScalarVariable, SimpleTypeKind,
    VariableKind, names::hint, quantity,
};

/// A value of a variable; Enumerations are Integers at the interface.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// Real, in the variable's unit.
    Real(f64),
    /// Integer or Enumeration.
    Integer(i32),
    /// Boolean.
    Boolean(bool),
    /// String.
    Text(String),
}

impl fmt::Display for Value {
    /// Reals in the shortest form that reads back to the same bits.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Real(value) => write!(f, "{value}"),
            Self::Integer(value) => write!(f, "{value}"),
            Self::Boolean(value) => write!(f, "{value}"),
            Self::Text(value) => write!(f, "{value}"),
        }
    }
}

impl Value {
    /// The type it is of.
    pub const fn base_type(&self) -> BaseType {
        match self {
            Self::Real(_) => BaseType::Real,
            Self::Integer(_) => BaseType::Integer,
            Self::Boolean(_) => BaseType::Boolean,
            Self::Text(_) => BaseType::String,
        }
    }

    /// As a number: Booleans are 0 and 1, texts NaN.
    pub fn to_f64(&self) -> f64 {
        match self {
            Self::Real(value) => *value,
            Self::Integer(value) => f64::from(*value),
            Self::Boolean(value) => f64::from(u8::from(*value)),
            Self::Text(_) => f64::NAN,
        }
    }

    /// Returns the value of this base type, which is no text, that [`Self::to_f64`] turned into `number`.
    pub fn of_f64(base: BaseType, number: f64) -> Self {
        match base {
            BaseType::Integer => Self::Integer(number as i32),
            BaseType::Boolean => Self::Boolean(number != 0.0),
            BaseType::Real | BaseType::String => Self::Real(number),
        }
    }
}

/// Why a value does not fit its variable.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Misfit {
    /// The value found.
    pub found: String,
    /// The values allowed.
    pub allowed: String,
}

impl Misfit {
    /// Returns the misfit of the value found with the values allowed.
    pub fn new(found: impl Into<String>, allowed: impl Into<String>) -> Self {
        Self { found: found.into(), allowed: allowed.into() }
    }
}

impl fmt::Display for Misfit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "found {}, allowed: {}", self.found, self.allowed)
    }
}

impl std::error::Error for Misfit {}

/// Unit of a Real, its own or its declared type's.
pub fn unit<'a>(description: &'a Description, variable: &'a ScalarVariable) -> Option<&'a str> {
    attribute(description, variable, |it| it.unit.as_deref())
}

/// The display unit of a Real as (name, factor, offset): value_display = factor * value + offset.
///
/// `None` where the variable has no display unit or its unit does not define it.
pub fn display_unit<'a>(
    description: &'a Description,
    variable: &'a ScalarVariable,
) -> Option<(&'a str, f64, f64)> {
    let name = attribute(description, variable, |it| it.display_unit.as_deref())?;
    let displays = display_units(description, unit(description, variable)?);
    let display = displays.iter().find(|candidate| candidate.name == name)?;
    Some((name, display.factor, display.offset))
}

/// An attribute of a Real, its own or its declared type's.
fn attribute<'a, T>(
    description: &'a Description,
    variable: &'a ScalarVariable,
    of: impl Fn(&'a RealAttributes) -> Option<T>,
) -> Option<T> {
    let VariableKind::Real { declared_type, attributes, .. } = &variable.kind else { return None };
    of(attributes).or_else(|| match type_named(description, declared_type.as_deref()?)? {
        SimpleTypeKind::Real { attributes } => of(attributes),
        _ => None,
    })
}

fn type_named<'a>(description: &'a Description, name: &str) -> Option<&'a SimpleTypeKind> {
    description.types.iter().find(|candidate| candidate.name == name).map(|found| &found.kind)
}

/// The items of an Enumeration; none of any other variable.
pub fn items<'a>(description: &'a Description, variable: &ScalarVariable) -> &'a [EnumerationItem] {
    let VariableKind::Enumeration { declared_type, .. } = &variable.kind else { return &[] };
    match type_named(description, declared_type) {
        Some(SimpleTypeKind::Enumeration { items, .. }) => items,
        _ => &[],
    }
}

/// Returns in words what may be written for a variable.
pub fn allowed(description: &Description, variable: &ScalarVariable) -> String {
    match &variable.kind {
        VariableKind::Real { .. } => match units(description, variable).join(", ") {
            units if units.is_empty() || units == "1" => "a number".to_owned(),
            units => format!("a number, with one of the units {units}"),
        },
        VariableKind::Integer { .. } => "a whole number within 32 bits".to_owned(),
        VariableKind::Boolean { .. } => "true or false".to_owned(),
        VariableKind::String { .. } => "a string".to_owned(),
        VariableKind::Enumeration { .. } => {
            let items = items(description, variable);
            let names: Vec<String> =
                items.iter().map(|item| format!("{} ({})", item.name, item.value)).collect();
            if names.is_empty() { "an item's number".to_owned() } else { names.join(", ") }
        }
    }
}

/// The unit of a Real and its display units.
fn units(description: &Description, variable: &ScalarVariable) -> Vec<String> {
    let Some(name) = unit(description, variable) else { return Vec::new() };
    let displays = display_units(description, name).iter().map(|display| display.name.clone());
    core::iter::once(name.to_owned()).chain(displays).collect()
}

fn display_units<'a>(description: &'a Description, unit: &str) -> &'a [DisplayUnit] {
    let known = description.units.iter().find(|candidate| candidate.name == unit);
    known.map(|unit| unit.display_units.as_slice()).unwrap_or_default()
}

/// Reads `text` as a value of `variable`.
///
/// Reals are in the variable's unit, or carry a suffix: the unit itself or one of its display units
/// (`5deg`, `2.54 cm`). Enumerations take the item's number or name, in any case where that is unique, Booleans `true`, `false`, `1`, `0`.
///
/// # Errors
/// Any other text, and an angle beyond a turn without a unit.
pub fn read(description: &Description, variable: &ScalarVariable, text: &str) -> Result<Value, Misfit> {
    let value = read_cell(description, variable, text)?;
    let is_bare = || text.trim().parse::<f64>().is_ok();
    match value {
        Value::Real(number)
            if quantity::is_beyond_turn(number)
                && unit(description, variable) == Some("rad")
                && is_bare() =>
        {
            let text = text.trim();
            let found = format!("{text}, which is more than a turn without a unit");
            Err(Misfit::new(found, format!("{text} deg or {text} rad")))
        }
        value => Ok(value),
    }
}

/// Reads a cell of a table as [`read`] does; an angle without a unit may be beyond a turn.
///
/// # Errors
/// Any other text.
pub fn read_cell(description: &Description, variable: &ScalarVariable, text: &str) -> Result<Value, Misfit> {
    let text = text.trim();
    let misfit = || Misfit::new(format!("{text:?}"), allowed(description, variable));
    match &variable.kind {
        VariableKind::Real { .. } => read_real(description, variable, text).map(Value::Real),
        VariableKind::Integer { .. } => text.parse().map(Value::Integer).map_err(|_| misfit()),
        VariableKind::Boolean { .. } => match text {
            "true" | "1" => Ok(Value::Boolean(true)),
            "false" | "0" => Ok(Value::Boolean(false)),
            _ => Err(Misfit::new(format!("{text:?}"), "true, false, 1, 0")),
        },
        VariableKind::String { .. } => Ok(Value::Text(text.to_owned())),
        VariableKind::Enumeration { .. } => match item_named(items(description, variable), text) {
            Some(item) => Ok(Value::Integer(item.value)),
            None => text.parse().map(Value::Integer).map_err(|_| {
                let items = items(description, variable).iter().map(|item| item.name.as_str());
                Misfit { found: format!("{text:?}{}", hint(text, items)), ..misfit() }
            }),
        },
    }
}

/// The item of this name, otherwise the only one whose name differs in case alone.
fn item_named<'a>(items: &'a [EnumerationItem], name: &str) -> Option<&'a EnumerationItem> {
    let mut in_any_case = items.iter().filter(|item| item.name.eq_ignore_ascii_case(name));
    let only = in_any_case.next().filter(|_| in_any_case.next().is_none());
    items.iter().find(|item| item.name == name).or(only)
}

fn read_real(description: &Description, variable: &ScalarVariable, text: &str) -> Result<f64, Misfit> {
    let misfit = |found: String| Misfit::new(found, allowed(description, variable));
    let (number, suffix) =
        quantity::split(text).ok_or_else(|| misfit(format!("{text:?}, which is no number")))?;
    if !number.is_finite() {
        return Err(misfit(format!("{text:?}, which is beyond the largest number")));
    }
    if suffix.is_empty() {
        return Ok(number);
    }
    let Some(unit_name) = unit(description, variable) else {
        let found = format!("{text:?} with the unit {suffix:?}");
        return Err(Misfit::new(found, "a number alone: the variable has no unit"));
    };
    if suffix == unit_name {
        return Ok(number);
    }
    match display_units(description, unit_name).iter().find(|display| display.name == suffix) {
        Some(display) => Ok((number - display.offset) / display.factor),
        None => Err(misfit(format!("{text:?} with the unknown unit {suffix:?}"))),
    }
}

/// Checks that a variable admits a value: its base type, `min` and `max`, the items of its Enumeration.
pub fn check(description: &Description, variable: &ScalarVariable, value: &Value) -> Result<(), Misfit> {
    let found = || match value {
        Value::Text(text) => format!("{text:?}"),
        other => other.to_string(),
    };
    let between = |min: Option<String>, max: Option<String>, unit: Option<&str>| {
        let unit = unit.filter(|unit| *unit != "1").map(|unit| format!(" {unit}")).unwrap_or_default();
        match (min, max) {
            (Some(min), Some(max)) => format!("a number from {min} to {max}{unit}"),
            (Some(min), None) => format!("a number from {min}{unit} up"),
            (None, Some(max)) => format!("a number up to {max}{unit}"),
            (None, None) => allowed(description, variable),
        }
    };
    let fits = match (&variable.kind, value) {
        (VariableKind::Real { .. }, Value::Real(number)) => {
            number.is_finite() && is_within(*number, limits(description, variable))
        }
        (VariableKind::Integer { min, max, .. }, Value::Integer(number)) => is_within(*number, (*min, *max)),
        (VariableKind::Enumeration { .. }, Value::Integer(number)) => {
            items(description, variable).iter().any(|item| item.value == *number)
        }
        (kind, value) => kind.base_type() == value.base_type(),
    };
    if fits {
        return Ok(());
    }
    let range = match (&variable.kind, value) {
        (VariableKind::Real { .. }, Value::Real(_)) => {
            let (min, max) = limits(description, variable);
            let short = |bound: f64| {
                if bound == 0.0 || (1e-3..1e7).contains(&bound.abs()) {
                    bound.to_string()
                } else {
                    format!("{bound:e}")
                }
            };
            between(min.map(short), max.map(short), unit(description, variable))
        }
        (VariableKind::Integer { min, max, .. }, Value::Integer(_)) => {
            between(min.map(|min| min.to_string()), max.map(|max| max.to_string()), None)
        }
        _ => allowed(description, variable),
    };
    Err(Misfit::new(found(), range))
}

/// An angle beyond its limits, reported in deg too: a number without unit is taken in rad and may have been meant in deg.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct AngleMisfit {
    /// The angle with its unit.
    pub found: String,
    /// The angle that was probably meant.
    pub meant: Option<String>,
    /// The limits in deg and rad.
    pub allowed: String,
}

/// Reports an angle, a Real whose display unit is deg, that is beyond its limits; `None` for anything else.
pub fn angle_misfit(
    description: &Description,
    variable: &ScalarVariable,
    value: &Value,
    written: &str,
) -> Option<AngleMisfit> {
    let (display, factor, _) =
        display_unit(description, variable).filter(|(name, ..)| name.starts_with("deg"))?;
    let Value::Real(number) = value else { return None };
    if check(description, variable, value).is_ok() {
        return None;
    }
    let own = unit(description, variable).unwrap_or_default();
    let has_unit = written.parse::<f64>().is_err();
    let found = if has_unit { written.to_owned() } else { format!("{written} {own}") };
    let fits_in_deg = check(description, variable, &Value::Real(number / factor)).is_ok();
    let meant = (!has_unit && fits_in_deg).then(|| format!("{written}{display}"));
    let (min, max) = limits(description, variable);
    let in_unit = |factor: f64, unit: &str| {
        let short = |bound: f64| ((bound * factor * 1e6).round() / 1e6).to_string();
        match (min.map(short), max.map(short)) {
            (Some(min), Some(max)) => format!("{min} to {max} {unit}"),
            (Some(min), None) => format!("{min} {unit} and more"),
            (None, Some(max)) => format!("{max} {unit} and less"),
            (None, None) => format!("a number in {unit}"),
        }
    };
    let allowed = format!("{} ({})", in_unit(factor, display), in_unit(1.0, own));
    Some(AngleMisfit { found, meant, allowed })
}

/// `min` and `max` of a Real, its own or its declared type's.
pub fn limits(description: &Description, variable: &ScalarVariable) -> (Option<f64>, Option<f64>) {
    (attribute(description, variable, |it| it.min), attribute(description, variable, |it| it.max))
}

fn is_within<T: PartialOrd>(number: T, (min, max): (Option<T>, Option<T>)) -> bool {
    min.is_none_or(|min| number >= min) && max.is_none_or(|max| number <= max)
}

/// The start value of a variable.
pub fn start(variable: &ScalarVariable) -> Option<Value> {
    match &variable.kind {
        VariableKind::Real { start, .. } => start.map(Value::Real),
        VariableKind::Integer { start, .. } | VariableKind::Enumeration { start, .. } => {
            start.map(Value::Integer)
        }
        VariableKind::Boolean { start, .. } => start.map(Value::Boolean),
        VariableKind::String { start, .. } => start.clone().map(Value::Text),
    }
}

/// Makes `value` the start value; a value of another base type changes nothing.
pub fn set_start(variable: &mut ScalarVariable, value: &Value) {
    match (&mut variable.kind, value) {
        (VariableKind::Real { start, .. }, Value::Real(value)) => *start = Some(*value),
        (
            VariableKind::Integer { start, .. } | VariableKind::Enumeration { start, .. },
            Value::Integer(value),
        ) => *start = Some(*value),
        (VariableKind::Boolean { start, .. }, Value::Boolean(value)) => *start = Some(*value),
        (VariableKind::String { start, .. }, Value::Text(value)) => *start = Some(value.clone()),
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    //! Items by name.
    use super::*;

    #[test]
    fn an_item_is_named_in_any_case_where_that_is_unique() {
        let items: Vec<EnumerationItem> = ["mercury", "sunOffset", "SUNOFFSET", "Sun"]
            .into_iter()
            .zip(1..)
            .map(|(name, value)| EnumerationItem { name: name.to_owned(), value, description: None })
            .collect();
        let found = |name: &str| item_named(&items, name).map(|item| item.value);
        assert_eq!(["Mercury", "MERCURY", "sun"].map(found), [Some(1), Some(1), Some(4)]);
        assert_eq!(["sunOffset", "SUNOFFSET"].map(found), [Some(2), Some(3)]);
        assert_eq!(["sunoffset", "mercur", ""].map(found), [None; 3]);
    }
}

//! Values of any base type, and how people write them.

use model_description::{Description, ScalarVariable, SimpleTypeKind, VariableKind};

use crate::{Error, Fmu};

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

impl std::fmt::Display for Value {
    /// Reals in the shortest form that reads back to the same bits.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Real(value) => write!(f, "{value}"),
            Self::Integer(value) => write!(f, "{value}"),
            Self::Boolean(value) => write!(f, "{value}"),
            Self::Text(value) => write!(f, "{value}"),
        }
    }
}

impl Value {
    /// As a number: Booleans are 0 and 1, texts NaN.
    pub fn to_f64(&self) -> f64 {
        match self {
            Self::Real(value) => *value,
            Self::Integer(value) => f64::from(*value),
            Self::Boolean(value) => f64::from(u8::from(*value)),
            Self::Text(_) => f64::NAN,
        }
    }
}

/// Unit of a Real, its own or its declared type's.
pub fn unit<'a>(description: &'a Description, variable: &'a ScalarVariable) -> Option<&'a str> {
    let VariableKind::Real { declared_type, attributes, .. } = &variable.kind else { return None };
    attributes.unit.as_deref().or_else(|| real_type(description, declared_type.as_deref()?)?.unit.as_deref())
}

/// The display unit of a Real as (name, factor, offset): value_display = factor * value + offset.
///
/// `None` where the variable has no display unit or its unit does not define it.
pub fn display_unit<'a>(
    description: &'a Description,
    variable: &'a ScalarVariable,
) -> Option<(&'a str, f64, f64)> {
    let VariableKind::Real { declared_type, attributes, .. } = &variable.kind else { return None };
    let name = attributes
        .display_unit
        .as_deref()
        .or_else(|| real_type(description, declared_type.as_deref()?)?.display_unit.as_deref())?;
    let unit = unit(description, variable)?;
    let unit = description.units.iter().find(|candidate| candidate.name == unit)?;
    let display = unit.display_units.iter().find(|candidate| candidate.name == name)?;
    Some((name, display.factor, display.offset))
}

fn real_type<'a>(description: &'a Description, name: &str) -> Option<&'a model_description::RealAttributes> {
    description.types.iter().find(|candidate| candidate.name == name).and_then(|found| match &found.kind {
        SimpleTypeKind::Real(attributes) => Some(attributes),
        _ => None,
    })
}

/// Reads `text` as a value of `variable`.
///
/// Reals are in the variable's unit, or carry a suffix: the unit itself or one of its display units
/// (`5deg`, `2.54 cm`). Enumerations take the item's name or number, Booleans `true`, `false`, `1`, `0`.
pub fn parse_value(description: &Description, variable: &ScalarVariable, text: &str) -> Result<Value, Error> {
    let text = text.trim();
    let wrong = |what: String| Error::Value { variable: variable.name.clone(), what };
    match &variable.kind {
        VariableKind::Real { .. } => parse_real(description, variable, text).map(Value::Real).map_err(wrong),
        VariableKind::Integer { .. } => text
            .parse()
            .map(Value::Integer)
            .map_err(|_| wrong(format!("{text:?} is no whole number within 32 bits"))),
        VariableKind::Boolean { .. } => match text {
            "true" | "1" => Ok(Value::Boolean(true)),
            "false" | "0" => Ok(Value::Boolean(false)),
            _ => Err(wrong(format!("{text:?} is no Boolean: true, false, 1 and 0 are"))),
        },
        VariableKind::String { .. } => Ok(Value::Text(text.to_owned())),
        VariableKind::Enumeration { declared_type, .. } => {
            let items = description.types.iter().find_map(|candidate| match &candidate.kind {
                SimpleTypeKind::Enumeration { items, .. } if candidate.name == *declared_type => Some(items),
                _ => None,
            });
            let by_name = items.and_then(|items| items.iter().find(|item| item.name == text));
            if let Some(item) = by_name {
                return Ok(Value::Integer(item.value));
            }
            text.parse().map(Value::Integer).map_err(|_| {
                let allowed = items
                    .map(|items| {
                        let names: Vec<_> =
                            items.iter().map(|item| format!("{} ({})", item.name, item.value)).collect();
                        names.join(", ")
                    })
                    .unwrap_or_else(|| "an item's number".to_owned());
                wrong(format!("{text:?} is none of its items: {allowed}"))
            })
        }
    }
}

fn parse_real(description: &Description, variable: &ScalarVariable, text: &str) -> Result<f64, String> {
    // The longest prefix that reads as a number; what follows is the unit. Words such as `inf` are no numbers
    // here, so that a unit may begin with any letter.
    let split = (1..=text.len())
        .rev()
        .filter(|&end| text.is_char_boundary(end))
        .find(|&end| {
            let number = text[..end].trim_end();
            number.ends_with(|last: char| last.is_ascii_digit() || last == '.')
                && number.parse::<f64>().is_ok()
        })
        .ok_or_else(|| format!("{text:?} is no number"))?;
    let number: f64 = text[..split].trim_end().parse().map_err(|_| format!("{text:?} is no number"))?;
    if !number.is_finite() {
        return Err(format!("{text:?} is beyond the largest number"));
    }
    let suffix = text[split..].trim();
    if suffix.is_empty() {
        return Ok(number);
    }
    let Some(unit_name) = unit(description, variable) else {
        return Err(format!("{text:?} carries the unit {suffix:?}, but the variable has none"));
    };
    if suffix == unit_name {
        return Ok(number);
    }
    let displays = description
        .units
        .iter()
        .find(|candidate| candidate.name == unit_name)
        .map(|unit| unit.display_units.as_slice())
        .unwrap_or_default();
    match displays.iter().find(|display| display.name == suffix) {
        Some(display) => Ok((number - display.offset) / display.factor),
        None => {
            let mut known = vec![unit_name.to_owned()];
            known.extend(displays.iter().map(|display| display.name.clone()));
            Err(format!("unit {suffix:?} is unknown: it takes {}", known.join(", ")))
        }
    }
}

/// Reads `name=value`, or `vector=a,b,c` for a vector whose elements are `vector[1]`, `vector[2]`, ….
pub fn parse_assignment(fmu: &Fmu, text: &str) -> Result<Vec<(String, Value)>, Error> {
    let Some((name, value)) = text.split_once('=') else {
        return Err(Error::Value {
            variable: text.to_owned(),
            what: "a setting is written name=value, for example spacecraft.mass=1100kg".to_owned(),
        });
    };
    let name = name.trim();
    let description = fmu.description();
    if let Some(variable) = fmu.find(name) {
        return Ok(vec![(name.to_owned(), parse_value(description, variable, value)?)]);
    }
    let elements = crate::select(fmu, name)?;
    let parts: Vec<&str> = value.split(',').collect();
    if parts.len() != elements.len() {
        return Err(Error::Value {
            variable: name.to_owned(),
            what: format!(
                "{} values given for its {} elements; separate them by commas",
                parts.len(),
                elements.len()
            ),
        });
    }
    elements
        .into_iter()
        .zip(parts)
        .map(|(index, part)| {
            let variable = &description.variables[index];
            Ok((variable.name.clone(), parse_value(description, variable, part)?))
        })
        .collect()
}

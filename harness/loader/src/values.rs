//! Values as people write them on the command line and in tables.

use model_description::{Description, ScalarVariable, SimpleTypeKind, VariableKind, value};

use crate::{Error, Value, select};

/// Reads `text` as a value of `variable`, see [`value::read`].
pub fn parse_value(description: &Description, variable: &ScalarVariable, text: &str) -> Result<Value, Error> {
    value::read(description, variable, text)
        .map_err(|misfit| Error::Value { variable: variable.name.clone(), what: misfit.to_string() })
}

/// Reads `name=value`, or `vector=a,b,c` for a vector whose elements are `vector[1]`, `vector[2]`, ….
pub fn parse_assignment(description: &Description, text: &str) -> Result<Vec<(String, Value)>, Error> {
    let described = assignment(description, text)?;
    Ok(described.into_iter().map(|set| (set.variable.name.clone(), set.value)).collect())
}

/// One variable of an assignment.
#[derive(Clone, Debug)]
pub struct Assigned<'a> {
    /// The variable.
    pub variable: &'a ScalarVariable,
    /// Its value.
    pub value: Value,
    /// The value as it was written.
    pub written: &'a str,
}

/// Reads an assignment to variables of a description, see [`parse_assignment`].
pub fn assignment<'a>(description: &'a Description, text: &'a str) -> Result<Vec<Assigned<'a>>, Error> {
    let Some((name, value)) = text.split_once('=') else {
        return Err(Error::Value {
            variable: text.to_owned(),
            what: "a setting is written name=value, for example spacecraft.mass=1100kg".to_owned(),
        });
    };
    let name = name.trim();
    let elements = select::select(description, name)?;
    let is_one = matches!(*elements, [index] if description.variables.get(index).is_some_and(|it| select::is_same(&it.name, name)));
    let parts: Vec<&str> = if is_one { vec![value] } else { value.split(',').collect() };
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
    let variables = elements.into_iter().filter_map(|index| description.variables.get(index));
    variables
        .zip(parts)
        .map(|(variable, part)| {
            let value = parse_value(description, variable, part)?;
            check_angle(description, variable, &value, part.trim())?;
            Ok(Assigned { variable, value, written: part.trim() })
        })
        .collect()
}

/// Refuses an angle beyond the variable's limits, with the limits in deg too: a number without unit is taken in rad and
/// may have been meant in deg.
fn check_angle(
    description: &Description,
    variable: &ScalarVariable,
    value: &Value,
    written: &str,
) -> Result<(), Error> {
    let display = value::display_unit(description, variable).filter(|(name, ..)| name.starts_with("deg"));
    let (Some((display, factor, _)), Value::Real(number)) = (display, value) else { return Ok(()) };
    if value::check(description, variable, value).is_ok() {
        return Ok(());
    }
    let own = value::unit(description, variable).unwrap_or_default();
    let has_unit = written.parse::<f64>().is_err();
    let found = if has_unit { written.to_owned() } else { format!("{written} {own}") };
    let fits_in_deg = value::check(description, variable, &Value::Real(number / factor)).is_ok();
    let hint = if !has_unit && fits_in_deg {
        format!("; did you mean {written}{display}? Allowed")
    } else {
        ", allowed".to_owned()
    };
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
    let what = format!("found {found}{hint}: {} ({})", in_unit(factor, display), in_unit(1.0, own));
    Err(Error::Value { variable: variable.name.clone(), what })
}

/// `min` and `max` of a Real, its own or its declared type's.
fn limits(description: &Description, variable: &ScalarVariable) -> (Option<f64>, Option<f64>) {
    let VariableKind::Real { declared_type, attributes, .. } = &variable.kind else { return (None, None) };
    let of_type = description.types.iter().find_map(|found| match &found.kind {
        SimpleTypeKind::Real(of_type) if Some(&found.name) == declared_type.as_ref() => Some(of_type),
        _ => None,
    });
    let min = attributes.min.or_else(|| of_type?.min);
    (min, attributes.max.or_else(|| of_type?.max))
}

//! Values as people write them on the command line and in tables.

use model_description::{
    Description, ScalarVariable, names,
    value::{self, AngleMisfit},
};

use crate::{Error, Value, select};

/// Reads `text` as a value of `variable`, see [`value::read`].
pub fn parse_value(description: &Description, variable: &ScalarVariable, text: &str) -> Result<Value, Error> {
    value::read(description, variable, text)
        .map_err(|misfit| Error::Value { variable: variable.name.clone(), what: misfit.to_string() })
}

/// Reads `name=value`, or `vector=a,b,c` for a vector whose elements are `vector[1]`, `vector[2]`, …; a single value is that of all.
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
            what: "a setting is written name=value, for example mass=1100kg".to_owned(),
        });
    };
    let name = name.trim();
    let elements = select::select(description, name)?;
    let is_one = matches!(*elements, [index] if description.variables.get(index).is_some_and(|it| select::is_same(&it.name, name)));
    let mut parts: Vec<&str> = if is_one { vec![value] } else { value.split(',').collect() };
    let is_matrix = elements
        .iter()
        .any(|index| description.variables.get(*index).is_some_and(|it| names::is_of_matrix(&it.name)));
    if let [only] = *parts.as_slice()
        && !is_matrix
    {
        // One value is that of every element of a vector.
        parts = vec![only; elements.len()];
    }
    if parts.len() != elements.len() {
        return Err(Error::Value {
            variable: name.to_owned(),
            what: format!(
                "{} values given for its {} elements, allowed: one value for all, or as many values as elements, with commas between \
                 them",
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

/// Refuses an angle beyond the variable's limits, with the limits in deg too.
fn check_angle(
    description: &Description,
    variable: &ScalarVariable,
    value: &Value,
    written: &str,
) -> Result<(), Error> {
    let Some(misfit) = value::angle_misfit(description, variable, value, written) else { return Ok(()) };
    let AngleMisfit { found, meant, allowed } = misfit;
    let what = match meant {
        Some(meant) => format!("found {found}; did you mean {meant}? Allowed: {allowed}"),
        None => format!("found {found}, allowed: {allowed}"),
    };
    Err(Error::Value { variable: variable.name.clone(), what })
}

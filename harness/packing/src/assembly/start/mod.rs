//! `--set`, `--fix` and missions: values written into the tables `[start]` and `[fixed]` of the packed file, over those that stand
//! there.

use fmi::{Assigned, assignment};
use inputs::epoch::{self, Dates};
use model_description::{Causality, Description, VariableKind, value};
use physics::environment::dates;
use toml_edit::{DocumentMut, Item, Table, TableLike, Value};

/// The table of start values in a setup file.
pub const START: &str = "start";
/// The table of what is constant in an FMU.
pub(super) const FIXED: &str = "fixed";

/// The file's text with the values that `settings` give to variables of the model in a table, each with where it is given; the
/// rest stays, comments too.
///
/// # Errors
/// A name that the model does not have or that cannot be set, a value that it does not take.
pub fn with_values(
    text: &str,
    table_name: &str,
    model: &str,
    description: &Description,
    settings: &[(String, String)],
) -> Result<String, Box<dyn std::error::Error>> {
    if settings.is_empty() {
        return Ok(text.to_owned());
    }
    let mut file: DocumentMut = text.strip_prefix('\u{feff}').unwrap_or(text).parse()?;
    let mut start = table(file.as_table_mut(), table_name)?;
    // What is for this model alone would win over what is for all.
    if start.contains_key(model) {
        start = table(start, model)?;
    }
    let counted = Dates::new(description, settings.iter().map(|(_, set)| set.as_str()), None);
    for (at, set) in settings {
        let in_set = |error: fmi::Error| format!("{at}: {error}");
        let setting = counted.in_seconds(set).map_err(in_set)?;
        for assigned in assignment(description, &setting).map_err(in_set)? {
            let value = checked(description, &assigned)
                .map_err(|misfit| format!("{at}: {}: {misfit}", assigned.variable.name))?;
            match start.get_mut(&assigned.variable.name).and_then(Item::as_value_mut) {
                Some(old) => {
                    let decor = old.decor().clone();
                    *old = value;
                    *old.decor_mut() = decor;
                }
                None => drop(start.insert(&assigned.variable.name, Item::Value(value))),
            }
        }
    }
    Ok(file.to_string())
}

/// Whether a time in the tables of start values is a date.
pub(super) fn has_dates(text: &str) -> bool {
    fn within(table: &dyn TableLike) -> bool {
        table.iter().any(|(key, item)| match item.as_table_like() {
            Some(table) => within(table),
            None => epoch::is_time(key) && item.as_str().is_some_and(dates::looks_like_date),
        })
    }
    let file: Option<DocumentMut> = text.strip_prefix('\u{feff}').unwrap_or(text).parse().ok();
    let tables =
        file.iter().flat_map(|file| [START, FIXED].into_iter().filter_map(move |name| file.get(name)));
    tables.filter_map(Item::as_table_like).any(within)
}

fn table<'t>(within: &'t mut dyn TableLike, key: &str) -> Result<&'t mut dyn TableLike, String> {
    let item = within.entry(key).or_insert_with(|| Item::Table(Table::new()));
    let found = item.type_name();
    item.as_table_like_mut().ok_or_else(|| format!("{key}: found {found}, allowed: a table"))
}

/// The value as a file would have it: in SI, or with its unit as it was written.
fn checked(description: &Description, assigned: &Assigned<'_>) -> Result<Value, value::Misfit> {
    let Assigned { variable, value, written } = assigned;
    if !matches!(variable.causality, Causality::Parameter | Causality::Input) {
        let found = format!("the {} {}", variable.causality, variable.name);
        return Err(value::Misfit::new(found, "a parameter or an input"));
    }
    value::check(description, variable, value)
        .map_err(|misfit| value::Misfit { found: (*written).to_owned(), ..misfit })?;
    let item = |number: i32| value::items(description, variable).iter().find(|item| item.value == number);
    Ok(match (value, &variable.kind) {
        (value::Value::Integer(number), VariableKind::Enumeration { .. }) => match item(*number) {
            Some(item) => item.name.as_str().into(),
            None => i64::from(*number).into(),
        },
        (value::Value::Real(number), _)
            if written.ends_with(|last: char| last.is_ascii_digit() || last == '.') =>
        {
            (*number).into()
        }
        (value::Value::Real(_), _) => (*written).into(),
        (value::Value::Integer(number), _) => i64::from(*number).into(),
        (value::Value::Boolean(truth), _) => (*truth).into(),
        (value::Value::Text(text), _) => text.as_str().into(),
    })
}

#[cfg(test)]
mod tests;

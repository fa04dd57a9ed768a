//! The tables `[start]` and `[fixed]`: start values and constants by the names of models' variables, which are not known here.

use std::collections::BTreeMap;

use serde::Deserialize;

use crate::toml::{Place, type_schema};

/// A start value of a model's variable, as the file gives it.
#[derive(Clone, Debug, PartialEq)]
pub struct StartEntry {
    /// The key with its tables, for messages.
    pub key: String,
    /// Line from 1.
    pub line: usize,
    /// The table within the table that it stands in: the model that it is for.
    pub model: Option<String>,
    /// Whether it stands in `[fixed]`: the variable is a constant of the FMU then.
    pub is_fixed: bool,
    /// The variable.
    pub name: String,
    /// Its value.
    pub value: StartValue,
}

/// A value of any type that a file has.
// A whole number is tried before a number.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(untagged)]
pub enum StartValue {
    /// A whole number.
    Integer(i64),
    /// A number with a point or an exponent.
    Real(f64),
    /// True or false.
    Boolean(bool),
    /// A string.
    Text(String),
    /// A list.
    List(Vec<Self>),
}

/// Start values of parameters and inputs of the models: `"name" = value`, or the same in a table with a model's name.
#[derive(Debug, Default, Deserialize)]
#[serde(transparent)]
pub(crate) struct StartTable(BTreeMap<String, Item>);

/// Entry of a name: a value, or a list or table that contains names.
#[derive(Debug, Deserialize)]
#[serde(untagged)]
enum Item {
    Value(StartValue),
    List(Vec<Item>),
    Table(BTreeMap<String, Item>),
}

/// The entries of both tables, the constants last; what cannot be the value of any variable is reported.
pub(crate) fn start_entries(
    root: &Place<'_>,
    start: Option<&StartTable>,
    fixed: Option<&StartTable>,
) -> Vec<StartEntry> {
    let mut found = Vec::new();
    for (table_name, table) in [("start", start), ("fixed", fixed)] {
        for (key, item) in table.into_iter().flat_map(|table| &table.0) {
            let place = root.key(table_name).key(key);
            let items = match item {
                Item::Table(items) => items
                    .iter()
                    .map(|(name, item)| (place.key(name), Some(key.clone()), name, item))
                    .collect(),
                item => vec![(place, None, key, item)],
            };
            for (at, model, name, item) in items {
                let Some(value) = value(&at, item) else { continue };
                let (key, line, is_fixed) = (at.to_string(), at.line(), table_name == "fixed");
                found.push(StartEntry { key, line, model, is_fixed, name: name.clone(), value });
            }
        }
    }
    found
}

fn value(at: &Place<'_>, item: &Item) -> Option<StartValue> {
    match item {
        Item::Value(value) => Some(value.clone()),
        Item::List(items) => {
            let values: Vec<_> = at.items(items).map(|(at, item)| value(&at, item)).collect();
            values.into_iter().collect::<Option<_>>().map(StartValue::List)
        }
        Item::Table(_) => {
            let allowed = "a number, a string, true or false, a list; the name of a variable stands in quotes as a whole";
            at.report("a table", allowed);
            None
        }
    }
}

type_schema!([] StartTable, inline: false, "StartTable", |_| {
    let scalar = || schemars::json_schema!({ "type": ["number", "string", "boolean"] });
    let row = schemars::json_schema!({ "type": "array", "items": scalar() });
    let list = schemars::json_schema!({ "type": "array", "items": { "anyOf": [scalar(), row] } });
    let by_model = schemars::json_schema!({
        "description": "For the model of this name alone.",
        "type": "object",
        "additionalProperties": { "anyOf": [scalar(), list] }
    });
    schemars::json_schema!({
        "description": "Start values of the models' parameters and inputs by name, in quotes: SI numbers, strings with a \
            unit (\"10 deg\"), true or false, names of items; a list for a vector under its bare name. A table with a \
            model's name holds those for this model alone.",
        "type": "object",
        "additionalProperties": { "anyOf": [scalar(), list, by_model] }
    })
});

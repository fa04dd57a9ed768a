//! Values in a mission file, kept as they are written; each becomes the text that `--set` would take.

use core::fmt;
use std::collections::BTreeMap;

use serde::Deserialize;

/// What stands behind a key.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(untagged)]
pub(crate) enum Written {
    /// A whole number, which may be an option's.
    Integer(i64),
    /// A number.
    Number(f64),
    /// True or false.
    Boolean(bool),
    /// A string: a number with a unit, an option's name, a date.
    Text(String),
    /// A list.
    List(Vec<Self>),
    /// A table.
    Table(BTreeMap<String, Self>),
}

impl Written {
    /// What `--set name=` would take: a vector with commas; `None` for a table.
    pub(crate) fn setting(&self) -> Option<String> {
        Some(match self {
            Self::Number(number) => number.to_string(),
            Self::Integer(number) => number.to_string(),
            Self::Boolean(truth) => truth.to_string(),
            Self::Text(text) => text.clone(),
            Self::List(items) => items.iter().map(Self::setting).collect::<Option<Vec<_>>>()?.join(","),
            Self::Table(_) => return None,
        })
    }
}

impl fmt::Display for Written {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(number) => write!(f, "{number}"),
            Self::Integer(number) => write!(f, "{number}"),
            Self::Boolean(truth) => write!(f, "{truth}"),
            Self::Text(text) => write!(f, "{text:?}"),
            Self::List(items) => {
                let items: Vec<String> = items.iter().map(Self::to_string).collect();
                write!(f, "[{}]", items.join(", "))
            }
            Self::Table(_) => f.write_str("a table"),
        }
    }
}

#[cfg(feature = "schema")]
impl schemars::JsonSchema for Written {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "Value".into()
    }

    fn json_schema(_: &mut schemars::SchemaGenerator) -> schemars::Schema {
        schemars::json_schema!({
            "description": "An SI number, a string with a unit (\"10 deg\"), an option's name, true or false; a list for a vector.",
            "type": ["number", "string", "boolean", "array"]
        })
    }
}

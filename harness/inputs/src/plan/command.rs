//! Command of an activity, with the keys of a timeline.

use std::path::Path;

use physics::toml::Place;
use serde::Deserialize;

use crate::reading::{Checked, Written};

/// Table with the keys of a command in a timeline; its value is its text, a line a key.
#[derive(Clone, Debug, Deserialize)]
#[serde(transparent)]
pub struct CommandKey(Written);

impl Checked for CommandKey {
    fn check(&mut self, at: &Place<'_>, _: &Path) {
        let Written::Table(table) = &self.0 else {
            at.report(&self.0, "a table with the keys of a command in a timeline");
            return;
        };
        for clock in ["at", "until"].into_iter().filter(|clock| table.contains_key(*clock)) {
            at.key(clock).report("it", "start and stop of the activity alone");
        }
    }
}

impl physics::toml::Written for CommandKey {
    type Value = String;

    fn value(&self) -> String {
        let Written::Table(table) = &self.0 else { return String::new() };
        table.iter().map(|(name, value)| format!("{name} = {}\n", inline(value))).collect()
    }
}

/// Writes a value as TOML in one line.
fn inline(written: &Written) -> String {
    match written {
        Written::Integer(_) | Written::Boolean(_) => written.to_string(),
        Written::Number(number) => format!("{number:?}"),
        Written::Text(text) => toml_edit::Value::from(text.as_str()).to_string(),
        Written::List(items) => format!("[{}]", items.iter().map(inline).collect::<Vec<_>>().join(", ")),
        Written::Table(table) => {
            let entries = table.iter().map(|(name, value)| format!("{name} = {}", inline(value)));
            format!("{{ {} }}", entries.collect::<Vec<_>>().join(", "))
        }
    }
}

impl schemars::JsonSchema for CommandKey {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "Command".into()
    }

    fn json_schema(_: &mut schemars::SchemaGenerator) -> schemars::Schema {
        schemars::json_schema!({ "description": "The keys of a command in a timeline.", "type": "object" })
    }
}

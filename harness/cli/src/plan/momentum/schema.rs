//! JSON Schema of the plan file, made from the very types that read it.

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use std::borrow::Cow;

/// A number with or without a unit, or a date.
pub(super) struct Number;

impl JsonSchema for Number {
    fn schema_name() -> Cow<'static, str> {
        "Number".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "description": "An SI number, a string with a unit (\"3 d\"), or a date.", "type": ["number", "string"] })
    }
}

/// A table.
pub(super) struct Table;

impl JsonSchema for Table {
    fn schema_name() -> Cow<'static, str> {
        "Command".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "description": "The keys of a command in a timeline.", "type": "object" })
    }
}

#[cfg(test)]
mod tests {
    //! The committed schema is the one that the types give; `cargo xtask bless schema` writes it anew.

    use std::{fs, path::Path};

    use crate::plan::momentum::description::Description;

    #[test]
    fn the_schema_of_the_plan_is_in_step() {
        let requested = format!("{:#}", schemars::schema_for!(Description).as_value());
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fmu-src/resources/plan.schema.json");
        if std::env::var_os("HELIOTORQUE_BLESS").is_some() {
            fs::write(&path, &requested).unwrap();
        }
        let found = fs::read_to_string(&path).unwrap();
        assert!(found == requested, "{} is out of step: cargo xtask bless schema", path.display());
    }
}

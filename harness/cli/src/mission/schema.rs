//! JSON Schema of the mission file, made from the very types that read it.

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use std::borrow::Cow;

macro_rules! written {
    ($(#[$doc:meta])* $name:ident, $schema:tt) => {
        $(#[$doc])*
        pub(super) struct $name;

        impl JsonSchema for $name {
            fn schema_name() -> Cow<'static, str> {
                stringify!($name).into()
            }

            fn json_schema(_: &mut SchemaGenerator) -> Schema {
                json_schema!($schema)
            }
        }
    };
}

written!(
    /// A time.
    Time,
    { "description": "A number in s, a string with a unit (\"10 d\") or a date.", "type": ["number", "string"] }
);
written!(
    /// A number with or without a unit.
    Number,
    { "description": "An SI number, or a string with a unit.", "type": ["number", "string"] }
);
written!(
    /// A file or a table.
    Inputs,
    { "description": "A CSV file, or inputs by name.", "type": ["string", "object"] }
);

#[cfg(test)]
mod tests {
    //! The committed schema is the one that the types give; `cargo xtask bless schema` writes it anew.

    use std::{fs, path::Path};

    use crate::mission::description::Description;

    #[test]
    fn the_schema_of_the_mission_is_in_step() {
        let requested = format!("{:#}", schemars::schema_for!(Description).as_value());
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fmu-src/resources/mission.schema.json");
        if std::env::var_os("HELIOTORQUE_BLESS").is_some() {
            fs::write(&path, &requested).unwrap();
        }
        let found = fs::read_to_string(&path).unwrap();
        assert!(found == requested, "{} is out of step: cargo xtask bless schema", path.display());
    }
}

//! Schemas of values that files write in more than one way, and the test that a committed schema is that of its types.

/// A type that stands for such a value, with the schema of it.
macro_rules! written {
    ($(#[$doc:meta])* $name:ident, $schema:tt) => {
        $(#[$doc])*
        #[derive(Debug)]
        pub struct $name;

        impl schemars::JsonSchema for $name {
            fn schema_name() -> std::borrow::Cow<'static, str> {
                stringify!($name).into()
            }

            fn json_schema(_: &mut schemars::SchemaGenerator) -> schemars::Schema {
                schemars::json_schema!($schema)
            }
        }
    };
}
pub(crate) use written;

/// Whether `fmu-src/resources` holds this schema under a name; `cargo xtask bless schema` writes it anew.
#[cfg(test)]
pub(crate) fn assert_in_step(name: &str, schema: &schemars::Schema) {
    let requested = format!("{:#}", schema.as_value());
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fmu-src/resources").join(name);
    if std::env::var_os("HELIOTORQUE_BLESS").is_some() {
        std::fs::write(&path, &requested).unwrap();
    }
    let found = std::fs::read_to_string(&path).unwrap();
    assert!(found == requested, "{} is out of step: cargo xtask bless schema", path.display());
}

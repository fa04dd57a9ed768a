//! JSON Schema of the ephemeris file, made from the very types that read it.

use super::description::EphemerisDescription;

/// The schema as indented JSON text (draft 2020-12): point an editor with TOML support at it.
pub fn schema() -> String {
    format!("{:#}", schemars::schema_for!(EphemerisDescription).as_value())
}

//! JSON Schema of the mission file, made from the very types that read it.

use crate::schema::written;

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
    //! The committed schema is the one that the types give.
    use crate::{mission::description::MissionDescription, schema::assert_in_step};

    #[test]
    fn the_schema_of_the_mission_is_in_step() {
        assert_in_step("mission.schema.json", &schemars::schema_for!(MissionDescription));
    }
}

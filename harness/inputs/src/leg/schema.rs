//! JSON Schema of the leg file, made from the very types that read it.

use crate::schema::written;

written!(
    /// A number with or without a unit, or a date.
    Number,
    { "description": "An SI number, a string with a unit (\"200 km\"), or a date.", "type": ["number", "string"] }
);
written!(
    /// Three numbers with or without a unit.
    Vector,
    {
        "description": "Three SI numbers or strings with a unit, along the axes of EME2000.",
        "type": "array",
        "items": { "type": ["number", "string"] },
        "minItems": 3,
        "maxItems": 3
    }
);

#[cfg(test)]
mod tests {
    //! The committed schema is the one that the types give.
    use crate::leg::description::LegDescription;
    use crate::schema::assert_in_step;

    #[test]
    fn the_schema_of_the_leg_is_in_step() {
        assert_in_step("leg.schema.json", &schemars::schema_for!(LegDescription));
    }
}

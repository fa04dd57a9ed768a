//! JSON Schema of the plan file, made from the very types that read it.

use crate::schema::written;

written!(
    /// A number with or without a unit, or a date.
    Number,
    { "description": "An SI number, a string with a unit (\"3 d\"), or a date.", "type": ["number", "string"] }
);
written!(
    /// A table.
    Command,
    { "description": "The keys of a command in a timeline.", "type": "object" }
);

#[cfg(test)]
mod tests {
    //! The committed schema is the one that the types give.
    use crate::plan::description::MomentumPlanDescription;
    use crate::schema::assert_in_step;

    #[test]
    fn the_schema_of_the_plan_is_in_step() {
        assert_in_step("plan.schema.json", &schemars::schema_for!(MomentumPlanDescription));
    }
}

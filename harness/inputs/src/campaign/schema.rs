//! JSON Schema of the campaign file, made from the very types that read it.

use crate::schema::written;

written!(
    /// A number with or without a unit.
    Number,
    { "description": "An SI number or a string with a unit (\"10 d\").", "type": ["number", "string"] }
);
written!(
    /// Values of a variable.
    List,
    {
        "description": "SI numbers, strings with a unit, dates, options' names, or true and false.",
        "type": "array",
        "items": { "type": ["number", "string", "boolean"] },
        "minItems": 1
    }
);
written!(
    /// Two names and a coefficient.
    Correlation,
    {
        "description": "Two names of normal variables and their coefficient: [\"a\", \"b\", 0.5].",
        "type": "array",
        "prefixItems": [{ "type": "string" }, { "type": "string" }, { "type": "number" }],
        "minItems": 3,
        "maxItems": 3
    }
);

#[cfg(test)]
mod tests {
    //! The committed schema is the one that the types give.
    use crate::{campaign::description::CampaignDescription, schema::assert_in_step};

    #[test]
    fn the_schema_of_the_campaign_is_in_step() {
        assert_in_step("campaign.schema.json", &schemars::schema_for!(CampaignDescription));
    }
}

//! Rules on keys of one table that depend on one another, which checker and schema share.

/// Demand on a table's keys. A misspelt key counts as written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Demand {
    /// The key needs one of the others.
    Requires,
    /// The key, a number, needs one of the others if it is above 0.
    RequiresIfPositive,
    /// The key excludes all others; reported at the key.
    Excludes,
    /// The key excludes all others; reported at the table.
    Either,
    /// The table needs one of the keys.
    AnyOf,
}

/// Demand with the keys that it applies to and the words of its refusal.
#[derive(Clone, Copy, Debug)]
pub struct Rule {
    /// Kind of the demand.
    pub demand: Demand,
    /// Key that makes the demand; all keys of [`Demand::AnyOf`].
    pub keys: &'static [&'static str],
    /// Keys that it needs or excludes.
    pub others: &'static [&'static str],
    /// Refused combination.
    pub found: &'static str,
    /// Allowed combinations.
    pub allowed: &'static str,
}

/// Returns the rules as a list of schemas that all apply.
#[cfg(feature = "schema")]
pub fn schema(rules: &[Rule]) -> Vec<schemars::Schema> {
    use schemars::json_schema;
    let any =
        |keys: &[&str]| -> Vec<_> { keys.iter().map(|key| json_schema!({ "required": [key] })).collect() };
    rules
        .iter()
        .map(|rule| match (rule.demand, rule.keys) {
            (Demand::AnyOf, keys) => json_schema!({ "anyOf": any(keys) }),
            (Demand::RequiresIfPositive, keys) => {
                let key = keys.concat();
                let above =
                    std::collections::BTreeMap::from([(&key, json_schema!({ "exclusiveMinimum": 0 }))]);
                let demands = json_schema!({ "required": [&key], "properties": above });
                json_schema!({ "if": demands, "then": { "anyOf": any(rule.others) } })
            }
            (Demand::Requires, keys) => {
                json_schema!({ "if": { "required": keys }, "then": { "anyOf": any(rule.others) } })
            }
            (Demand::Excludes | Demand::Either, keys) => {
                json_schema!({ "if": { "required": keys }, "then": { "not": { "anyOf": any(rule.others) } } })
            }
        })
        .collect()
}

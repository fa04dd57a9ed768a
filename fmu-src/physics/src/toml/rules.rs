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
    /// Each key excludes the other keys and all others; reported at the table.
    Either,
    /// The table needs one of the keys.
    AnyOf,
}

/// Demand with the keys that it applies to and the words of its refusal.
#[derive(Clone, Copy, Debug)]
pub struct Rule {
    /// Kind of the demand.
    pub demand: Demand,
    /// Key that makes the demand; all keys of [`Demand::AnyOf`] and [`Demand::Either`].
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
    let needs = |demand: schemars::Schema, keys: &[&str]| json_schema!({ "if": demand, "then": { "anyOf": any(keys) } });
    let schemas = |rule: &Rule| match rule.demand {
        Demand::AnyOf => vec![json_schema!({ "anyOf": any(rule.keys) })],
        Demand::Requires => vec![needs(json_schema!({ "required": rule.keys }), rule.others)],
        Demand::RequiresIfPositive => {
            let key = rule.keys.concat();
            let above = std::collections::BTreeMap::from([(&key, json_schema!({ "exclusiveMinimum": 0 }))]);
            vec![needs(json_schema!({ "required": [&key], "properties": above }), rule.others)]
        }
        Demand::Excludes | Demand::Either => {
            let excluded = |key: &&str| -> Vec<_> {
                rule.keys.iter().chain(rule.others).filter(|it| *it != key).copied().collect()
            };
            let exclusion = |key: &&str| json_schema!({ "if": { "required": [key] }, "then": { "not": { "anyOf": any(&excluded(key)) } } });
            rule.keys.iter().map(exclusion).collect()
        }
    };
    rules.iter().flat_map(schemas).collect()
}

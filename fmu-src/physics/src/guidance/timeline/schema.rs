//! JSON Schema of the timeline file, made from the very types that read it.

use super::description::TimelineDescription;

/// The schema as indented JSON text (draft 2020-12): point an editor with TOML support at it.
pub fn schema() -> String {
    format!("{:#}", schemars::schema_for!(TimelineDescription).as_value())
}

#[cfg(test)]
mod tests {
    //! Every table is closed and every key described.

    use toml::Value;

    use super::*;

    #[test]
    fn every_table_is_closed_and_every_key_described() {
        let root = Value::try_from(schemars::schema_for!(TimelineDescription).as_value()).unwrap();
        let definitions = root["$defs"].as_table().unwrap();
        for (name, node) in definitions.iter().chain([(&"timeline".to_owned(), &root)]) {
            let Some(properties) = node.get("properties").and_then(Value::as_table) else { continue };
            assert_eq!(node.get("additionalProperties"), Some(&Value::Boolean(false)), "{name}");
            for (key, property) in properties {
                let form = property.get("anyOf").map_or(property, |forms| &forms[0]);
                let of_type = form
                    .get("$ref")
                    .and_then(Value::as_str)
                    .and_then(|name| definitions[name.rsplit('/').next()?].get("description"));
                assert!(property.get("description").or(of_type).is_some(), "{name}.{key}");
            }
        }
    }
}

//! JSON Schema of the spacecraft file, made from the very types that read it.

use super::description::SpacecraftDescription;

/// The schema as indented JSON text (draft 2020-12): point an editor with TOML support at it.
pub fn schema() -> String {
    format!("{:#}", schemars::schema_for!(SpacecraftDescription).as_value())
}

#[cfg(test)]
mod tests {
    //! Every key of the shipped spacecraft stands in the schema, which allows no other keys.

    use toml::Value;

    use super::*;
    use crate::spacecraft::MESSENGER_TOML;

    /// Follows references and takes the first of several forms.
    fn resolve<'s>(root: &'s Value, node: &'s Value) -> &'s Value {
        if let Some(form) = node.get("anyOf").and_then(|forms| forms.get(0)) {
            return resolve(root, form);
        }
        match node.get("$ref").and_then(Value::as_str) {
            Some(reference) => reference.split('/').skip(1).fold(root, |at, key| &at[key]),
            None => node,
        }
    }

    fn assert_allowed(root: &Value, node: &Value, value: &Value, place: &str) {
        let node = resolve(root, node);
        match value {
            Value::Table(table) => {
                for (key, inner) in table {
                    let place = format!("{place}.{key}");
                    let named = node.get("properties").and_then(|properties| properties.get(key));
                    let allowed = named.or(node.get("additionalProperties").filter(|any| any.is_table()));
                    assert_allowed(root, allowed.expect(&place), inner, &place);
                }
            }
            Value::Array(list) => {
                for inner in list {
                    assert_allowed(root, &node["items"], inner, place);
                }
            }
            _ => {}
        }
    }

    #[test]
    fn the_shipped_file_uses_known_keys_only() {
        let root = Value::try_from(schemars::schema_for!(SpacecraftDescription).as_value()).unwrap();
        assert_allowed(&root, &root, &toml::from_str(MESSENGER_TOML).unwrap(), "");
    }

    #[test]
    fn every_table_is_closed_and_every_key_described() {
        let root = Value::try_from(schemars::schema_for!(SpacecraftDescription).as_value()).unwrap();
        let definitions = root["$defs"].as_table().unwrap();
        for (name, node) in definitions.iter().chain([(&"spacecraft".to_owned(), &root)]) {
            let Some(properties) = node.get("properties").and_then(Value::as_table) else { continue };
            assert_eq!(node.get("additionalProperties"), Some(&Value::Boolean(false)), "{name}");
            for (key, property) in properties {
                let described = property.get("description").or(resolve(&root, property).get("description"));
                assert!(described.is_some(), "{name}.{key}");
            }
        }
    }
}

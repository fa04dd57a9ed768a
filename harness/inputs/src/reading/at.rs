//! Values with their keys and lines, and tables whose keys are names.

use std::{borrow::Cow, collections::BTreeMap, path::Path};

use physics::toml::Place;
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::Deserialize;

use super::tables::Checked;

/// A value with its key and line.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(transparent)]
pub struct At<T> {
    /// Value.
    pub it: T,
    /// The key with its tables.
    #[serde(skip)]
    pub key: String,
    /// Line from 1.
    #[serde(skip)]
    pub line: usize,
    /// Whether the file has the key.
    #[serde(skip)]
    pub is_written: bool,
}

impl<T> At<T> {
    /// Its place in a file.
    pub fn place(&self, file: &Path) -> String {
        format!("{}:{}: {}", file.display(), self.line, self.key)
    }

    /// A problem at its place.
    pub fn problem(&self, file: &Path, what: &str) -> String {
        format!("{}: {what}", self.place(file))
    }

    /// Another value at the same place.
    pub fn with<U>(&self, it: U) -> At<U> {
        At { it, key: self.key.clone(), line: self.line, is_written: self.is_written }
    }
}

impl<T: Checked> Checked for At<T> {
    fn check(&mut self, at: &Place<'_>, folder: &Path) {
        (self.key, self.line, self.is_written) = (at.to_string(), at.line(), at.is_written());
        self.it.check(at, folder);
    }
}

impl<T: physics::toml::Written> physics::toml::Written for At<T> {
    type Value = At<T::Value>;

    fn value(&self) -> Self::Value {
        self.with(self.it.value())
    }
}

macro_rules! from_default {
    ($($type:ty),+) => {$(
        impl<T: From<$type>> From<$type> for At<T> {
            fn from(written: $type) -> Self {
                Self { it: written.into(), key: String::new(), line: 0, is_written: false }
            }
        }
    )+};
}

from_default!(&'static str, f64, i32);

impl<T: JsonSchema> JsonSchema for At<T> {
    fn inline_schema() -> bool {
        T::inline_schema()
    }

    fn schema_name() -> Cow<'static, str> {
        T::schema_name()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        T::json_schema(generator)
    }
}

/// Values by names of variables, which stand in quotes.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(transparent)]
#[schemars(inline)]
pub(crate) struct Named<T>(pub BTreeMap<String, At<T>>);

impl<T: Checked> Checked for Named<T> {
    fn check(&mut self, at: &Place<'_>, folder: &Path) {
        self.0.iter_mut().for_each(|(name, it)| it.check(&at.key(name), folder));
    }
}

impl<T: physics::toml::Written> physics::toml::Written for Named<T> {
    type Value = Vec<At<(String, T::Value)>>;

    fn value(&self) -> Self::Value {
        self.0.iter().map(|(name, at)| at.with((name.clone(), at.it.value()))).collect()
    }
}

//! Tables of a file as structs, which reader, checker and schema share.

use serde::{Deserialize, Serialize};

/// Structs that read a table each: they refuse unknown keys and have a schema. A key with a default, `key: Type = value`, may
/// be left out; the method of its name gives what counts.
macro_rules! tables {
    ($($(#[$about:meta])* struct $table:ident {
        $($(#[$key_about:meta])* $key:ident: $type:ty $(= $default:expr)?,)+
    })+) => {$(
        #[derive(Debug, serde::Deserialize)]
        #[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
        #[serde(deny_unknown_fields)]
        $(#[$about])*
        pub(crate) struct $table {
            $(
                $(#[$key_about])*
                $(#[cfg_attr(feature = "schema", schemars(extend("default" = $default)))])?
                pub $key: $crate::toml::tables::tables!(@read $type $(, $default)?),
            )+
        }

        impl $table {$($(
            #[doc = concat!("`", stringify!($key), "`, or its default.")]
            pub(crate) fn $key(&self) -> <$type as $crate::toml::tables::Written>::Value {
                self.$key.map_or($default, $crate::toml::tables::Written::value)
            }
        )?)+}
    )+};
    (@read $type:ty) => { $type };
    (@read $type:ty, $default:expr) => { Option<$type> };
}

pub(crate) use tables;

/// What stands in a file for a plain value.
pub trait Written: Copy {
    /// The plain value.
    type Value;

    /// Without what the file says of it.
    fn value(self) -> Self::Value;
}

/// What is written as it counts.
macro_rules! plain {
    ($($type:ty),+) => {$(
        impl $crate::toml::tables::Written for $type {
            type Value = Self;

            fn value(self) -> Self {
                self
            }
        }
    )+};
}

pub(crate) use plain;

plain!(bool, i64, f64, [f64; 2], [f64; 3]);

/// A list that is not empty.
#[derive(Clone, Debug, Deserialize, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(inline))]
pub struct NonEmpty<T>(#[cfg_attr(feature = "schema", schemars(length(min = 1)))] Vec<T>);

impl<T> core::ops::Deref for NonEmpty<T> {
    type Target = [T];

    fn deref(&self) -> &[T] {
        &self.0
    }
}

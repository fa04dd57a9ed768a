//! Tables of a file as structs: one declaration of their keys serves reader, checker, schema and guide.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::rules::Rule;
use super::written::Written;

/// Declares structs that read a table each: they refuse unknown keys and have a schema.
///
/// A key with a default, `key: Type = value`, may be left out; the method of its name returns the value that applies. The value of
/// `key as name: Type` is returned by the method `name`, in SI units (an angle in rad of a key in deg). `called "wheel"` numbers the
/// parts that the file gives no name ([`Named`]). `rules` follow a table whose keys depend on one another (see
/// [`Demand`](super::rules::Demand)): `Requires key => others: "found", "allowed";`.
#[macro_export]
macro_rules! tables {
    ($($(#[$about:meta])* struct $table:ident $(called $kind:literal)? {
        $($(#[$key_about:meta])* $key:ident $(as $name:ident)?: $type:ty $(= $default:expr)?,)+
    } $(rules {$(
        $demand:ident $($subject:ident)+ $(=> $($other:ident)+)?: $found:literal, $allowed:literal;
    )+})?)+) => {$(
        #[derive(Debug, serde::Deserialize)]
        #[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
        $(#[cfg_attr(feature = "schema", schemars(extend("allOf" = $crate::toml::rules::schema(&[
            $($crate::tables!(@rule $demand $($subject)+ $(=> $($other)+)?: $found, $allowed)),+
        ]))))])?
        #[serde(deny_unknown_fields)]
        $(#[$about])*
        pub(crate) struct $table {
            $(
                $(#[$key_about])*
                $(#[cfg_attr(feature = "schema", schemars(extend("default" = $default)))])?
                pub $key: $crate::tables!(@read $type $(, $default)?),
            )+
        }

        impl $table {$(
            $crate::tables!(@value $key [$($name)?] [$($default)?] $type);
        )+}

        impl $crate::toml::tables::Table for $table {
            const RULES: &'static [$crate::toml::rules::Rule] = &[$(
                $($crate::tables!(@rule $demand $($subject)+ $(=> $($other)+)?: $found, $allowed)),+
            )?];
        }

        $(impl $crate::toml::tables::Named for $table {
            const KIND: &'static str = $kind;

            fn name(&self) -> Option<&str> {
                $crate::toml::tables::PartName::given(&self.name)
            }
        })?
    )+};
    (@rule $demand:ident $($subject:ident)+ $(=> $($other:ident)+)?: $found:literal, $allowed:literal) => {
        $crate::toml::rules::Rule {
            demand: $crate::toml::rules::Demand::$demand,
            keys: &[$(stringify!($subject)),+],
            others: &[$($(stringify!($other)),+)?],
            found: $found,
            allowed: $allowed,
        }
    };
    (@read $type:ty) => { $type };
    (@read $type:ty, $default:expr) => { Option<$type> };
    (@value $key:ident [] [] $type:ty) => {};
    (@value $key:ident [] [$default:expr] $type:ty) => { $crate::tables!(@value $key [$key] [$default] $type); };
    (@value $key:ident [$name:ident] [] $type:ty) => {
        #[doc = concat!("Value of `", stringify!($key), "`.")]
        pub(crate) fn $name(&self) -> <$type as $crate::toml::written::Written>::Value {
            $crate::toml::written::Written::value(self.$key)
        }
    };
    (@value $key:ident [$name:ident] [$default:expr] $type:ty) => {
        #[doc = concat!("Value of `", stringify!($key), "`, or its default.")]
        pub(crate) fn $name(&self) -> <$type as $crate::toml::written::Written>::Value {
            let written = self.$key.unwrap_or_else(|| $crate::toml::written::Written::from_plain($default));
            $crate::toml::written::Written::value(written)
        }
    };
}

/// Table of a file with its rules.
pub trait Table {
    /// Rules on keys that depend on one another.
    const RULES: &'static [Rule];
}

/// Part that has a name, or the word for its kind and its number from 1.
pub trait Named {
    /// Word for such a part.
    const KIND: &'static str;

    /// Returns the name that the file gives.
    fn name(&self) -> Option<&str>;

    /// Returns the part's name, or its kind and number.
    fn called(&self, index: usize) -> String {
        self.name().map_or_else(|| format!("{} {}", Self::KIND, index + 1), str::to_owned)
    }
}

/// Key `name` of a part: a text that may be optional.
pub trait PartName {
    /// Returns the name if it is written.
    fn given(&self) -> Option<&str>;
}

impl PartName for String {
    fn given(&self) -> Option<&str> {
        Some(self)
    }
}

impl PartName for Option<String> {
    fn given(&self) -> Option<&str> {
        self.as_deref()
    }
}

/// Types of three numbers that the reader checks, as it does those of [`super::ranges`].
macro_rules! vectors {
    ($($(#[$about:meta])* $name:ident($inner:ty) = |$written:ident| $value:expr, $format:literal;)+) => {$(
        $(#[$about])*
        #[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
        pub struct $name(pub $inner);

        impl Written for $name {
            type Plain = [f64; 3];
            type Value = Vector3<f64>;

            fn from_plain(plain: [f64; 3]) -> Self {
                Self(Written::from_plain(plain))
            }

            fn value(self) -> Vector3<f64> {
                let $written = self.0;
                $value
            }
        }

        #[cfg(feature = "schema")]
        impl schemars::JsonSchema for $name {
            fn inline_schema() -> bool {
                true
            }

            fn schema_name() -> std::borrow::Cow<'static, str> {
                stringify!($name).into()
            }

            fn json_schema(generator: &mut schemars::SchemaGenerator) -> schemars::Schema {
                let mut schema = <[f64; 3]>::json_schema(generator);
                if !$format.is_empty() {
                    schema.insert("format".to_owned(), $format.into());
                }
                schema
            }
        }
    )+};
}

vectors! {
    /// Three finite numbers: a position or another vector.
    Point([super::ranges::Finite; 3]) = |written| Vector3::from(written.map(f64::from)), "";
    /// Direction: refused when its length is off 1 by more than 1e-3, renormalised otherwise.
    UnitVector([f64; 3]) = |written| super::directions::unit(written).unwrap_or_else(Vector3::x), "unit vector";
}

/// List of at least `LEAST` and at most `MOST` items.
#[derive(Clone, Debug, Deserialize, Serialize)]
#[serde(transparent)]
pub struct List<T, const LEAST: usize, const MOST: usize = { usize::MAX }>(Vec<T>);

/// List that is not empty.
pub type NonEmpty<T> = List<T, 1>;

impl<T, const LEAST: usize, const MOST: usize> core::ops::Deref for List<T, LEAST, MOST> {
    type Target = [T];

    fn deref(&self) -> &[T] {
        &self.0
    }
}

#[cfg(feature = "schema")]
impl<T: schemars::JsonSchema, const LEAST: usize, const MOST: usize> schemars::JsonSchema
    for List<T, LEAST, MOST>
{
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> std::borrow::Cow<'static, str> {
        format!("List_of_{}", T::schema_name()).into()
    }

    fn json_schema(generator: &mut schemars::SchemaGenerator) -> schemars::Schema {
        let mut schema = Vec::<T>::json_schema(generator);
        schema.insert("minItems".to_owned(), LEAST.into());
        if MOST < usize::MAX {
            schema.insert("maxItems".to_owned(), MOST.into());
        }
        schema
    }
}

//! Tables of a file as structs: one declaration of their keys serves reader, checker, schema and guide.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::rules::Rule;
use super::written::Written;

/// Declares structs that read a table each: they refuse unknown keys and have a schema.
///
/// A key with a default, `key: Type = value`, may be left out, as may one whose value then follows from others,
/// `key: Type => |table| value`. `called "wheel"` numbers the parts that the file gives no name ([`Named`]). `makes pub struct Wheel` declares the
/// struct of the values in SI units (an angle in rad of a key in deg), which `made` returns: a field for each key, called as the key or, in
/// `key as name: Type`, by the name; `or Default` lets the whole table be left out. In other tables keys with a default or a name have a method that returns the value. `rules` follow
/// a table whose keys depend on one another (see [`Demand`](super::rules::Demand)): `Requires key => others: "found", "allowed";`.
#[macro_export]
macro_rules! tables {
    ($($(#[$about:meta])* struct $table:ident $(called $kind:literal)? $(makes $(#[$made_about:meta])* $seen:vis struct $made:ident $(or $default_value:ident)?)? {
        $($(#[$key_about:meta])* $key:ident $(as $name:ident)?: $type:ty $(= $default:expr)? $(=> $follows:expr)?,)+
    } $(rules {$(
        $demand:ident $($subject:ident)+ $(=> $($other:ident)+)?: $found:literal, $allowed:literal;
    )+})?)+) => {$(
        #[derive(Debug, serde::Deserialize)]
        #[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
        $(#[cfg_attr(feature = "schema", schemars(extend("allOf" = $crate::toml::rules::schema(&[
            $($crate::tables!(@rule $demand $($subject)+ $(=> $($other)+)?: $found, $allowed)),+
        ]))))])?
        #[serde(deny_unknown_fields)]
        $($(#[derive($default_value)])?)?
        $(#[$about])*
        pub(crate) struct $table {
            $(
                $(#[$key_about])*
                $(#[cfg_attr(feature = "schema", schemars(extend("default" = $default)))])?
                pub $key: $crate::tables!(@read $type $(, $default)? $(, $follows)?),
            )+
        }

        $crate::tables! { @values [$($(#[$made_about])* $seen $made)?] [$(#[$about])*] $table {
            $($(#[$key_about])* [$($name)? $key] $key [$type] [$($default)?] [$($follows)?],)+
        } }

        impl $crate::toml::tables::Table for $table {
            const RULES: &'static [$crate::toml::rules::Rule] = &[$(
                $($crate::tables!(@rule $demand $($subject)+ $(=> $($other)+)?: $found, $allowed)),+
            )?];
        }

        $(impl $crate::toml::tables::Named for $table {
            const KIND: &'static str = $kind;

            fn name(&self) -> Option<&str> {
                Option::<&String>::from(&self.name).map(String::as_str)
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
    (@read $type:ty, $else:expr) => { Option<$type> };
    (@values [] [$(#[$about:meta])*] $table:ident {$(
        $(#[$key_about:meta])* [$($name:ident)+] $key:ident [$type:ty] [$($default:expr)?] [$($follows:expr)?],
    )+}) => {
        impl $table {$(
            $crate::tables!(@method [$($name)+] $key [$type] [$($default)?]);
        )+}
    };
    (@values [$(#[$made_about:meta])* $seen:vis $made:ident] [$(#[$about:meta])*] $table:ident {$(
        $(#[$key_about:meta])* [$name:ident $($same:ident)?] $key:ident [$type:ty] [$($default:expr)?] [$($follows:expr)?],
    )+}) => {
        $(#[$about])*
        $(#[$made_about])*
        $seen struct $made {$(
            $(#[$key_about])*
            #[doc = concat!("\n\nValue of `", stringify!($key), "`, in the unit that the field names.")]
            pub $name: $crate::tables!(@type $key $type),
        )+}

        impl $table {
            /// Returns the values, the name of a part without one by its index in its list.
            pub(crate) fn made(&self, index: usize) -> $made {
                let part = (self, index);
                $made {$(
                    $name: $crate::tables!(@made part $table $key [$type] [$($default)?] [$($follows)?])
                ),+}
            }
        }

        impl $crate::toml::written::Written for $table {
            type Value = $made;

            fn value(&self) -> $made {
                self.made(0)
            }
        }
    };
    (@type name $type:ty) => { String };
    (@type $key:ident $type:ty) => { <$type as $crate::toml::written::Written>::Value };
    (@method [$key:ident] $same:ident [$type:ty] []) => {};
    (@method [$name:ident $($same:ident)?] $key:ident [$type:ty] [$($default:expr)?]) => {
        #[doc = concat!("Value of `", stringify!($key), "`, or its default.")]
        pub(crate) fn $name(&self) -> <$type as $crate::toml::written::Written>::Value {
            $crate::tables!(@value $type, self.$key $(, $default)?)
        }
    };
    (@made $part:ident $table:ident name [$type:ty] [] []) => {
        $crate::toml::tables::Named::called($part.0, $part.1)
    };
    (@made $part:ident $table:ident $key:ident [$type:ty] [$($default:expr)?] []) => {
        $crate::tables!(@value $type, $part.0.$key $(, $default)?)
    };
    (@made $part:ident $table:ident $key:ident [$type:ty] [] [$follows:expr]) => {{
        let follows: fn(&$table) -> _ = $follows;
        $part.0.$key.as_ref().map_or_else(|| follows($part.0), <$type as $crate::toml::written::Written>::value)
    }};
    (@value $type:ty, $written:expr) => { <$type as $crate::toml::written::Written>::value(&$written) };
    (@value $type:ty, $written:expr, $default:expr) => {{
        let default = <$type>::from($default);
        $crate::toml::written::Written::value($written.as_ref().unwrap_or(&default))
    }};
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

/// Types of three numbers that the reader checks, as it does those of [`super::ranges`].
macro_rules! vectors {
    ($($(#[$about:meta])* $name:ident($inner:ty) = |$written:ident| $value:expr, $format:literal;)+) => {$(
        $(#[$about])*
        #[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
        pub struct $name(pub $inner);

        impl Written for $name {
            type Value = Vector3<f64>;

            fn value(&self) -> Vector3<f64> {
                let $written = self.0;
                $value
            }
        }

        impl From<[f64; 3]> for $name {
            fn from(numbers: [f64; 3]) -> Self {
                Self(numbers.map(Into::into))
            }
        }

        super::written::type_schema!([] $name, inline: true, stringify!($name), |generator| {
            let mut schema = <[f64; 3] as schemars::JsonSchema>::json_schema(generator);
            if !$format.is_empty() {
                schema.insert("format".to_owned(), $format.into());
            }
            schema
        });
    )+};
}

vectors! {
    /// Three finite numbers: a position or another vector.
    Point([super::ranges::Finite; 3]) = |written| Vector3::from(written.value()), "";
    /// Direction: refused when its length is off 1 by more than 1e-3, renormalised otherwise.
    UnitVector([f64; 3]) = |written| super::directions::unit(written).unwrap_or_else(Vector3::x), "unit vector";
}

/// Returns the schema of a file as indented JSON text (draft 2020-12): point an editor with TOML support at it.
#[cfg(feature = "schema")]
pub(crate) fn schema<T: schemars::JsonSchema>() -> String {
    format!("{:#}", schemars::schema_for!(T).as_value())
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

impl<T: Written, const LEAST: usize, const MOST: usize> Written for List<T, LEAST, MOST> {
    type Value = Vec<T::Value>;

    fn value(&self) -> Self::Value {
        self.0.value()
    }
}

super::written::type_schema!(
    [T: schemars::JsonSchema, const LEAST: usize, const MOST: usize] List<T, LEAST, MOST>,
    inline: true,
    format!("List_of_{}", T::schema_name()),
    |generator| {
        let mut schema = Vec::<T>::json_schema(generator);
        schema.insert("minItems".to_owned(), LEAST.into());
        if MOST < usize::MAX {
            schema.insert("maxItems".to_owned(), MOST.into());
        }
        schema
    }
);

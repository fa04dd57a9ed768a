//! Values as a file writes them, which stand for values in SI units.

/// Value as a file writes it, which stands for a value in SI units.
pub trait Written {
    /// Type of the value in SI units.
    type Value;

    /// Returns the value in SI units.
    fn value(&self) -> Self::Value;
}

/// Schema of a type, which stands where the type is used if it is inline.
macro_rules! type_schema {
    ([$($generics:tt)*] $type:ty, inline: $inline:literal, $name:expr, |$generator:pat_param| $schema:expr) => {
        #[cfg(feature = "schema")]
        impl<$($generics)*> schemars::JsonSchema for $type {
            fn inline_schema() -> bool {
                $inline
            }

            fn schema_name() -> std::borrow::Cow<'static, str> {
                $name.into()
            }

            fn json_schema($generator: &mut schemars::SchemaGenerator) -> schemars::Schema {
                $schema
            }
        }
    };
}

pub(crate) use type_schema;

/// Types that are written as they are used.
macro_rules! plain {
    ($($type:ty),+) => {$(
        impl $crate::toml::written::Written for $type {
            type Value = Self;

            fn value(&self) -> Self {
                Clone::clone(self)
            }
        }
    )+};
}

pub(crate) use plain;

plain!(bool, i64, u32, f64, String);

impl<W: Written, const N: usize> Written for [W; N] {
    type Value = [W::Value; N];

    fn value(&self) -> Self::Value {
        self.each_ref().map(W::value)
    }
}

impl<W: Written> Written for Option<W> {
    type Value = Option<W::Value>;

    fn value(&self) -> Self::Value {
        self.as_ref().map(W::value)
    }
}

impl<W: Written> Written for Vec<W> {
    type Value = Vec<W::Value>;

    fn value(&self) -> Self::Value {
        self.iter().map(W::value).collect()
    }
}

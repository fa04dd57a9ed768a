//! Names and values that a study sets.

use loader::Value;

use crate::attitude::{Attitude, Vector};

/// Names and values to be set.
pub(crate) type Settings = Vec<(String, Value)>;

/// What a variable is set to; of a vector or quaternion the elements.
pub(crate) trait Setting {
    /// The settings of what is called `name`.
    fn of(self, name: &str) -> Settings;
}

/// Sets a variable, by its item's name an Enumeration, a vector or a quaternion.
pub(crate) fn set(name: &str, value: impl Setting) -> Settings {
    value.of(name)
}

macro_rules! scalar {
    ($($type:ty: $value:expr;)+) => {$(
        impl Setting for $type {
            fn of(self, name: &str) -> Settings {
                vec![(name.to_owned(), $value(self))]
            }
        }
    )+};
}

scalar! {
    f64: Value::Real;
    i32: Value::Integer;
    bool: Value::Boolean;
    &str: |item: &str| Value::Text(item.to_owned());
}

impl<const N: usize> Setting for [f64; N] {
    fn of(self, name: &str) -> Settings {
        (1..).zip(self).map(|(i, value)| (format!("{name}[{i}]"), Value::Real(value))).collect()
    }
}

impl Setting for Vector {
    fn of(self, name: &str) -> Settings {
        <[f64; 3]>::from(self).of(name)
    }
}

impl Setting for Attitude {
    fn of(self, name: &str) -> Settings {
        <[f64; 4]>::from(self.coords).of(name)
    }
}

/// The settings of a component.
pub(crate) fn of(component: &str, settings: Settings) -> Settings {
    settings.into_iter().map(|(name, value)| (format!("{component}.{name}"), value)).collect()
}

//! Values in a file, kept as they are written; each becomes the text that `--set` would take.

use core::fmt;
use std::collections::BTreeMap;

use model_description::quantity;
use physics::environment::dates;
use serde::Deserialize;

use crate::values;

/// Value of a key.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(untagged)]
pub(crate) enum Written {
    /// A whole number, which may be an option's.
    Integer(i64),
    /// A number.
    Number(f64),
    /// True or false.
    Boolean(bool),
    /// A string: a number with a unit, an option's name, a date.
    Text(String),
    /// A list.
    List(Vec<Self>),
    /// A table.
    Table(BTreeMap<String, Self>),
}

impl Written {
    /// Returns the text for `--set name=`: a vector with commas; `None` for a table.
    pub(crate) fn setting(&self) -> Option<String> {
        Some(match self {
            Self::Number(number) => number.to_string(),
            Self::Integer(number) => number.to_string(),
            Self::Boolean(truth) => truth.to_string(),
            Self::Text(text) => text.clone(),
            Self::List(items) => items.iter().map(Self::setting).collect::<Option<Vec<_>>>()?.join(","),
            Self::Table(_) => return None,
        })
    }

    /// The same of what is neither list nor table.
    pub(crate) fn item(&self) -> Option<String> {
        self.setting().filter(|_| !matches!(self, Self::List(_)))
    }

    /// The same of a number or a text alone.
    pub(crate) fn scalar(&self) -> Option<String> {
        self.setting().filter(|_| matches!(self, Self::Number(_) | Self::Integer(_) | Self::Text(_)))
    }

    /// A text that looks like a date.
    pub(crate) fn date(&self) -> Option<&str> {
        if let Self::Text(text) = self {
            Some(text.as_str()).filter(|it| dates::looks_like_date(it))
        } else {
            None
        }
    }

    /// A number without a unit.
    pub(crate) fn number(&self) -> Option<f64> {
        match self {
            Self::Integer(number) => Some(*number as f64),
            Self::Number(number) => Some(*number),
            _ => None,
        }
    }

    /// A finite number in the SI unit of this name, or a text with a unit.
    pub(crate) fn quantity(&self, unit: &str) -> Option<f64> {
        let number = if let Self::Text(text) = self { quantity::read(text, unit) } else { self.number() };
        number.filter(|number| number.is_finite())
    }

    /// An angle in rad, which carries its unit.
    pub(crate) fn angle_rad(&self) -> Option<f64> {
        quantity::read_with_unit(&self.scalar()?, "rad")
    }

    /// A time in s.
    pub(crate) fn duration_s(&self) -> Option<f64> {
        values::duration(&self.setting()?).ok()
    }

    /// A time above 0, in s.
    pub(crate) fn span_s(&self) -> Option<f64> {
        values::span(&self.setting()?).ok()
    }
}

macro_rules! from {
    ($($type:ty => $variant:ident),+) => {$(
        impl From<$type> for Written {
            fn from(value: $type) -> Self {
                Self::$variant(value.into())
            }
        }
    )+};
}

from!(i32 => Integer, f64 => Number, &str => Text);

impl fmt::Display for Written {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Text(text) => write!(f, "{text:?}"),
            Self::List(items) => {
                let items: Vec<String> = items.iter().map(Self::to_string).collect();
                write!(f, "[{}]", items.join(", "))
            }
            other => f.write_str(&other.setting().unwrap_or_else(|| "a table".to_owned())),
        }
    }
}

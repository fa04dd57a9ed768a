//! Quantities of a timeline: SI numbers, or strings with a unit ("10 deg").

use core::fmt;

use serde::de::{Deserialize, Deserializer, IgnoredAny, MapAccess, SeqAccess, Visitor};

use crate::constants::{ASTRONOMICAL_UNIT_M, DAY_S, DEG_RAD, RPM_RAD_S};

/// What stands in the file.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Quantity {
    /// A number, SI.
    Number(f64),
    /// A string.
    Text(String),
    /// Something else, in words.
    Other(String),
}

/// A kind of quantity with the units that it can be given in, the SI unit first.
#[derive(Debug)]
pub(super) struct Kind {
    /// With its article.
    pub name: &'static str,
    /// Names and how much of the SI unit they are.
    pub units: &'static [(&'static str, f64)],
}

/// Angles.
pub(super) const ANGLE: Kind = Kind { name: "an angle", units: &[("rad", 1.0), ("deg", DEG_RAD)] };
/// Rates of rotations.
pub(super) const RATE: Kind =
    Kind { name: "a rate", units: &[("rad/s", 1.0), ("deg/s", DEG_RAD), ("rpm", RPM_RAD_S)] };
/// Lengths.
pub(super) const LENGTH: Kind = Kind {
    name: "a length",
    units: &[("m", 1.0), ("km", 1e3), ("cm", 1e-2), ("mm", 1e-3), ("AU", ASTRONOMICAL_UNIT_M)],
};
/// Speeds.
pub(super) const SPEED: Kind =
    Kind { name: "a speed", units: &[("m/s", 1.0), ("km/s", 1e3), ("mm/s", 1e-3)] };
/// Times.
pub(super) const TIME: Kind =
    Kind { name: "a time", units: &[("s", 1.0), ("ms", 1e-3), ("min", 60.0), ("h", 3600.0), ("d", DAY_S)] };

impl Quantity {
    /// The value in the SI unit; `None` where this is no quantity of this kind.
    pub fn si(&self, kind: &Kind) -> Option<f64> {
        let text = match self {
            Self::Number(number) => return Some(*number),
            Self::Text(text) => text.trim(),
            Self::Other(_) => return None,
        };
        // A unit holds no digit, a number ends in a digit or a point.
        let end = text.rfind(|c: char| c.is_ascii_digit() || c == '.')? + 1;
        let (number, unit) = text.split_at_checked(end)?;
        let number: f64 = number.parse().ok()?;
        let unit = unit.trim();
        let factor = match unit {
            "" => 1.0,
            _ => kind.units.iter().find(|(name, _)| *name == unit)?.1,
        };
        Some(number * factor)
    }
}

impl fmt::Display for Quantity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(number) => write!(f, "{number}"),
            Self::Text(text) => write!(f, "{text:?}"),
            Self::Other(words) => f.write_str(words),
        }
    }
}

impl fmt::Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [(si, _), others @ ..] = self.units else { return f.write_str(self.name) };
        let others: Vec<&str> = others.iter().map(|(name, _)| *name).collect();
        write!(f, "{}: a number in {si} or a string with a unit: {si}, {}", self.name, others.join(", "))
    }
}

impl<'de> Deserialize<'de> for Quantity {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(QuantityVisitor)
    }
}

struct QuantityVisitor;

impl<'de> Visitor<'de> for QuantityVisitor {
    type Value = Quantity;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a number or a string")
    }

    fn visit_f64<E>(self, value: f64) -> Result<Quantity, E> {
        Ok(Quantity::Number(value))
    }

    fn visit_i64<E>(self, value: i64) -> Result<Quantity, E> {
        Ok(Quantity::Number(value as f64))
    }

    fn visit_str<E>(self, value: &str) -> Result<Quantity, E> {
        Ok(Quantity::Text(value.to_owned()))
    }

    fn visit_bool<E>(self, value: bool) -> Result<Quantity, E> {
        Ok(Quantity::Other(format!("boolean `{value}`")))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Quantity, A::Error> {
        while list.next_element::<Self::Value>()?.is_some() {}
        Ok(Quantity::Other("a list".to_owned()))
    }

    fn visit_map<A: MapAccess<'de>>(self, mut table: A) -> Result<Quantity, A::Error> {
        while table.next_entry::<IgnoredAny, Self::Value>()?.is_some() {}
        Ok(Quantity::Other("a table".to_owned()))
    }
}

#[cfg(feature = "schema")]
impl schemars::JsonSchema for Quantity {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "Quantity".into()
    }

    fn json_schema(_: &mut schemars::SchemaGenerator) -> schemars::Schema {
        schemars::json_schema!({
            "description": "An SI number, or a string with a unit (\"10 deg\").",
            "type": ["number", "string"]
        })
    }
}

#[cfg(test)]
mod tests {
    //! Units are converted; what is no quantity is none.

    use core::f64::consts::{FRAC_PI_2, TAU};

    use super::*;

    #[test]
    fn units_are_converted() {
        let si = |text: &str, kind: &Kind| Quantity::Text(text.to_owned()).si(kind);
        for (text, kind, requested) in [
            ("90 deg", &ANGLE, FRAC_PI_2),
            ("-360deg", &ANGLE, -TAU),
            ("1e-3 rad", &ANGLE, 1e-3),
            ("0.5", &ANGLE, 0.5),
            ("200 km", &LENGTH, 2e5),
            ("1 AU", &LENGTH, 149_597_870_700.0),
            ("30 rpm", &RATE, core::f64::consts::PI),
            ("5 min", &TIME, 300.0),
            (" 1.5  d ", &TIME, 129_600.0),
            ("2. km/s", &SPEED, 2000.0),
        ] {
            assert_eq!(si(text, kind), Some(requested), "{text}");
        }
        for (text, kind) in
            [("10 km", &ANGLE), ("deg", &ANGLE), ("ten deg", &ANGLE), ("", &TIME), ("5 m", &TIME)]
        {
            assert_eq!(si(text, kind), None, "{text}");
        }
        assert_eq!(Quantity::Number(3.0).si(&SPEED), Some(3.0));
        assert_eq!(Quantity::Other("a list".to_owned()).si(&SPEED), None);
    }
}

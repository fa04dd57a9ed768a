//! Quantities of a timeline: SI numbers, or strings with a unit ("10 deg").

use core::fmt;
use core::ops::RangeInclusive;

use serde::Deserialize;
use serde::de::IgnoredAny;

use crate::constants::{ASTRONOMICAL_UNIT_M, DEG_RAD, RPM_RAD_S, TIME_UNITS};
use crate::guidance::pointing::command::{
    BACK_HALF_TURN_RAD, BACK_TURN_RAD, DOWN_ANGLE_RAD, FULL_TURN_RAD, RIGHT_ANGLE_RAD,
};
use crate::toml::{Place, type_schema, with_unit};

/// Quantity as written in the file.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(untagged)]
pub(crate) enum Quantity {
    /// A number, SI.
    Number(f64),
    /// A string.
    Text(String),
    /// True or false, which is no quantity.
    Truth(bool),
    /// A list, which is none.
    List(Vec<IgnoredAny>),
    /// A table, which is none.
    Table(IgnoredAny),
}

/// A kind of quantity with the units that it can be given in, the SI unit first.
#[derive(Debug)]
pub(super) struct QuantityKind {
    /// With its article.
    name: &'static str,
    /// Names and how much of the SI unit they are.
    units: &'static [(&'static str, f64)],
    /// Allowed range of an angle, with its words for messages.
    range_rad: Option<(RangeInclusive<f64>, &'static str)>,
}

const fn kind(name: &'static str, units: &'static [(&'static str, f64)]) -> QuantityKind {
    QuantityKind { name, units, range_rad: None }
}

const fn angle(range_rad: RangeInclusive<f64>, allowed: &'static str) -> QuantityKind {
    QuantityKind {
        range_rad: Some((range_rad, allowed)),
        ..kind("an angle", &[("rad", 1.0), ("deg", DEG_RAD)])
    }
}

/// Azimuths, longitudes and right ascensions.
pub(super) const TURN: QuantityKind = angle(BACK_TURN_RAD..=FULL_TURN_RAD, "an angle from -360 to 360 deg");
/// Elevations, latitudes and declinations.
pub(super) const LATITUDE: QuantityKind =
    angle(DOWN_ANGLE_RAD..=RIGHT_ANGLE_RAD, "an angle from -90 to 90 deg");
/// Offsets of panels from the Sun.
pub(super) const HALF_TURN: QuantityKind =
    angle(BACK_HALF_TURN_RAD..=core::f64::consts::PI, "an angle from -180 to 180 deg");
/// Half widths of a zone.
pub(super) const QUARTER_TURN: QuantityKind = angle(0.0..=RIGHT_ANGLE_RAD, "an angle from 0 to 90 deg");
/// Rates of rotations.
pub(super) const RATE: QuantityKind =
    kind("a rate", &[("rad/s", 1.0), ("deg/s", DEG_RAD), ("rpm", RPM_RAD_S)]);
/// Lengths.
pub(super) const LENGTH: QuantityKind =
    kind("a length", &[("m", 1.0), ("km", 1e3), ("cm", 1e-2), ("mm", 1e-3), ("AU", ASTRONOMICAL_UNIT_M)]);
/// Speeds.
pub(super) const SPEED: QuantityKind = kind("a speed", &[("m/s", 1.0), ("km/s", 1e3), ("mm/s", 1e-3)]);
/// Angular momentum.
pub(super) const MOMENTUM: QuantityKind = kind("an angular momentum", &[("N.m.s", 1.0), ("mN.m.s", 1e-3)]);
/// Times.
pub(super) const TIME: QuantityKind = kind("a time", &TIME_UNITS);

impl Quantity {
    /// The value in the SI unit; `None` where this is no quantity of this kind.
    pub(super) fn si(&self, kind: &QuantityKind) -> Option<f64> {
        let (number, unit) = match self {
            Self::Number(number) => return Some(*number),
            Self::Text(text) => with_unit(text)?,
            Self::Truth(_) | Self::List(_) | Self::Table(_) => return None,
        };
        let factor = match unit {
            "" => 1.0,
            _ => kind.units.iter().find(|(name, _)| *name == unit)?.1,
        };
        Some(number * factor)
    }

    /// The value in the SI unit; what is no quantity of this kind is reported.
    pub(super) fn read(&self, at: &Place<'_>, kind: &QuantityKind) -> f64 {
        let Some(value) = self.si(kind) else {
            at.report(self, kind);
            return 0.0;
        };
        let Some((range_rad, allowed)) = &kind.range_rad else { return at.finite(value) };
        if !range_rad.contains(&value) {
            let found = match self {
                Self::Number(number) if range_rad.contains(&number.to_radians()) => {
                    format!("{number} rad (did you mean \"{number} deg\"?)")
                }
                Self::Number(number) => format!("{number} rad"),
                _ => self.to_string(),
            };
            at.report(found, allowed);
        }
        value
    }
}

/// A quantity in SI, 0 unless given.
pub(super) fn or_zero(at: &Place<'_>, given: &Option<Quantity>, kind: &QuantityKind) -> f64 {
    given.as_ref().map_or(0.0, |quantity| quantity.read(at, kind))
}

/// Three quantities in SI, 0 unless given.
pub(super) fn three(at: &Place<'_>, given: Option<&[Quantity; 3]>, kind: &QuantityKind) -> [f64; 3] {
    given.map_or([0.0; 3], |given| [0, 1, 2].map(|index| given[index].read(&at.item(index), kind)))
}

impl fmt::Display for Quantity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(number) => write!(f, "{number}"),
            Self::Text(text) => write!(f, "{text:?}"),
            Self::Truth(truth) => write!(f, "boolean `{truth}`"),
            Self::List(_) => f.write_str("a list"),
            Self::Table(_) => f.write_str("a table"),
        }
    }
}

impl fmt::Display for QuantityKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [(si, _), others @ ..] = self.units else { return f.write_str(self.name) };
        let others: Vec<&str> = others.iter().map(|(name, _)| *name).collect();
        write!(f, "{}: a number in {si} or a string with a unit: {si}, {}", self.name, others.join(", "))
    }
}

type_schema!([] Quantity, inline: false, "Quantity", |_| {
    schemars::json_schema!({
        "description": "An SI number, or a string with a unit (\"10 deg\").",
        "type": ["number", "string"]
    })
});

#[cfg(test)]
mod tests {
    //! Units are converted; what is no quantity is none.

    use core::f64::consts::{FRAC_PI_2, TAU};

    use super::*;

    #[test]
    fn units_are_converted() {
        let si = |text: &str, kind: &QuantityKind| Quantity::Text(text.to_owned()).si(kind);
        for (text, kind, requested) in [
            ("90 deg", &TURN, FRAC_PI_2),
            ("-360deg", &TURN, -TAU),
            ("1e-3 rad", &TURN, 1e-3),
            ("0.5", &TURN, 0.5),
            ("200 km", &LENGTH, 2e5),
            ("1 AU", &LENGTH, 149_597_870_700.0),
            ("30 rpm", &RATE, core::f64::consts::PI),
            ("5 min", &TIME, 300.0),
            (" 1.5  d ", &TIME, 129_600.0),
            ("2. km/s", &SPEED, 2000.0),
            ("20 mN.m.s", &MOMENTUM, 0.02),
            ("1.N.m.s", &MOMENTUM, 1.0),
        ] {
            assert_eq!(si(text, kind), Some(requested), "{text}");
        }
        for (text, kind) in
            [("10 km", &TURN), ("deg", &TURN), ("ten deg", &TURN), ("", &TIME), ("5 m", &TIME)]
        {
            assert_eq!(si(text, kind), None, "{text}");
        }
        assert_eq!(Quantity::Number(3.0).si(&SPEED), Some(3.0));
        assert_eq!(Quantity::List(Vec::new()).si(&SPEED), None);
    }
}

//! Ranges of numbers in files: a type each, which the reader checks by and the schema shows.
//!
//! A field says by its type what it may hold, as in `radius_m: Positive`; `deg` and `km` are converted to SI units. The type's name reaches the reader through serde.

use serde::{Deserialize, Serialize};

use crate::constants::DAY_S;

/// Greatest magnitude of any number in a file: keeps products of several numbers far from overflow.
pub(super) const GREATEST: f64 = 1e12;

/// Numbers from `low` to `high`, both included.
pub(super) struct Range {
    name: &'static str,
    pub low: f64,
    pub high: f64,
    pub allowed: &'static str,
}

impl Range {
    /// Range of the type with this name; `None` for a type that is no range.
    pub(super) fn of_type(name: &str) -> Option<&'static Self> {
        RANGES.iter().find(|range| range.name == name)
    }
}

/// The schema of a number with its bounds; [`GREATEST`] goes without saying.
#[cfg(feature = "schema")]
fn bounded(mut schema: schemars::Schema, low: f64, high: f64) -> schemars::Schema {
    let mut insert = |key: &str, bound: f64| {
        let whole = bound as i64;
        let bound = if whole as f64 == bound { whole.into() } else { bound.into() };
        schema.insert(key.to_owned(), bound);
    };
    match low {
        f64::MIN_POSITIVE => insert("exclusiveMinimum", 0.0),
        low if low > -GREATEST => insert("minimum", low),
        _ => {}
    }
    if high != GREATEST {
        insert("maximum", high);
    }
    schema
}

macro_rules! ranges {
    ($($name:ident($number:ident $($unit:ident)?): $low:expr, $high:expr, $allowed:literal;)+) => {
        $(
            #[doc = concat!("Allowed: ", $allowed, ".")]
            #[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
            pub struct $name(pub $number);

            impl $name {
                /// Allowed numbers, for messages.
                pub const ALLOWED: &'static str = $allowed;
            }

            impl super::written::Written for $name {
                type Value = $number;

                fn value(&self) -> $number {
                    ranges!(@si self.0 $(, $unit)?)
                }
            }

            impl From<$number> for $name {
                fn from(number: $number) -> Self {
                    Self(number)
                }
            }

            super::written::type_schema!([] $name, inline: true, stringify!($name), |generator| {
                bounded(<$number as schemars::JsonSchema>::json_schema(generator), $low, $high)
            });
        )+

        const RANGES: &[Range] =
            &[$(Range { name: stringify!($name), low: $low, high: $high, allowed: $allowed }),+];
    };
    (@si $number:expr) => { $number };
    (@si $number:expr, deg) => { $number.to_radians() };
    (@si $number:expr, km) => { $number * 1e3 };
}

ranges! {
    Finite(f64): -GREATEST, GREATEST, "a finite number up to 1e12 in magnitude";
    Positive(f64): f64::MIN_POSITIVE, GREATEST, "a number above 0 and at most 1e12";
    NotNegative(f64): 0.0, GREATEST, "a number from 0 to 1e12";
    Fraction(f64): 0.0, 1.0, "a number from 0 to 1";
    Emissivity(f64): 1e-3, 1.0, "a number from 0.001 to 1";
    Kelvin(f64): 0.0, 2000.0, "0 to 2000 K";
    SpecificImpulse(f64): 1.0, 1e8, "a number from 1 to 1e8 s";
    Frequency(f64): f64::MIN_POSITIVE, 1000.0, "a number above 0 and at most 1000 Hz";
    GravitationalParameter(f64): f64::MIN_POSITIVE, 1e21, "a number above 0 and at most 1e21 m3/s2";
    BodyRadius(f64): 1.0, 1e9, "1 to 1e9 m";
    OrbitAxis(f64): 1e9, 1e13, "1e9 to 1e13 m";
    Distance(f64): f64::MIN_POSITIVE, 1e13, "a distance above 0 and at most 1e13 m";
    Kilometers(f64 km): 0.0, GREATEST, "a number from 0 to 1e12";
    Eccentricity(f64): 0.0, 0.99, "a number from 0 to 0.99";
    ZonalHarmonic(f64): -1.0, 1.0, "a number from -1 to 1";
    RotationRate(f64): -1.0, 1.0, "a rate from -1 to 1 rad/s";
    QuarterTurnEither(f64 deg): -90.0, 90.0, "an angle from -90 to 90 deg";
    QuarterTurn(f64 deg): 0.0, 90.0, "an angle from 0 to 90 deg";
    HalfTurn(f64 deg): 0.0, 180.0, "an angle from 0 to 180 deg";
    HalfTurnEither(f64 deg): -180.0, 180.0, "an angle from -180 to 180 deg";
    FieldOfView(f64 deg): f64::MIN_POSITIVE, 180.0, "an angle above 0 and at most 180 deg";
    SubtendedAngle(f64 deg): f64::MIN_POSITIVE, 360.0, "an angle above 0 and at most 360 deg";
    TurnEither(f64 deg): -360.0, 360.0, "an angle from -360 to 360 deg";
    FieldWidth(f64): f64::MIN_POSITIVE, 180.0, "an angle above 0 and at most 180 deg";
    Deviation(f64): 0.0, 180.0, "a standard deviation from 0 to 180 deg";
    AtLeastOne(u32): 1.0, GREATEST, "at least 1";
    Pickets(u32): 4.0, GREATEST, "a multiple of 4, at least 4";
    Epoch(f64): -4000.0 * 365.25 * DAY_S, 4000.0 * 365.25 * DAY_S, "s past J2000 TDB, within 4000 years of it";
    CellTemperature(f64): 0.0, 1e4, "a number from 0 to 10000 K";
    Copies(u32): 2.0, 100.0, "a whole number from 2 to 100";
    Orbits(u32): 0.0, 1000.0, "a whole number of orbits from 0 to 1000";
    Corners(u32): 3.0, 128.0, "a whole number from 3 to 128";
    Rings(u32): 1.0, 32.0, "a whole number from 1 to 32";
}

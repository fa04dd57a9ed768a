//! Numbers, quantities, dates and lists as files write them: a type each, with its value in SI units and its schema.

use core::{f64::consts::FRAC_PI_2, fmt};
use std::{borrow::Cow, path::Path};

use model_description::quantity::is_beyond_turn;
use nalgebra::Vector3;
use physics::{
    environment::dates::{self, ALLOWED_DATE},
    toml::Place,
};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::Deserialize;

use super::{Written, tables::Checked};
use crate::values::{self, Instant};

/// Form of a time, for messages.
pub(crate) const ALLOWED_TIME: &str =
    "a number of s or one with a unit: 600, \"10 min\", \"0.5 h\", \"90 d\"";
/// Form of a length, for messages.
pub(crate) const ALLOWED_LENGTH: &str = "a number of m or one with a unit: 2e5, \"200 km\", \"0.5 AU\"";
const ALLOWED_SPEED: &str = "a number of m/s or one with a unit: \"38.2 km/s\"";
const ALLOWED_ANGLE: &str = "with its unit: \"2 deg\", \"0.035 rad\"";
const MAX_REVOLUTIONS: u32 = 100;

/// Declares types of values by how they are read, what is allowed, and the schema but for its description. What is wrong with a date is
/// reported of `dated` ones.
macro_rules! quantities {
    ($($(#[$about:meta])* $name:ident $(($dated:ident))?: $value:ty = $read:expr, $allowed:expr, $schema:tt;)+) => {$(
        $(#[$about])*
        #[derive(Clone, Debug, Deserialize)]
        #[serde(transparent)]
        pub(crate) struct $name(pub(crate) Written);

        impl $name {
            /// Returns the value; `None` where what is written is not allowed.
            pub(crate) fn read(&self) -> Option<$value> {
                let read: fn(&Written) -> Option<$value> = $read;
                read(&self.0)
            }

            /// Returns the form of what is allowed.
            pub(crate) fn allowed() -> String {
                String::from($allowed)
            }
        }

        impl Checked for $name {
            fn check(&mut self, at: &Place<'_>, _: &Path) {
                if self.read().is_some() {
                    return;
                }
                $(
                    let _ = stringify!($dated);
                    if let Some(error) = self.0.date().and_then(|date| dates::epoch_s(date).err()) {
                        at.report(format_args!("{self}, {error}"), ALLOWED_DATE);
                        return;
                    }
                )?
                at.report(&self.0, Self::allowed());
            }
        }

        impl physics::toml::Written for $name {
            type Value = $value;

            fn value(&self) -> $value {
                self.read().unwrap_or_default()
            }
        }

        impl fmt::Display for $name {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                self.0.fmt(f)
            }
        }

        impl<T: Into<Written>> From<T> for $name {
            fn from(written: T) -> Self {
                Self(written.into())
            }
        }

        impl JsonSchema for $name {
            fn schema_name() -> Cow<'static, str> {
                stringify!($name).into()
            }

            fn json_schema(_: &mut SchemaGenerator) -> Schema {
                let mut schema = json_schema!($schema);
                schema.insert("description".to_owned(), format!("Allowed: {}.", Self::allowed()).into());
                schema
            }
        }
    )+};
}

quantities! {
    /// Time, of either sign.
    Duration: f64 = Written::duration_s, ALLOWED_TIME, { "type": ["number", "string"] };
    /// Time above 0.
    Span: f64 = Written::span_s, format!("a time above 0: {ALLOWED_TIME}"),
        { "type": ["number", "string"], "exclusiveMinimum": 0 };
    /// Time from 0 on.
    SpanFromZero: f64 = |it| span_s(it, 0.0), format!("a time from 0 on: {ALLOWED_TIME}"),
        { "type": ["number", "string"], "minimum": 0 };
    /// Time from a minute on.
    SpanFromMinute: f64 = |it| span_s(it, 60.0), format!("a time from 1 min on: {ALLOWED_TIME}"),
        { "type": ["number", "string"], "minimum": 60 };
    /// Time from an hour on.
    SpanFromHour: f64 = |it| span_s(it, 3600.0), format!("a time from 1 h on: {ALLOWED_TIME}"),
        { "type": ["number", "string"], "minimum": 3600 };
    /// Time before an arrival, below 0.
    BeforeArrival: f64 = |it| it.duration_s().filter(|time_s| *time_s < 0.0),
        "times before the arrival, less than 0, in order: [\"-42 d\", \"-10 d\"]",
        { "type": ["number", "string"], "exclusiveMaximum": 0 };
    /// Date or simulation time.
    Moment(dated): Instant = |it| values::instant(&it.scalar()?).ok(),
        format!("{ALLOWED_DATE}; or simulation time, {ALLOWED_TIME}"), { "type": ["number", "string"] };
    /// Date, with its text.
    Date(dated): (f64, String) = |it| it.date().and_then(|text| Some((dates::epoch_s(text).ok()?, text.to_owned()))),
        ALLOWED_DATE, { "type": "string" };
    /// Length, of either sign.
    Length: f64 = |it| it.quantity("m"), ALLOWED_LENGTH, { "type": ["number", "string"] };
    /// Length from 1 m on.
    LengthFromMeter: f64 = |it| it.quantity("m").filter(|length_m| *length_m >= 1.0), "a length from 1 m on",
        { "type": ["number", "string"], "minimum": 1 };
    /// Standard deviation of a length.
    LengthFromZero: f64 = |it| it.quantity("m").filter(|length_m| *length_m >= 0.0),
        format!("a length from 0 on: {ALLOWED_LENGTH}"), { "type": ["number", "string"], "minimum": 0 };
    /// Angle of any size.
    Angle: f64 = Written::angle_rad, format!("an angle {ALLOWED_ANGLE}"), { "type": ["number", "string"] };
    /// Angle up to a turn, either way.
    Turn: f64 = |it| it.angle_rad().filter(|angle_rad| !is_beyond_turn(*angle_rad)),
        "an angle from -360 to 360 deg with its unit: \"30 deg\"", { "type": ["number", "string"] };
    /// Angle up to a right one.
    QuarterTurn: f64 = |it| it.angle_rad().filter(|angle_rad| (0.0..=FRAC_PI_2).contains(angle_rad)),
        format!("an angle from 0 to 90 deg {ALLOWED_ANGLE}"), { "type": ["number", "string"] };
    /// Angular momentum above 0.
    Momentum: f64 = |it| it.quantity("N.m.s").filter(|momentum_n_m_s| *momentum_n_m_s > 0.0),
        "a number of N.m.s above 0, or one with that unit: 5.5, \"5.5 N.m.s\"",
        { "type": ["number", "string"], "exclusiveMinimum": 0 };
    /// Fraction of a whole.
    Share: f64 = |it| within(it, 1.0), "a share from 0 to 1", { "type": "number", "minimum": 0, "maximum": 1 };
    /// Fraction of a limit that stays unused.
    Margin: f64 = |it| within(it, 0.99), "a share from 0 to 0.99", { "type": "number", "minimum": 0, "maximum": 0.99 };
    /// Number from 0 on.
    FromZero: f64 = |it| within(it, f64::MAX), "a number from 0 on", { "type": "number", "minimum": 0 };
    /// Whole number from 0 on.
    Count: u64 = |it| whole(it, 0, u64::MAX), "a whole number from 0 on", { "type": "integer", "minimum": 0 };
    /// Whole number from 1 on.
    CountFromOne: u64 = |it| whole(it, 1, u64::MAX), "a whole number from 1 on", { "type": "integer", "minimum": 1 };
    /// Number of dispersed flights.
    Flights: u64 = |it| whole(it, 2, 100_000), "from 2 to 100000", { "type": "integer", "minimum": 2, "maximum": 100_000 };
    /// Whole revolutions.
    Revolutions: u32 = |it| whole(it, 0, MAX_REVOLUTIONS.into())?.try_into().ok(),
        format!("a whole number from 0 to {MAX_REVOLUTIONS}"),
        { "type": "integer", "minimum": 0, "maximum": MAX_REVOLUTIONS };
    /// Three finite numbers.
    Triple: Vector3<f64> = |it| vector(it, |number| number.number().filter(|number| number.is_finite())),
        "three finite numbers", { "type": "array", "items": { "type": "number" }, "minItems": 3, "maxItems": 3 };
    /// Position that is not 0.
    Position: Vector3<f64> = |it| vector(it, |part| part.quantity("m")).filter(|it| it.norm() > 0.0),
        format!("a list of three, not all 0, each {ALLOWED_LENGTH}"),
        { "type": "array", "items": { "type": ["number", "string"] }, "minItems": 3, "maxItems": 3 };
    /// Velocity that is not 0.
    Velocity: Vector3<f64> = |it| vector(it, |part| part.quantity("m/s")).filter(|it| it.norm() > 0.0),
        format!("a list of three, not all 0, each {ALLOWED_SPEED}"),
        { "type": "array", "items": { "type": ["number", "string"] }, "minItems": 3, "maxItems": 3 };
    /// Value of a variable, as `--set` takes it.
    Setting: String = Written::setting,
        "a number, a string, true or false, a list; the name of a variable stands in quotes as a whole",
        { "type": ["number", "string", "boolean", "array"] };
    /// Values of a variable, as `--set` takes them.
    Settings: Vec<String> = |it| if let Written::List(items) = it { items.iter().map(Written::item).collect() } else { None },
        "a list of SI numbers, strings with a unit, dates, options' names, or true and false",
        { "type": "array", "items": { "type": ["number", "string", "boolean"] }, "minItems": 1 };
    /// Names of two normal variables, and the coefficient of correlation of their values.
    Correlation: ([String; 2], f64) = correlation, "two names and a coefficient from -1 to 1: [\"a\", \"b\", 0.5]",
        {
            "type": "array",
            "prefixItems": [{ "type": "string" }, { "type": "string" }, { "type": "number", "minimum": -1, "maximum": 1 }],
            "items": { "type": ["string", "number"] },
            "minItems": 3,
            "maxItems": 3
        };
    /// Bound of a variable, as `--set` takes it.
    Bound: String = Written::scalar, "a number in SI, or a string with a unit", { "type": ["number", "string"] };
}

fn span_s(written: &Written, least_s: f64) -> Option<f64> {
    written.duration_s().filter(|time_s| *time_s >= least_s)
}

fn within(written: &Written, most: f64) -> Option<f64> {
    written.number().filter(|number| (0.0..=most).contains(number))
}

fn whole(written: &Written, least: u64, most: u64) -> Option<u64> {
    let Written::Integer(number) = written else { return None };
    u64::try_from(*number).ok().filter(|number| (least..=most).contains(number))
}

fn vector(written: &Written, part: fn(&Written) -> Option<f64>) -> Option<Vector3<f64>> {
    let Written::List(parts) = written else { return None };
    let parts: Vec<f64> = parts.iter().map(part).collect::<Option<_>>()?;
    <[f64; 3]>::try_from(parts).ok().map(Vector3::from)
}

fn correlation(written: &Written) -> Option<([String; 2], f64)> {
    let Written::List(parts) = written else { return None };
    let [Written::Text(one), Written::Text(other), coefficient] = &parts[..] else { return None };
    let coefficient = coefficient.number().filter(|it| it.abs() <= 1.0)?;
    Some(([one.clone(), other.clone()], coefficient))
}

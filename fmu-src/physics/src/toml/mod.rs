//! Reading of TOML with the place of every mistake: five formats share it.
//!
//! A [`Document`] reads a type through serde and continues behind every unknown, missing or ill-typed key; a [`Checker`] continues
//! with the values. So one run tells of everything, each with line, key, what was found and what is allowed.

mod checker;
pub mod dates;
mod directions;
mod document;
mod error;
mod key_path;
mod limits;
mod numbers;
mod ranges;
mod reader;
pub mod rules;
mod spelling;
pub mod tables;
pub mod written;

pub use crate::tables;
pub use checker::{Checker, Place};
pub use document::Document;
pub use error::{FileError, Problem};
pub use key_path::KeyPath;
pub use limits::{
    LIMITS, MOST_ANTENNAS, MOST_ITEMS, MOST_PROBLEMS, MOST_TEXT_BYTES, MOST_THRUSTERS, TIMELINE_LIMITS,
};
pub(crate) use numbers::{in_units, rounded, with_unit};
pub use ranges::{
    AtLeastOne, BodyRadius, CellTemperature, Copies, Corners, Deviation, Distance, Eccentricity, Emissivity,
    Epoch, FieldOfView, FieldWidth, Finite, Fraction, Frequency, GravitationalParameter, HalfTurn,
    HalfTurnEither, Kelvin, Kilometers, NotNegative, OrbitAxis, Orbits, Pickets, Positive, QuarterTurn,
    QuarterTurnEither, Rings, RotationRate, SpecificImpulse, SubtendedAngle, TurnEither, ZonalHarmonic,
};
pub use spelling::{hint, nearest};
#[cfg(feature = "schema")]
pub(crate) use tables::schema;
pub use tables::{List, Named, NonEmpty, Point, Table, UnitVector};
pub use written::Written;
pub(crate) use written::{plain, type_schema};

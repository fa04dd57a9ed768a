//! Reading of TOML with the place of every mistake: five formats share it.
//!
//! A [`Document`] reads a type through serde and continues behind every unknown, missing or ill-typed key; a [`Checker`] continues
//! with the values. So one run tells of everything, each with line, key, what was found and what is allowed.

mod checker;
pub mod dates;
mod document;
mod error;
mod limits;
mod place;
mod ranges;
mod reader;
mod spelling;
pub(crate) mod tables;

pub use checker::Checker;
pub(crate) use checker::rounded;
pub use document::Document;
pub use error::{FileError, Problem};
pub use limits::{
    LIMITS, MOST_ANTENNAS, MOST_ITEMS, MOST_PROBLEMS, MOST_TEXT_BYTES, MOST_THRUSTERS, TIMELINE_LIMITS,
};
pub use place::KeyPath;
pub use ranges::{
    AtLeastOne, BodyRadius, Copies, Corners, Deviation, Distance, Emissivity, FieldOfView, Finite, Fraction,
    Frequency, GravitationalParameter, HalfTurn, HalfTurnEither, Kelvin, NotNegative, OrbitAxis, Orbits,
    Positive, QuarterTurn, Rings, SpecificImpulse, SubtendedAngle, TurnEither,
};
pub use reader::Findings;
pub use spelling::{hint, nearest};
pub use tables::{NonEmpty, Written};
pub(crate) use tables::{plain, tables};

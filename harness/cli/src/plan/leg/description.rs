//! The shape of a leg file.

use serde::Deserialize;

use crate::mission::Written;

/// A leg: the place and date at which it begins, and the encounter with a planet that it leads to. Lengths, speeds and angles are SI
/// numbers or strings with a unit.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(title = "heliotorque leg"))]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub(super) struct Description {
    /// The mission: spacecraft, values, timeline, with orbit.center sun, orbit.dynamics nBody and encounter.body. The path is relative to
    /// this file.
    pub mission: String,
    /// Where and when it begins.
    pub depart: DepartDescription,
    /// The encounter.
    pub arrive: ArriveDescription,
}

/// Where and when the leg begins.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub(super) struct DepartDescription {
    /// The date; the mission's start unless given.
    #[cfg_attr(feature = "schema", schemars(with = "Option<super::schema::Number>"))]
    pub at: Option<Written>,
    /// The place from the Sun, EME2000.
    #[cfg_attr(feature = "schema", schemars(with = "super::schema::Vector"))]
    pub position: Written,
    /// The velocity before the departure, EME2000: the delta-v of the departure is reported. It says, too, in which sense the leg goes
    /// around the Sun; as planets do unless given.
    #[cfg_attr(feature = "schema", schemars(with = "Option<super::schema::Vector>"))]
    pub velocity: Option<Written>,
}

/// The encounter.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub(super) struct ArriveDescription {
    /// The planet, the mission's encounter.body.
    pub body: ArrivalBody,
    /// When the closest approach shall be: a date or simulation time.
    #[cfg_attr(feature = "schema", schemars(with = "super::schema::Number"))]
    pub at: Written,
    /// Altitude of the closest approach, as it is simulated; beside `angle`, instead of `bT` and `bR`.
    #[cfg_attr(feature = "schema", schemars(with = "Option<super::schema::Number>"))]
    pub altitude: Option<Written>,
    /// Angle of B from T toward R.
    #[cfg_attr(feature = "schema", schemars(with = "Option<super::schema::Number>"))]
    pub angle: Option<Written>,
    /// Component of B along T, of the hyperbola that osculates encounter.leadTime (6 h) before the closest approach.
    #[cfg_attr(feature = "schema", schemars(with = "Option<super::schema::Number>"))]
    pub b_t: Option<Written>,
    /// Component of B along R.
    #[cfg_attr(feature = "schema", schemars(with = "Option<super::schema::Number>"))]
    pub b_r: Option<Written>,
    /// Whole revolutions about the Sun; 0 unless given.
    #[cfg_attr(feature = "schema", schemars(with = "Option<u32>"))]
    pub revolutions: Option<Written>,
    /// Which of the two arcs with so many revolutions.
    pub branch: Option<ArcBranch>,
}

/// A planet of an encounter.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "camelCase")]
pub(super) enum ArrivalBody {
    /// Mercury.
    Mercury,
    /// Venus.
    Venus,
    /// The Earth.
    Earth,
    /// Mars.
    Mars,
    /// Jupiter.
    Jupiter,
    /// The body that the spacecraft's file describes.
    Custom,
}

impl ArrivalBody {
    /// As variables of the FMU have it.
    pub(super) fn word(self) -> &'static str {
        ["mercury", "venus", "earth", "mars", "jupiter", "custom"][self as usize]
    }
}

/// One of two arcs with the same whole revolutions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "camelCase")]
pub(super) enum ArcBranch {
    /// The one with the smaller x of Izzo's time equation.
    Left,
    /// The one with the larger x.
    Right,
}

//! The shape of a leg file.

use serde::Deserialize;

use super::schema::{Number, Vector};
use crate::reading::WrittenAs;

/// A leg: the place and date at which it begins, and the encounter with a planet that it leads to. Lengths, speeds and angles are SI
/// numbers or strings with a unit.
#[derive(Debug, Deserialize, schemars::JsonSchema)]
#[schemars(title = "heliotorque leg")]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub struct LegDescription {
    /// The mission: spacecraft, values, timeline, with orbit.center sun, orbit.dynamics nBody and encounter.body. The path is relative to
    /// this file.
    pub mission: String,
    /// Where and when it begins.
    pub depart: DepartDescription,
    /// The encounter.
    pub arrive: ArriveDescription,
}

/// Where and when the leg begins.
#[derive(Debug, Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub struct DepartDescription {
    /// The date; the mission's start unless given.
    pub at: Option<WrittenAs<Number>>,
    /// The place from the Sun, EME2000.
    pub position: WrittenAs<Vector>,
    /// The velocity before the departure, EME2000: the delta-v of the departure is reported. It says, too, in which sense the leg goes
    /// around the Sun; as planets do unless given.
    pub velocity: Option<WrittenAs<Vector>>,
}

/// The encounter.
#[derive(Debug, Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub struct ArriveDescription {
    /// The planet, the mission's encounter.body.
    pub body: ArrivalBody,
    /// When the closest approach shall be: a date or simulation time.
    pub at: WrittenAs<Number>,
    /// Altitude of the closest approach, as it is simulated; beside `angle`, instead of `bT` and `bR`.
    pub altitude: Option<WrittenAs<Number>>,
    /// Angle of B from T toward R.
    pub angle: Option<WrittenAs<Number>>,
    /// Component of B along T, of the hyperbola that osculates encounter.leadTime (6 h) before the closest approach.
    pub b_t: Option<WrittenAs<Number>>,
    /// Component of B along R.
    pub b_r: Option<WrittenAs<Number>>,
    /// Whole revolutions about the Sun; 0 unless given.
    pub revolutions: Option<WrittenAs<u32>>,
    /// Which of the two arcs with so many revolutions.
    pub branch: Option<ArcBranch>,
}

/// A planet of an encounter.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "camelCase")]
pub enum ArrivalBody {
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
    pub fn word(self) -> &'static str {
        ["mercury", "venus", "earth", "mars", "jupiter", "custom"][self as usize]
    }
}

/// One of two arcs with the same whole revolutions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "camelCase")]
pub enum ArcBranch {
    /// The one with the smaller x of Izzo's time equation.
    Left,
    /// The one with the larger x.
    Right,
}

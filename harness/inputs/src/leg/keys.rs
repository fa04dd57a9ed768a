//! The keys of a leg file.
#![allow(non_snake_case, reason = "keys are named as in the file")]

use serde::Deserialize;

use crate::reading::{
    At, InputFile,
    quantities::{Date, Length, Moment, Position, Revolutions, Turn, Velocity},
    tables, words,
};

tables! {
/// A leg: the place and date at which it begins, and the encounter with a planet that it leads to. Lengths, speeds and angles are SI
/// numbers or strings with a unit.
struct LegKeys makes #[derive(Clone, Debug)] pub struct LegValues {
    /// The mission of MomentumPlant: spacecraft, values, timeline, with `orbit.center` sun, `orbit.dynamics` nBody and `encounter.body`; its own
    /// start of the orbit does not count. The path is relative to this file.
    mission: At<InputFile>,
    /// Where and when it begins.
    depart: DepartKeys,
    /// The encounter.
    arrive: ArriveKeys,
}

/// Where and when the leg begins.
struct DepartKeys makes #[derive(Clone, Debug)] pub struct Departure {
    /// The date; the mission's start unless given.
    at: Option<At<Date>>,
    /// The place from the Sun, EME2000.
    position as position_m: At<Position>,
    /// The velocity before the departure, EME2000: the delta-v of the departure is reported. It says, too, in which sense the leg goes
    /// around the Sun; as planets do unless given.
    velocity as velocity_before_m_s: Option<Velocity>,
}

/// The encounter.
struct ArriveKeys makes #[derive(Clone, Debug)] pub struct Arrival {
    /// The planet, the mission's `encounter.body`.
    body: At<ArrivalBody>,
    /// When the closest approach shall be: a date or simulation time.
    at: At<Moment>,
    /// Altitude of the closest approach above `planet.radius`, as it is simulated; with `angle`, instead of `bT` and `bR`.
    altitude as altitude_m: Option<At<Length>>,
    /// Angle of B from T toward R.
    angle as angle_rad: Option<At<Turn>>,
    /// Component of B along T, of the hyperbola that osculates `encounter.leadTime` (6 h) before the closest approach.
    bT as b_t_m: Option<At<Length>>,
    /// Component of B along R.
    bR as b_r_m: Option<At<Length>>,
    /// Whole revolutions about the Sun.
    revolutions: At<Revolutions> = 0,
    /// Number of the arc, 1 or 2, from one revolution on.
    branch: Option<ArcBranch>,
}
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

words!(ArrivalBody, ArcBranch);

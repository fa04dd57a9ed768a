//! The shape of a plan file.

use serde::Deserialize;

use super::schema::{Command, Number};
use crate::reading::WrittenAs;

/// What is planned: a mission, how far arrays and attitude may go in its free windows (in an orbit phase: the Sun's place in its
/// downlinks), and what its momentum is kept below. Times,
/// angles and momenta are SI numbers or strings with a unit.
#[derive(Debug, Deserialize, schemars::JsonSchema)]
#[schemars(title = "heliotorque plan")]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub struct MomentumPlanDescription {
    /// The mission: spacecraft, times, values, timeline. The path is relative to this file.
    pub mission: String,
    /// How long from its start the mission stays as it is; "14 d" unless given.
    pub freeze: Option<WrittenAs<Number>>,
    /// Distance of the points at which momentum and path are looked at; "1 h" unless given, "10 min" in an orbit phase.
    pub every: Option<WrittenAs<Number>>,
    /// Length of a window; "3 d" unless given.
    pub window: Option<WrittenAs<Number>>,
    /// Limit of the momentum.
    pub momentum: Option<MomentumDescription>,
    /// Offsets of the arrays from the Sun.
    pub sun_offset: Option<SunOffsetDescription>,
    /// Largest windmill angle of the arrays, either way; "2 deg" unless given, 0 for none.
    pub windmill: Option<WrittenAs<Number>>,
    /// Largest tilt of the Sun off -Y in downlinks; none unless given, in an orbit phase that of the keep-in zone.
    pub tilt: Option<TiltDescription>,
    /// Largest share of a window in the attitude turned by 180 deg about the Sun line; 0.5 unless given, 0 for none.
    pub alternation: Option<WrittenAs<Number>>,
    /// Ground contacts, in the order of time: no alternate attitude in them.
    pub contact: Option<Vec<ContactDescription>>,
    /// Share of every window that contacts take, where none is listed; 0 unless given.
    pub contact_share: Option<WrittenAs<Number>>,
    /// Activities whose price is reported.
    pub activity: Option<Vec<ActivityDescription>>,
    /// Encounter with a planet that the plan aims at.
    pub flyby: Option<FlybyDescription>,
    /// State from orbit determination that the plan begins with, instead of the mission's.
    pub update: Option<UpdateDescription>,
    /// Manoeuvres that would do the same.
    pub compare: Option<CompareDescription>,
    /// Flights of the plan with errors.
    pub montecarlo: Option<MonteCarloDescription>,
}

/// Limit of the momentum.
#[derive(Debug, Default, Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub struct MomentumDescription {
    /// Greatest length of the angular momentum; the least `dump.threshold` unless given.
    pub limit: Option<WrittenAs<Number>>,
    /// Share of the limit that is left; 0 unless given.
    pub margin: Option<WrittenAs<Number>>,
    /// The file of a refit (JSON): its centre of mass and scale of sunlight are simulated, three sigma of its covariance are left.
    pub refit: Option<String>,
    /// Dumps that the plan may have; 0 unless given. A plan that needs more ends with status 1.
    pub dumps: Option<WrittenAs<u32>>,
}

/// Offsets of the arrays.
#[derive(Debug, Default, Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub struct SunOffsetDescription {
    /// Whether windows may leave the baseline, the fewest steps that keep the light on the cells in its corridor; false unless given.
    pub change: Option<bool>,
    /// Largest change off the baseline; "5 deg" unless given.
    pub largest: Option<WrittenAs<Number>>,
}

/// Largest tilt, either way.
#[derive(Debug, Default, Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub struct TiltDescription {
    /// Of the Sun's azimuth, from -Y toward +X.
    pub azimuth: Option<WrittenAs<Number>>,
    /// Of the Sun's elevation, positive toward -Z.
    pub elevation: Option<WrittenAs<Number>>,
}

/// A ground contact.
#[derive(Debug, Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub struct ContactDescription {
    /// When it begins: a date or simulation time.
    pub start: WrittenAs<Number>,
    /// When it ends.
    pub stop: WrittenAs<Number>,
}

/// An activity that might be added.
#[derive(Debug, Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub struct ActivityDescription {
    /// What it is called.
    pub name: String,
    /// When it begins: a date or simulation time.
    pub start: WrittenAs<Number>,
    /// When it ends.
    pub stop: WrittenAs<Number>,
    /// Its command, with the keys of `[[command]]` in a timeline but at and until.
    pub command: WrittenAs<Command>,
}

/// Where the mission is to pass a planet: `bT` and `bR`, or `altitude` and `angle`, where B is that of the
/// hyperbola that osculates `encounter.leadTime` before the closest approach. Without these nothing is planned.
#[derive(Debug, Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub struct FlybyDescription {
    /// The planet: the mission's `encounter.body`.
    pub body: String,
    /// Component of B along T.
    pub b_t: Option<WrittenAs<Number>>,
    /// Component of B along R.
    pub b_r: Option<WrittenAs<Number>>,
    /// Altitude of the closest approach.
    pub altitude: Option<WrittenAs<Number>>,
    /// Angle of B from T toward R.
    pub angle: Option<WrittenAs<Number>>,
    /// When the spacecraft arrives: a date or simulation time; for a fixed arrival.
    pub time: Option<WrittenAs<Number>>,
    /// Whether the time of arrival is a goal too: free (the default) or fixed.
    pub arrival: Option<String>,
    /// From when on the plan may change the mission: a date or simulation time; `freeze` where it is not given.
    pub from: Option<WrittenAs<Number>>,
    /// Greatest miss; "1 km" unless given.
    pub tolerance: Option<WrittenAs<Number>>,
}

/// State from orbit determination, EME2000 from `orbit.center`.
#[derive(Debug, Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub struct UpdateDescription {
    /// When it holds: a date or simulation time; the mission of the plan starts there.
    pub at: WrittenAs<Number>,
    /// Position in m; that of the mission unless given.
    pub position: Option<[f64; 3]>,
    /// Velocity in m/s; that of the mission unless given.
    pub velocity: Option<[f64; 3]>,
    /// Covariance of position (m) and velocity (m/s): six rows of six numbers, as CSV. The path is relative to this file.
    pub covariance: Option<String>,
}

/// Manoeuvres that would do the same: approach manoeuvres before the flyby, and one behind it that makes up for what is left.
#[derive(Debug, Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub struct CompareDescription {
    /// Standard deviation of their direction about each axis across; "0.2 deg" unless given.
    pub direction_error: Option<WrittenAs<Number>>,
    /// Standard deviation of their size, as a share; 0.001 unless given.
    pub magnitude_error: Option<WrittenAs<Number>>,
    /// When approach manoeuvres are, before the arrival; ["-42 d"] unless given.
    pub approach: Option<Vec<WrittenAs<Number>>>,
    /// When the departure manoeuvre is, behind the arrival; "30 d" unless given.
    pub departure: Option<WrittenAs<Number>>,
    /// When that leads back to where the flight through the aim is: a date or simulation time.
    pub next: WrittenAs<Number>,
}

/// Flights of the plan with errors.
#[derive(Debug, Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub struct MonteCarloDescription {
    /// How many; 200 unless given.
    pub runs: Option<WrittenAs<u32>>,
    /// Seed of the draws; 1 unless given. Manoeuvres of run n have `noise.seed` n.
    pub seed: Option<WrittenAs<u32>>,
    /// Standard deviation of each coordinate of the centre of mass; 0 unless given.
    pub center_of_mass: Option<WrittenAs<Number>>,
    /// Standard deviation of `solar.scale`; 0 unless given.
    pub scale: Option<WrittenAs<Number>>,
}

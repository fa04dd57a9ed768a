//! The shape of a plan file.

use serde::Deserialize;

use crate::mission::Written;

/// What is planned: a mission, how far arrays and attitude may go in its free windows (in an orbit phase: the Sun's place in its
/// downlinks), and what its momentum is kept below. Times,
/// angles and momenta are SI numbers or strings with a unit.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(title = "heliotorque plan"))]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub(super) struct Description {
    /// The mission: spacecraft, times, values, timeline. The path is relative to this file.
    pub mission: String,
    /// How long from its start the mission stays as it is; "14 d" unless given.
    #[cfg_attr(feature = "schema", schemars(with = "Option<super::schema::Number>"))]
    pub freeze: Option<Written>,
    /// Length of a window; "3 d" unless given.
    #[cfg_attr(feature = "schema", schemars(with = "Option<super::schema::Number>"))]
    pub window: Option<Written>,
    /// What the momentum is kept below.
    pub momentum: Option<MomentumDescription>,
    /// Offsets of the arrays from the Sun.
    pub sun_offset: Option<SunOffsetDescription>,
    /// Largest windmill angle of the arrays, either way; "2 deg" unless given, 0 for none.
    #[cfg_attr(feature = "schema", schemars(with = "Option<super::schema::Number>"))]
    pub windmill: Option<Written>,
    /// Largest tilt of the Sun off -Y in downlinks; none unless given, in an orbit phase that of the keep-in zone.
    pub tilt: Option<TiltDescription>,
    /// Largest share of a window in the attitude turned by 180 deg about the Sun line; 0.5 unless given, 0 for none.
    #[cfg_attr(feature = "schema", schemars(with = "Option<super::schema::Number>"))]
    pub alternation: Option<Written>,
    /// Ground contacts, in the order of time: no alternate attitude in them.
    pub contact: Option<Vec<ContactDescription>>,
    /// Share of every window that contacts take, where none is listed; 0 unless given.
    #[cfg_attr(feature = "schema", schemars(with = "Option<super::schema::Number>"))]
    pub contact_share: Option<Written>,
    /// Activities whose price is reported.
    pub activity: Option<Vec<ActivityDescription>>,
}

/// What the momentum is kept below.
#[derive(Debug, Default, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub(super) struct MomentumDescription {
    /// Greatest length of the angular momentum; the least `dump.threshold` unless given.
    #[cfg_attr(feature = "schema", schemars(with = "Option<super::schema::Number>"))]
    pub limit: Option<Written>,
    /// Share of the limit that is left; 0 unless given.
    #[cfg_attr(feature = "schema", schemars(with = "Option<super::schema::Number>"))]
    pub margin: Option<Written>,
    /// The file of a refit (JSON): its centre of mass and scale of sunlight are simulated, three sigma of its covariance are left.
    pub refit: Option<String>,
    /// Dumps that the plan may have; 0 unless given. A plan that needs more ends with status 1.
    #[cfg_attr(feature = "schema", schemars(with = "Option<u32>"))]
    pub dumps: Option<Written>,
}

/// Offsets of the arrays.
#[derive(Debug, Default, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub(super) struct SunOffsetDescription {
    /// Whether windows may leave the baseline, the fewest steps that keep the light on the cells in its corridor; false unless given.
    pub change: Option<bool>,
    /// Largest change off the baseline; "5 deg" unless given.
    #[cfg_attr(feature = "schema", schemars(with = "Option<super::schema::Number>"))]
    pub largest: Option<Written>,
}

/// Largest tilt, either way.
#[derive(Debug, Default, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub(super) struct TiltDescription {
    /// Of the Sun's azimuth, from -Y toward +X.
    #[cfg_attr(feature = "schema", schemars(with = "Option<super::schema::Number>"))]
    pub azimuth: Option<Written>,
    /// Of the Sun's elevation, positive toward -Z.
    #[cfg_attr(feature = "schema", schemars(with = "Option<super::schema::Number>"))]
    pub elevation: Option<Written>,
}

/// A ground contact.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub(super) struct ContactDescription {
    /// When it begins: a date or simulation time.
    #[cfg_attr(feature = "schema", schemars(with = "super::schema::Number"))]
    pub start: Written,
    /// When it ends.
    #[cfg_attr(feature = "schema", schemars(with = "super::schema::Number"))]
    pub stop: Written,
}

/// An activity that might be added.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub(super) struct ActivityDescription {
    /// What it is called.
    pub name: String,
    /// When it begins: a date or simulation time.
    #[cfg_attr(feature = "schema", schemars(with = "super::schema::Number"))]
    pub start: Written,
    /// When it ends.
    #[cfg_attr(feature = "schema", schemars(with = "super::schema::Number"))]
    pub stop: Written,
    /// Its command, with the keys of `[[command]]` in a timeline but at and until.
    #[cfg_attr(feature = "schema", schemars(with = "super::schema::Command"))]
    pub command: Written,
}

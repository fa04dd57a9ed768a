//! The shape of a timeline file: keys and items are named as the variables of Guidance.

use serde::Deserialize;

use super::entry::PlanStatus;
use super::quantity::Quantity;
use crate::bodies::Body;
use crate::guidance::modes::mode::Mode;
use crate::guidance::pointing::command::{
    AimpointOption, AzimuthReference, BodyRollOption, BoresightOption, ExternalRollOption, ScanFrame,
    Scenario,
};

/// What is commanded over time: attitudes, panels, events. A file has one of the three lists at least.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(title = "heliotorque timeline"))]
#[serde(deny_unknown_fields)]
pub(super) struct Description {
    /// The commands in the order of their times. Each lasts until the next one or until its own `until`.
    pub command: Option<Vec<CommandDescription>>,
    /// How the panels stand, in the order of the times, where MomentumPlant's `panel[k].control` is timeline. Each lasts until
    /// the next one.
    pub panels: Option<Vec<PanelsDescription>>,
    /// What happens at one time, in the order of the times. Guidance reads dumps alone.
    pub event: Option<Vec<EventDescription>>,
}

/// How the panels stand from a time on.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub(super) struct PanelsDescription {
    /// When it begins, in the clock of the commands.
    pub at: Quantity,
    /// Angle of the cells' normal from the Sun, its sign the sense of the tilt: one for all panels, or one a panel.
    pub sun_offset: AnglesDescription,
    /// Angle that the panels of both sides turn against one another: a panel stands at sunOffset plus windmill times its
    /// `windmill_side` in the spacecraft file. 0 unless given.
    pub windmill: Option<Quantity>,
}

/// An angle for all, or one each.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(untagged)]
pub(super) enum AnglesDescription {
    /// One each.
    Each(Vec<Quantity>),
    /// One for all.
    All(Quantity),
}

/// What happens at a time.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub(super) struct EventDescription {
    /// When, in the clock of the commands.
    pub at: Quantity,
    /// A dump of momentum: true, or the momentum after it in the body frame (N.m.s).
    pub dump: Option<DumpDescription>,
    pub maneuver: Option<ManeuverDescription>,
    /// Centre of mass from then on, body frame, with every panel at angle 0 and full tanks.
    pub center_of_mass: Option<[Quantity; 3]>,
}

/// A dump.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(untagged)]
pub(super) enum DumpDescription {
    /// To the momentum that parameters say.
    Is(bool),
    /// To this momentum, body frame.
    To(Vec<Quantity>),
}

/// An impulsive change of velocity.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub(super) struct ManeuverDescription {
    /// Velocity to add, EME2000.
    #[serde(rename = "deltaV")]
    pub delta_v: [Quantity; 3],
    /// Name of a set of thrusters in the spacecraft file; maneuver.thrusters unless given.
    pub thrusters: Option<String>,
    /// Whether a dump goes with it; maneuver.dump unless given.
    pub dump: Option<bool>,
}

/// A command.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub(super) struct CommandDescription {
    /// When it begins: a date that ends in UTC or TDB ("2008-03-19T19:30:00 UTC"), or FMI time: a number of seconds or a
    /// string with a unit ("90 min"). A file has one kind.
    pub at: Quantity,
    /// When it ends, if that is before the next one begins; then nothing is commanded.
    pub until: Option<Quantity>,
    pub scenario: Option<Scenario>,
    pub boresight: Option<BoresightDescription>,
    pub aimpoint: Option<AimpointDescription>,
    /// Aimpoint of the instrument on the gimbal in the scenario doubleTarget.
    pub second_aimpoint: Option<AimpointDescription>,
    pub body_roll: Option<BodyRollDescription>,
    pub external_roll: Option<ExternalRollDescription>,
    pub limb: Option<LimbDescription>,
    pub scan: Option<ScanDescription>,
    pub burn: Option<BurnDescription>,
    /// Where the Sun stands in downlink; on -Y unless given.
    pub sun: Option<SunDescription>,
    /// Whether the downlink attitude is turned by 180 deg about the Sun line, without a link; false unless given.
    pub alternate: Option<bool>,
    pub keep_in: Option<KeepInDescription>,
    /// A mode requested when the command begins; Safe Hold follows downlink alone.
    pub mode: Option<Mode>,
    /// For a plan: whether it may change this command. FMUs ignore it; fixed unless given.
    pub status: Option<PlanStatus>,
}

/// Where the Sun stands in the body frame.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub(super) struct SunDescription {
    /// Azimuth from -Y toward +X; 0 unless given.
    pub azimuth: Option<Quantity>,
    /// Elevation, positive toward -Z; 0 unless given.
    pub elevation: Option<Quantity>,
}

/// The boresight.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub(super) struct BoresightDescription {
    pub option: Option<BoresightOption>,
    /// Body-frame components, of any length.
    pub vector: Option<[f64; 3]>,
    /// Azimuth in the body frame, from -Y toward +X; of the antenna where an antenna is the boresight.
    pub azimuth: Option<Quantity>,
    /// Elevation in the body frame, positive toward -Z.
    pub elevation: Option<Quantity>,
    /// Angle of the gimbal, from the instrument's boresight in the file, right-handed about its axis.
    pub angle: Option<Quantity>,
    /// Instrument of a scenario: its name in the spacecraft file, or its row there from 1; 0 is +Z.
    pub instrument: Option<Quantity>,
}

/// An aimpoint.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub(super) struct AimpointDescription {
    pub option: AimpointOption,
    /// Direction in EME2000, of any length.
    pub vector: Option<[f64; 3]>,
    /// Position for the options earthCentered, sunCentered, planetCentered and planetFixed.
    pub position: Option<[Quantity; 3]>,
    /// Right ascension.
    pub right_ascension: Option<Quantity>,
    /// Declination.
    pub declination: Option<Quantity>,
    /// Planetocentric latitude.
    pub latitude: Option<Quantity>,
    /// Longitude, east positive.
    pub longitude: Option<Quantity>,
    /// Height above the ellipsoid along the radius; 0 unless given.
    pub height: Option<Quantity>,
    /// Azimuth in the local frame, right-handed about up.
    pub azimuth: Option<Quantity>,
    /// Elevation in the local frame, toward up.
    pub elevation: Option<Quantity>,
    pub body: Option<Body>,
}

/// The body roll vector.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub(super) struct BodyRollDescription {
    pub option: BodyRollOption,
    /// Body-frame components, of any length.
    pub vector: Option<[f64; 3]>,
    /// Azimuth in the body frame, from -Y toward +X.
    pub azimuth: Option<Quantity>,
    /// Elevation in the body frame, positive toward -Z.
    pub elevation: Option<Quantity>,
}

/// The external roll reference.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub(super) struct ExternalRollDescription {
    pub option: ExternalRollOption,
    /// Direction in EME2000, of any length.
    pub vector: Option<[f64; 3]>,
    /// Right ascension.
    pub right_ascension: Option<Quantity>,
    /// Declination.
    pub declination: Option<Quantity>,
}

/// Where at the limb, and how it is scanned.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub(super) struct LimbDescription {
    /// Azimuth about the local vertical, right-handed about up, in the scenario limbGeneric.
    pub azimuth: Option<Quantity>,
    pub reference: Option<AzimuthReference>,
    /// Height above the limb along its radius when the scenario starts; 0 unless given.
    pub height: Option<Quantity>,
    /// How fast the height grows; 0 unless given.
    pub height_rate: Option<Quantity>,
}

/// A scan pattern over the scenario.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub(super) struct ScanDescription {
    pub frame: ScanFrame,
    pub reference: Option<AzimuthReference>,
    /// Rates of rotations, right-handed, about x, y and z in turn.
    pub rate: Option<[Quantity; 3]>,
    /// Speeds of translations.
    pub speed: Option<[Quantity; 3]>,
    /// How long each axis moves.
    pub duration: Option<[Quantity; 3]>,
    /// How long each axis holds after a motion; 0 unless given.
    pub pause: Option<[Quantity; 3]>,
    /// How often each axis moves; 0, as if not given: without end.
    pub segments: Option<[u32; 3]>,
    /// Whether every second motion of an axis goes back; false unless given.
    pub reverse: Option<[bool; 3]>,
}

/// The burn of the scenario burn, instead of the FMU's parameters. It is cut off where the command ends.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub(super) struct BurnDescription {
    /// Velocity to add, without gravity, EME2000.
    #[serde(rename = "deltaV")]
    pub delta_v: [Quantity; 3],
    /// Name of a set of thrusters in the spacecraft file.
    pub thrusters: String,
    /// When thrust begins: a date, or a time after the command's `at`; when the attitude is reached unless given.
    pub start: Option<Quantity>,
    /// Longest time that thrust may last; burn.timeout unless given.
    pub duration: Option<Quantity>,
    /// Powered turn: row i holds what the powers 1, 2 and 3 of the progress, from 0 to 1, add to component i of the velocity;
    /// the sums are deltaV. Straight along deltaV unless given.
    pub profile: Option<[[Quantity; 3]; 3]>,
}

/// The Sun keep-in zone while the command lasts, instead of the FMU's parameters.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub(super) struct KeepInDescription {
    /// Whether commands keep the Sun inside the zone.
    pub enabled: Option<bool>,
    /// Largest Sun azimuth either way.
    pub azimuth: Option<Quantity>,
    /// Largest Sun elevation either way.
    pub elevation: Option<Quantity>,
}

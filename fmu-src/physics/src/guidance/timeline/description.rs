//! The shape of a timeline file: keys and items are named as the variables of Guidance.

use core::fmt;

use serde::de::value::SeqAccessDeserializer;
use serde::de::{self, IgnoredAny, MapAccess, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer};

use super::entry::PlanStatus;
use super::quantity::Quantity;
use crate::bodies::Body;
use crate::guidance::geometry::lvlh::AzimuthReference;
use crate::guidance::modes::mode::Mode;
use crate::guidance::pointing::command::{
    AimpointOption, BodyRollOption, BoresightOption, ExternalRollOption, ScanFrame, Scenario,
};
use crate::spacecraft::{StarDescription, TargetedAxisDescription};
use crate::toml::{Point, tables};

/// An angle for all, or one each.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(untagged)]
pub(crate) enum AnglesDescription {
    /// One each.
    Each(Vec<Quantity>),
    /// One for all.
    All(Quantity),
}

/// A dump.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(untagged)]
pub(crate) enum DumpDescription {
    /// To the momentum that parameters say.
    Is(bool),
    /// To this momentum, body frame.
    To(Vec<Quantity>),
}

/// An attitude.
#[derive(Debug)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(untagged))]
pub(crate) enum AttitudeDescription {
    /// By its name.
    Name(#[cfg_attr(feature = "schema", schemars(with = "crate::spacecraft::AttitudeName"))] String),
    /// By a quaternion from EME2000 to the body, scalar last.
    Quaternion(#[cfg_attr(feature = "schema", schemars(with = "[f64; 4]"))] Vec<f64>),
    /// By two axes and their targets.
    Axes(AxesDescription),
    /// Anything else.
    #[cfg_attr(feature = "schema", schemars(skip))]
    Other,
}

/// Two body axes and their targets.
#[derive(Debug, Default)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(deny_unknown_fields))]
pub(crate) struct AxesDescription {
    /// Axis that stands exactly at its target.
    pub align: Option<TargetedAxisDescription>,
    /// Axis that stands as near as possible to its target.
    pub constrain: Option<TargetedAxisDescription>,
    /// Direction of `to = "star"`.
    pub star: Option<StarDescription>,
    /// Other keys.
    #[cfg_attr(feature = "schema", schemars(skip))]
    pub unknown: Vec<String>,
}

impl<'de> Deserialize<'de> for AttitudeDescription {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(AttitudeVisitor)
    }
}

/// Takes every form; what is wrong with one is reported with its place.
struct AttitudeVisitor;

impl<'de> Visitor<'de> for AttitudeVisitor {
    type Value = AttitudeDescription;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an attitude")
    }

    fn visit_str<E: de::Error>(self, name: &str) -> Result<Self::Value, E> {
        Ok(AttitudeDescription::Name(name.to_owned()))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, numbers: A) -> Result<Self::Value, A::Error> {
        Deserialize::deserialize(SeqAccessDeserializer::new(numbers)).map(AttitudeDescription::Quaternion)
    }

    fn visit_map<A: MapAccess<'de>>(self, mut table: A) -> Result<Self::Value, A::Error> {
        let mut axes = AxesDescription::default();
        while let Some(key) = table.next_key::<String>()? {
            match key.as_str() {
                "align" => axes.align = Some(table.next_value()?),
                "constrain" => axes.constrain = Some(table.next_value()?),
                "star" => axes.star = Some(table.next_value()?),
                _ => {
                    table.next_value::<IgnoredAny>()?;
                    axes.unknown.push(key);
                }
            }
        }
        Ok(AttitudeDescription::Axes(axes))
    }

    fn visit_bool<E: de::Error>(self, _: bool) -> Result<Self::Value, E> {
        Ok(AttitudeDescription::Other)
    }

    fn visit_i64<E: de::Error>(self, _: i64) -> Result<Self::Value, E> {
        Ok(AttitudeDescription::Other)
    }

    fn visit_f64<E: de::Error>(self, _: f64) -> Result<Self::Value, E> {
        Ok(AttitudeDescription::Other)
    }
}

tables! {
/// What is commanded over time: attitudes, panels, events. A file has one of the three lists at least.
#[cfg_attr(feature = "schema", schemars(title = "heliotorque timeline"))]
struct TimelineDescription {
    /// The commands in the order of their times. Each lasts until the next one or until its own `until`.
    command: Option<Vec<CommandDescription>>,
    /// How the panels stand, in the order of the times, where MomentumPlant's `panel[k].control` is timeline. Each lasts until
    /// the next one.
    panels: Option<Vec<PanelsDescription>>,
    /// What happens at one time, in the order of the times. Guidance reads dumps alone.
    event: Option<Vec<EventDescription>>,
}

/// How the panels stand from a time on.
#[serde(rename_all = "camelCase")]
struct PanelsDescription {
    /// When it begins, in the clock of the commands.
    at: Quantity,
    /// Angle of the cells' normal from the Sun, its sign the sense of the tilt: one for all panels, or one a panel.
    sun_offset: AnglesDescription,
    /// Angle that the panels of both sides turn against one another: a panel stands at sunOffset plus windmill times its
    /// `windmill_side` in the spacecraft file. 0 unless given.
    windmill: Option<Quantity>,
}

/// What happens at a time.
#[serde(rename_all = "camelCase")]
struct EventDescription {
    /// When, in the clock of the commands.
    at: Quantity,
    /// A dump of momentum: true, or the momentum after it in the body frame (N.m.s).
    dump: Option<DumpDescription>,
    maneuver: Option<ManeuverDescription>,
    /// Centre of mass from then on, body frame, with every panel at angle 0 and full tanks.
    center_of_mass: Option<[Quantity; 3]>,
} rules {
    AnyOf dump maneuver centerOfMass: "an event of nothing", "at least one of dump, maneuver, centerOfMass";
}

/// An impulsive change of velocity.
#[serde(rename_all = "camelCase")]
struct ManeuverDescription {
    /// Velocity to add, EME2000.
    delta_v: [Quantity; 3],
    /// Name of a set of thrusters in the spacecraft file; maneuver.thrusters unless given.
    thrusters: Option<String>,
    /// Whether a dump goes with it; maneuver.dump unless given.
    dump: Option<bool>,
}

/// A command.
#[serde(rename_all = "camelCase")]
struct CommandDescription {
    /// When it begins: a date that ends in UTC, Z, TDB, TT or TAI, or a Julian date ("2008-03-19T19:30:00 UTC"), or FMI time: a number of seconds or a
    /// string with a unit ("90 min"). A file has one kind.
    at: Quantity,
    /// When it ends, if that is before the next one begins; then nothing is commanded.
    until: Option<Quantity>,
    /// Name in reports; the scenario's or the attitude's unless given.
    name: Option<String>,
    scenario: Option<Scenario>,
    /// Attitude instead of a scenario: a name, a quaternion from EME2000 to the body (scalar last), or two body axes and their
    /// targets.
    attitude: Option<AttitudeDescription>,
    boresight: Option<BoresightDescription>,
    aimpoint: Option<AimpointDescription>,
    /// Aimpoint of the instrument on the gimbal in the scenario doubleTarget.
    second_aimpoint: Option<AimpointDescription>,
    body_roll: Option<BodyRollDescription>,
    external_roll: Option<ExternalRollDescription>,
    limb: Option<LimbDescription>,
    scan: Option<ScanDescription>,
    burn: Option<BurnDescription>,
    /// Where the Sun stands in downlink; on -Y unless given.
    sun: Option<SunDescription>,
    /// Whether the downlink attitude is turned by 180 deg about the Sun line, without a link; false unless given.
    alternate: Option<bool>,
    keep_in: Option<KeepInDescription>,
    /// A mode requested when the command begins; Safe Hold follows downlink alone.
    mode: Option<Mode>,
    /// For a plan: whether it may change this command. FMUs ignore it; fixed unless given.
    status: Option<PlanStatus>,
} rules {
    Excludes attitude => scenario: "it beside `scenario`", "one of both";
    Excludes sun => boresight: "it beside `boresight`",
        "no `boresight` beside it, or no such key: the antenna follows from the Sun's place";
    Excludes alternate => boresight: "it beside `boresight`",
        "no `boresight` beside it, or no such key: the antenna follows from the Sun's place";
}

/// Where the Sun stands in the body frame.
struct SunDescription {
    /// Azimuth from -Y toward +X; 0 unless given.
    azimuth: Option<Quantity>,
    /// Elevation, positive toward -Z; 0 unless given.
    elevation: Option<Quantity>,
}

/// The boresight.
struct BoresightDescription {
    option: Option<BoresightOption>,
    /// Body-frame components, of any length.
    vector: Option<Point>,
    /// Azimuth in the body frame, from -Y toward +X; of the antenna where an antenna is the boresight.
    azimuth: Option<Quantity>,
    /// Elevation in the body frame, positive toward -Z.
    elevation: Option<Quantity>,
    /// Angle of the gimbal, from the instrument's boresight in the file, right-handed about its axis.
    angle: Option<Quantity>,
    /// Instrument of a scenario: its name in the spacecraft file, or its row there from 1; 0 is +Z.
    instrument: Option<Quantity>,
}

/// An aimpoint.
#[serde(rename_all = "camelCase")]
struct AimpointDescription {
    option: AimpointOption,
    /// Direction in EME2000, of any length.
    vector: Option<Point>,
    /// Position for the options earthCentered, sunCentered, planetCentered and planetFixed.
    position: Option<[Quantity; 3]>,
    /// Right ascension.
    right_ascension: Option<Quantity>,
    /// Declination.
    declination: Option<Quantity>,
    /// Planetocentric latitude.
    latitude: Option<Quantity>,
    /// Longitude, east positive.
    longitude: Option<Quantity>,
    /// Height above the ellipsoid along the radius; 0 unless given.
    height: Option<Quantity>,
    /// Azimuth in the local frame, right-handed about up.
    azimuth: Option<Quantity>,
    /// Elevation in the local frame, toward up.
    elevation: Option<Quantity>,
    body: Option<Body>,
}

/// The body roll vector.
struct BodyRollDescription {
    option: BodyRollOption,
    /// Body-frame components, of any length.
    vector: Option<Point>,
    /// Azimuth in the body frame, from -Y toward +X.
    azimuth: Option<Quantity>,
    /// Elevation in the body frame, positive toward -Z.
    elevation: Option<Quantity>,
}

/// The external roll reference.
#[serde(rename_all = "camelCase")]
struct ExternalRollDescription {
    option: ExternalRollOption,
    /// Direction in EME2000, of any length.
    vector: Option<Point>,
    /// Right ascension.
    right_ascension: Option<Quantity>,
    /// Declination.
    declination: Option<Quantity>,
}

/// Where at the limb, and how it is scanned.
#[serde(rename_all = "camelCase")]
struct LimbDescription {
    /// Azimuth about the local vertical, right-handed about up, in the scenario limbGeneric.
    azimuth: Option<Quantity>,
    reference: Option<AzimuthReference>,
    /// Height above the limb along its radius when the scenario starts; 0 unless given.
    height: Option<Quantity>,
    /// How fast the height grows; 0 unless given.
    height_rate: Option<Quantity>,
}

/// A scan pattern over the scenario.
struct ScanDescription {
    frame: ScanFrame,
    reference: Option<AzimuthReference>,
    /// Rates of rotations, right-handed, about x, y and z in turn.
    rate: Option<[Quantity; 3]>,
    /// Speeds of translations.
    speed: Option<[Quantity; 3]>,
    /// How long each axis moves.
    duration: Option<[Quantity; 3]>,
    /// How long each axis holds after a motion; 0 unless given.
    pause: Option<[Quantity; 3]>,
    /// How often each axis moves; 0, as if not given: without end.
    segments: Option<[u32; 3]>,
    /// Whether every second motion of an axis goes back; false unless given.
    reverse: Option<[bool; 3]>,
}

/// The burn of the scenario burn, instead of the FMU's parameters. It is cut off where the command ends.
#[serde(rename_all = "camelCase")]
struct BurnDescription {
    /// Velocity to add, without gravity, EME2000.
    delta_v: [Quantity; 3],
    /// Name of a set of thrusters in the spacecraft file.
    thrusters: String,
    /// When thrust begins: a date, or a time after the command's `at`; when the attitude is reached unless given.
    start: Option<Quantity>,
    /// Longest time that thrust may last; burn.timeout unless given.
    duration: Option<Quantity>,
    /// Powered turn: row i holds what the powers 1, 2 and 3 of the progress, from 0 to 1, add to component i of the velocity;
    /// the sums are deltaV. Straight along deltaV unless given.
    profile: Option<[[Quantity; 3]; 3]>,
}

/// The Sun keep-in zone while the command lasts, instead of the FMU's parameters.
struct KeepInDescription {
    /// Whether commands keep the Sun inside the zone.
    enabled: Option<bool>,
    /// Largest Sun azimuth either way.
    azimuth: Option<Quantity>,
    /// Largest Sun elevation either way.
    elevation: Option<Quantity>,
} rules {
    AnyOf enabled azimuth elevation: "an empty table", "at least one of enabled, azimuth, elevation";
}
}

/// The schema as indented JSON text (draft 2020-12): point an editor with TOML support at it.
#[cfg(feature = "schema")]
pub fn schema() -> String {
    crate::toml::schema::<TimelineDescription>()
}

#[cfg(feature = "schema")]
#[cfg(test)]
mod tests {
    //! Every table is closed and every key described.

    use toml::Value;

    use super::*;

    #[test]
    fn every_table_is_closed_and_every_key_described() {
        let root = Value::try_from(schemars::schema_for!(TimelineDescription).as_value()).unwrap();
        let definitions = root["$defs"].as_table().unwrap();
        for (name, node) in definitions.iter().chain([(&"timeline".to_owned(), &root)]) {
            let Some(properties) = node.get("properties").and_then(Value::as_table) else { continue };
            assert_eq!(node.get("additionalProperties"), Some(&Value::Boolean(false)), "{name}");
            for (key, property) in properties {
                let form = property.get("anyOf").map_or(property, |forms| &forms[0]);
                let of_type = form
                    .get("$ref")
                    .and_then(Value::as_str)
                    .and_then(|name| definitions[name.rsplit('/').next()?].get("description"));
                assert!(property.get("description").or(of_type).is_some(), "{name}.{key}");
            }
        }
    }
}

//! One command of a timeline: its tables are what its scenario reads, their numbers what their options read.

use nalgebra::Vector3;
use serde::Serialize;

use super::description::{
    AimpointDescription, BodyRollDescription, BoresightDescription, CommandDescription,
    ExternalRollDescription, KeepInDescription, LimbDescription,
};
use super::entry::KeepInOverride;
use super::quantity::{ANGLE, Kind, LENGTH, Quantity, SPEED};
use super::reads::{
    AimpointUse, BoresightUse, Keys, Reads, aimpoint_keys, body_roll_keys, boresight_keys,
    external_roll_keys, reads,
};
use crate::guidance::modes::mode::Mode;
use crate::guidance::pointing::command::{
    AimpointCommand, BodyRollCommand, BoresightCommand, BoresightOption, ExternalRollCommand, FULL_TURN_RAD,
    LimbCommand, PointingCommand, RIGHT_ANGLE_RAD, Scenario,
};
use crate::spacecraft::Instrument;
use crate::toml::{Checker, Place, nearest};

/// Whether each key of a table is given.
pub(super) type Given<'g> = &'g [(&'g str, bool)];

/// Builds commands and gathers what is wrong with them.
pub(super) struct Commands<'d, 'i> {
    pub check: Checker<'d>,
    instruments: &'i [Instrument],
    /// The scenario of the current command, for messages.
    scenario: String,
}

impl<'d, 'i> Commands<'d, 'i> {
    /// For a spacecraft with these instruments.
    pub fn new(check: Checker<'d>, instruments: &'i [Instrument]) -> Self {
        Self { check, instruments, scenario: String::new() }
    }

    /// Where a command points, without its scan.
    pub fn pointing(&mut self, at: &Place, given: &CommandDescription) -> PointingCommand {
        let tables = [
            ("boresight", given.boresight.is_some()),
            ("aimpoint", given.aimpoint.is_some()),
            ("secondAimpoint", given.second_aimpoint.is_some()),
            ("bodyRoll", given.body_roll.is_some()),
            ("externalRoll", given.external_roll.is_some()),
            ("limb", given.limb.is_some()),
            ("scan", given.scan.is_some()),
        ];
        let scenario_place = at.key("scenario");
        let Some(scenario) = given.scenario else {
            if let Some((table, _)) = tables.iter().find(|(_, is_given)| *is_given) {
                self.check.report_lack(at, "scenario", format_args!("a scenario, which `{table}` is for"));
            } else if given.keep_in.is_none() && given.mode.is_none() {
                let lacks = ["scenario", "keepIn", "mode"];
                if !lacks.iter().any(|key| self.check.is_stand_in(&at.key(key))) {
                    self.check.push(at, "a command of nothing", "at least one of scenario, keepIn, mode");
                }
            }
            return PointingCommand::default();
        };
        if self.check.is_stand_in(&scenario_place) {
            return PointingCommand::default();
        }
        if let Some(mode) = given.mode.filter(|mode| !follows(*mode, scenario)) {
            let allowed = match mode {
                Mode::SafeHold => "downlink, which alone Safe Hold follows, or no scenario",
                _ => "no scenario: Earth Acquisition follows none",
            };
            self.check.report(&scenario_place, named("the scenario", scenario), allowed);
        }
        self.scenario = named("the scenario", scenario);
        let reads = reads(scenario);
        self.tables(at, &tables, &reads);
        let second_aimpoint = given.second_aimpoint.as_ref().filter(|_| reads.second_aimpoint);
        PointingCommand {
            scenario: Some(scenario),
            boresight: self.boresight(&at.key("boresight"), given.boresight.as_ref(), reads.boresight),
            aimpoint: given.aimpoint.as_ref().map_or_else(AimpointCommand::default, |aimpoint| {
                self.aimpoint(&at.key("aimpoint"), aimpoint, reads.aimpoint)
            }),
            second_aimpoint: second_aimpoint.map_or_else(AimpointCommand::default, |aimpoint| {
                self.aimpoint(&at.key("secondAimpoint"), aimpoint, AimpointUse::Option)
            }),
            body_roll: given
                .body_roll
                .as_ref()
                .filter(|_| reads.rolls)
                .map_or_else(BodyRollCommand::default, |roll| self.body_roll(&at.key("bodyRoll"), roll)),
            external_roll: given
                .external_roll
                .as_ref()
                .filter(|_| reads.rolls)
                .map_or_else(ExternalRollCommand::default, |roll| {
                    self.external_roll(&at.key("externalRoll"), roll)
                }),
            limb: given
                .limb
                .as_ref()
                .zip(reads.limb)
                .map_or_else(LimbCommand::default, |(limb, keys)| self.limb(&at.key("limb"), limb, keys)),
            ..PointingCommand::default()
        }
    }

    /// Changes of the Sun keep-in zone.
    pub fn keep_in(&mut self, at: &Place, given: Option<&KeepInDescription>) -> KeepInOverride {
        let Some(given) = given else { return KeepInOverride::default() };
        let place = at.key("keepIn");
        if given.enabled.is_none() && given.azimuth.is_none() && given.elevation.is_none() {
            self.check.report(&place, "an empty table", "at least one of enabled, azimuth, elevation");
        }
        let mut angle = |key: &str, quantity: &Option<Quantity>| {
            let quantity = quantity.as_ref()?;
            let allowed = "an angle from 0 to 90 deg";
            Some(self.between(&place.key(key), quantity, &ANGLE, 0.0, RIGHT_ANGLE_RAD, allowed))
        };
        KeepInOverride {
            enabled: given.enabled,
            azimuth_rad: angle("azimuth", &given.azimuth),
            elevation_rad: angle("elevation", &given.elevation),
        }
    }

    /// Reports tables that the scenario does not read, and those that it needs.
    fn tables(&mut self, at: &Place, given: Given<'_>, reads: &Reads) {
        let mut needed = Vec::new();
        let mut read = Vec::new();
        if matches!(reads.boresight, BoresightUse::Option | BoresightUse::MdisAngle) {
            needed.push("boresight");
        } else if reads.boresight != BoresightUse::Nothing {
            read.push("boresight");
        }
        match reads.aimpoint {
            AimpointUse::Option => needed.push("aimpoint"),
            AimpointUse::Fixed(_) => read.push("aimpoint"),
            AimpointUse::Nothing => {}
        }
        if reads.second_aimpoint {
            needed.push("secondAimpoint");
        }
        if reads.rolls {
            needed.extend(["bodyRoll", "externalRoll"]);
        }
        match reads.limb {
            Some(Keys { needed: [], .. }) => read.push("limb"),
            Some(_) => needed.push("limb"),
            None => {}
        }
        if reads.scan {
            read.push("scan");
        }
        let scenario = self.scenario.clone();
        self.judge(at, given, &needed, &read, &scenario);
    }

    /// Reports keys that are given and not read, and keys that lack.
    pub fn judge(&mut self, at: &Place, given: Given<'_>, needed: &[&str], optional: &[&str], reader: &str) {
        for (key, is_given) in given {
            let is_needed = needed.contains(key);
            if *is_given && !is_needed && !optional.contains(key) {
                let read: Vec<&str> = needed.iter().chain(optional).copied().collect();
                let allowed = if read.is_empty() { "no other key".to_owned() } else { read.join(", ") };
                self.check.report(&at.key(key), format_args!("what {reader} does not read"), allowed);
            } else if is_needed && !*is_given {
                self.check.report_lack(at, key, format_args!("a value for `{key}`, which {reader} reads"));
            }
        }
    }

    fn boresight(
        &mut self,
        at: &Place,
        given: Option<&BoresightDescription>,
        used: BoresightUse,
    ) -> BoresightCommand {
        let Some(given) = given else { return BoresightCommand::default() };
        let keys = [
            ("option", given.option.is_some()),
            ("vector", given.vector.is_some()),
            ("azimuth", given.azimuth.is_some()),
            ("elevation", given.elevation.is_some()),
            ("angle", given.angle.is_some()),
            ("instrument", given.instrument.is_some()),
        ];
        let place = at.key("option");
        let option = given.option.filter(|_| !self.check.is_stand_in(&place));
        match (used, option) {
            (BoresightUse::Nothing, _) => return BoresightCommand::default(),
            (BoresightUse::Instrument, _) => {
                self.judge(at, &keys, &[], &["instrument"], &self.scenario.clone())
            }
            (BoresightUse::Option, Some(option)) => {
                let Keys { needed, .. } = boresight_keys(option);
                self.judge(at, &keys, needed, &["option"], &named("the option", option));
            }
            (BoresightUse::Option, None) => {
                self.judge(
                    at,
                    &[("option", given.option.is_some())],
                    &["option"],
                    &[],
                    &self.scenario.clone(),
                );
            }
            // That the scenario's own boresight is the boresight may be written.
            (BoresightUse::MdisAngle, None | Some(BoresightOption::Mdis)) => {
                self.judge(at, &keys, &["angle"], &["option"], &self.scenario.clone());
            }
            (BoresightUse::Antenna, None | Some(BoresightOption::PhasedArray)) => {
                let needed: &[&str] = if keys[0].1 || keys[2].1 { &["option", "azimuth"] } else { &[] };
                self.judge(at, &keys, needed, &[], &self.scenario.clone());
            }
            (BoresightUse::MdisAngle, Some(option)) => {
                self.check.report(&place, named("the option", option), "mdis, this scenario's boresight");
            }
            (BoresightUse::Antenna, Some(option)) => {
                let allowed = "phasedArray, this scenario's boresight, or no boresight";
                self.check.report(&place, named("the option", option), allowed);
            }
        }
        let instrument = given.instrument.as_ref();
        BoresightCommand {
            option: given.option,
            vector: self.direction(&at.key("vector"), given.vector),
            azimuth_rad: self.turn(&at.key("azimuth"), given.azimuth.as_ref()),
            elevation_rad: self.elevation(&at.key("elevation"), given.elevation.as_ref()),
            angle_rad: self.turn(&at.key("angle"), given.angle.as_ref()),
            instrument: instrument.map_or(0, |name| self.instrument(&at.key("instrument"), name)),
        }
    }

    /// The number of an instrument given by name or number.
    fn instrument(&mut self, at: &Place, given: &Quantity) -> u32 {
        let names: Vec<&str> = self.instruments.iter().map(|instrument| instrument.name.as_str()).collect();
        let found = match given {
            Quantity::Text(text) => names.iter().position(|name| name == text).map(|index| index + 1),
            Quantity::Number(number) => (0..=names.len()).find(|index| *index as f64 == *number),
            Quantity::Other(_) => None,
        };
        if found.is_none() {
            let hint = match given {
                Quantity::Text(text) => nearest(text, &names),
                _ => None,
            };
            let hint = hint.map(|name| format!(" (did you mean {name:?}?)")).unwrap_or_default();
            let allowed = if names.is_empty() {
                "0, which is +Z: the spacecraft has no [[instruments]]".to_owned()
            } else {
                format!(
                    "0 for +Z, or of the spacecraft's [[instruments]] the name or row: {}",
                    names.join(", ")
                )
            };
            self.check.report(at, format_args!("the unknown instrument {given}{hint}"), allowed);
        }
        found.and_then(|index| u32::try_from(index).ok()).unwrap_or_default()
    }

    fn aimpoint(&mut self, at: &Place, given: &AimpointDescription, used: AimpointUse) -> AimpointCommand {
        let keys = [
            ("vector", given.vector.is_some()),
            ("position", given.position.is_some()),
            ("rightAscension", given.right_ascension.is_some()),
            ("declination", given.declination.is_some()),
            ("latitude", given.latitude.is_some()),
            ("longitude", given.longitude.is_some()),
            ("height", given.height.is_some()),
            ("azimuth", given.azimuth.is_some()),
            ("elevation", given.elevation.is_some()),
            ("body", given.body.is_some()),
        ];
        let place = at.key("option");
        match used {
            AimpointUse::Nothing => return AimpointCommand::default(),
            AimpointUse::Fixed(option) if given.option != option => {
                let allowed = named("no aimpoint, or this scenario's own:", option);
                self.check.report(&place, named("the option", given.option), allowed);
            }
            _ if !self.check.is_stand_in(&place) => {
                let Keys { needed, optional } = aimpoint_keys(given.option);
                self.judge(at, &keys, needed, optional, &named("the option", given.option));
            }
            _ => {}
        }
        AimpointCommand {
            option: Some(given.option),
            vector: self.direction(&at.key("vector"), given.vector),
            position_m: given.position.as_ref().map_or_else(Vector3::zeros, |position| {
                Vector3::from(self.three(&at.key("position"), position, &LENGTH))
            }),
            velocity_m_s: Vector3::zeros(),
            right_ascension_rad: self.turn(&at.key("rightAscension"), given.right_ascension.as_ref()),
            declination_rad: self.elevation(&at.key("declination"), given.declination.as_ref()),
            latitude_rad: self.elevation(&at.key("latitude"), given.latitude.as_ref()),
            longitude_rad: self.turn(&at.key("longitude"), given.longitude.as_ref()),
            height_m: self.or_zero(&at.key("height"), given.height.as_ref(), &LENGTH),
            azimuth_rad: self.turn(&at.key("azimuth"), given.azimuth.as_ref()),
            elevation_rad: self.elevation(&at.key("elevation"), given.elevation.as_ref()),
            body: given.body,
        }
    }

    fn body_roll(&mut self, at: &Place, given: &BodyRollDescription) -> BodyRollCommand {
        let keys = [
            ("vector", given.vector.is_some()),
            ("azimuth", given.azimuth.is_some()),
            ("elevation", given.elevation.is_some()),
        ];
        if !self.check.is_stand_in(&at.key("option")) {
            let Keys { needed, optional } = body_roll_keys(given.option);
            self.judge(at, &keys, needed, optional, &named("the option", given.option));
        }
        BodyRollCommand {
            option: Some(given.option),
            vector: self.direction(&at.key("vector"), given.vector),
            azimuth_rad: self.turn(&at.key("azimuth"), given.azimuth.as_ref()),
            elevation_rad: self.elevation(&at.key("elevation"), given.elevation.as_ref()),
        }
    }

    fn external_roll(&mut self, at: &Place, given: &ExternalRollDescription) -> ExternalRollCommand {
        let keys = [
            ("vector", given.vector.is_some()),
            ("rightAscension", given.right_ascension.is_some()),
            ("declination", given.declination.is_some()),
        ];
        if !self.check.is_stand_in(&at.key("option")) {
            let Keys { needed, optional } = external_roll_keys(given.option);
            self.judge(at, &keys, needed, optional, &named("the option", given.option));
        }
        ExternalRollCommand {
            option: Some(given.option),
            vector: self.direction(&at.key("vector"), given.vector),
            right_ascension_rad: self.turn(&at.key("rightAscension"), given.right_ascension.as_ref()),
            declination_rad: self.elevation(&at.key("declination"), given.declination.as_ref()),
        }
    }

    fn limb(&mut self, at: &Place, given: &LimbDescription, read: Keys) -> LimbCommand {
        let keys = [
            ("azimuth", given.azimuth.is_some()),
            ("reference", given.reference.is_some()),
            ("height", given.height.is_some()),
            ("heightRate", given.height_rate.is_some()),
        ];
        self.judge(at, &keys, read.needed, read.optional, &self.scenario.clone());
        LimbCommand {
            azimuth_rad: self.turn(&at.key("azimuth"), given.azimuth.as_ref()),
            reference: given.reference,
            height_m: self.or_zero(&at.key("height"), given.height.as_ref(), &LENGTH),
            height_rate_m_s: self.or_zero(&at.key("heightRate"), given.height_rate.as_ref(), &SPEED),
        }
    }

    /// A quantity, in SI.
    pub fn quantity(&mut self, at: &Place, given: &Quantity, kind: &Kind) -> f64 {
        match given.si(kind) {
            Some(value) => self.check.finite(at, value),
            None => {
                self.check.report(at, given, kind);
                0.0
            }
        }
    }

    /// Three quantities, in SI.
    pub fn three(&mut self, at: &Place, given: &[Quantity; 3], kind: &Kind) -> [f64; 3] {
        let mut index = 0;
        given.each_ref().map(|quantity| {
            index += 1;
            self.quantity(&at.item(index - 1), quantity, kind)
        })
    }

    fn or_zero(&mut self, at: &Place, given: Option<&Quantity>, kind: &Kind) -> f64 {
        given.map_or(0.0, |quantity| self.quantity(at, quantity, kind))
    }

    fn between(
        &mut self,
        at: &Place,
        given: &Quantity,
        kind: &Kind,
        low: f64,
        high: f64,
        allowed: &str,
    ) -> f64 {
        let Some(value) = given.si(kind) else { return self.quantity(at, given, kind) };
        if !(low..=high).contains(&value) {
            match given {
                Quantity::Number(number) if kind.name == ANGLE.name => {
                    let fits_in_deg = (low..=high).contains(&number.to_radians());
                    let meant = if fits_in_deg {
                        format!(" (did you mean \"{number} deg\"?)")
                    } else {
                        String::new()
                    };
                    self.check.report(at, format_args!("{number} rad{meant}"), allowed);
                }
                _ => self.check.report(at, given, allowed),
            }
        }
        value
    }

    /// An angle of at most a turn, 0 unless given.
    fn turn(&mut self, at: &Place, given: Option<&Quantity>) -> f64 {
        let allowed = "an angle from -360 to 360 deg";
        given.map_or(0.0, |quantity| {
            self.between(at, quantity, &ANGLE, -FULL_TURN_RAD, FULL_TURN_RAD, allowed)
        })
    }

    /// An angle of at most a right angle, 0 unless given.
    fn elevation(&mut self, at: &Place, given: Option<&Quantity>) -> f64 {
        let allowed = "an angle from -90 to 90 deg";
        given.map_or(0.0, |quantity| {
            self.between(at, quantity, &ANGLE, -RIGHT_ANGLE_RAD, RIGHT_ANGLE_RAD, allowed)
        })
    }

    /// A vector that has a direction, if one is given.
    fn direction(&mut self, at: &Place, given: Option<[f64; 3]>) -> Vector3<f64> {
        let Some(given) = given else { return Vector3::zeros() };
        let vector = self.check.vector(at, given);
        if vector == Vector3::zeros() {
            self.check.report(at, "a zero vector", "a vector of any length but 0");
        }
        vector
    }
}

/// A scenario, option or frame by its name in the file, behind what it is.
pub(super) fn named(what: &str, item: impl Serialize) -> String {
    match toml::Value::try_from(item) {
        Ok(toml::Value::String(name)) => format!("{what} {name}"),
        _ => what.to_owned(),
    }
}

/// Whether a mode follows a scenario.
fn follows(mode: Mode, scenario: Scenario) -> bool {
    match mode {
        Mode::Operational => true,
        Mode::SafeHold => scenario == Scenario::Downlink,
        Mode::EarthAcquisition => false,
    }
}

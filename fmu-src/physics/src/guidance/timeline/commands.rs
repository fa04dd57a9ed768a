//! One command of a timeline: its tables are what its scenario reads, their numbers what their options read.

use nalgebra::Vector3;

use super::attitude::by_attitude;
use super::description::{
    AimpointDescription, BodyRollDescription, BoresightDescription, CommandDescription,
    ExternalRollDescription, KeepInDescription, LimbDescription,
};
use super::devices::{body, check_fan, check_gimbal, instrument};
use super::entry::{DownlinkOverride, KeepInOverride};
use super::quantity::{LATITUDE, LENGTH, QUARTER_TURN, Quantity, SPEED, TURN, or_zero, three};
use super::reads::{Keys, NOTHING, OptionKeys, TABLES, keys, limb_keys, own_aimpoint, tables};
use crate::attitude::SunAngles;
use crate::enumeration::Enumerated;
use crate::guidance::modes::mode::Mode;
use crate::guidance::pointing::command::{
    AimpointCommand, BodyRollCommand, BoresightCommand, BoresightOption, ExternalRollCommand, LimbCommand,
    PointingCommand, Scenario,
};
use crate::spacecraft::Spacecraft;
use crate::toml::{Place, Point, Table, Written};

const BORESIGHT: &[&str] = &["option", "vector", "azimuth", "elevation", "angle", "instrument"];
const AIMPOINT: &[&str] = &[
    "vector",
    "position",
    "rightAscension",
    "declination",
    "latitude",
    "longitude",
    "height",
    "azimuth",
    "elevation",
    "body",
];

/// Model that reads a timeline.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Reader {
    /// Guidance.
    Guidance,
    /// The plant, which has neither modes nor burns with a law.
    Plant,
}

/// Builds commands and reports what is wrong with them.
pub(super) struct Commands<'i> {
    pub spacecraft: &'i Spacecraft,
    pub reader: Reader,
    /// The scenario of the current command, or its attitude, for messages.
    pub scenario: String,
}

impl Commands<'_> {
    /// Returns the pointing of a command without its scan.
    pub(super) fn pointing(&mut self, at: &Place<'_>, given: &CommandDescription) -> PointingCommand {
        let scenario_place = at.key("scenario");
        at.rules(CommandDescription::RULES);
        self.check_reader(at, given);
        if let Some(attitude) = &given.attitude {
            let place = at.key("attitude");
            "the attitude".clone_into(&mut self.scenario);
            self.check_mode(&place, Scenario::Generic, given.mode);
            self.check_scenario_keys(at, TABLES, keys(&[], &["scan"]));
            return by_attitude(&place, attitude, &self.spacecraft.panels);
        }
        let Some(scenario) = given.scenario else {
            self.report_lack_of_scenario(at, given);
            return PointingCommand::default();
        };
        if scenario_place.is_stand_in() {
            return PointingCommand::default();
        }
        self.scenario = named("the scenario", scenario);
        self.check_mode(&scenario_place, scenario, given.mode);
        if matches!(scenario, Scenario::Gimbal | Scenario::DoubleTarget) {
            check_gimbal(self.spacecraft, &scenario_place, named("the scenario", scenario));
        }
        if scenario == Scenario::Downlink && self.spacecraft.antennas.is_empty() {
            let allowed = "a scenario without a downlink: the spacecraft has no antenna ([[antennas]])";
            scenario_place.report(named("the scenario", scenario), allowed);
        }
        let read = tables(scenario);
        self.check_scenario_keys(at, TABLES, read);
        let mut command = PointingCommand { scenario: Some(scenario), ..PointingCommand::default() };
        if let Some(boresight) = given.boresight.as_ref().filter(|_| read.has("boresight")) {
            command.boresight = self.boresight(&at.key("boresight"), boresight, scenario);
        }
        if let Some(aimpoint) = given.aimpoint.as_ref().filter(|_| read.has("aimpoint")) {
            command.aimpoint = self.aimpoint(&at.key("aimpoint"), aimpoint, scenario);
        }
        if let Some(aimpoint) = given.second_aimpoint.as_ref().filter(|_| read.has("secondAimpoint")) {
            command.second_aimpoint = self.aimpoint(&at.key("secondAimpoint"), aimpoint, scenario);
        }
        if let Some(roll) = given.body_roll.as_ref().filter(|_| read.has("bodyRoll")) {
            command.body_roll = self.body_roll(&at.key("bodyRoll"), roll);
        }
        if let Some(roll) = given.external_roll.as_ref().filter(|_| read.has("externalRoll")) {
            command.external_roll = self.external_roll(&at.key("externalRoll"), roll);
        }
        if let Some(limb) = given.limb.as_ref().filter(|_| read.has("limb")) {
            command.limb = self.limb(&at.key("limb"), limb, scenario);
        }
        command
    }

    /// Reports what the mode beside it does not follow.
    pub(super) fn check_mode(&self, at: &Place<'_>, scenario: Scenario, mode: Option<Mode>) {
        if let Some(mode) = mode.filter(|mode| !mode.follows(scenario)) {
            let allowed = match mode {
                Mode::SafeHold => "downlink, which alone Safe Hold follows, or no scenario",
                _ => "no scenario: Earth Acquisition follows none",
            };
            at.report(&self.scenario, allowed);
        }
    }

    /// Reports what Guidance alone does.
    fn check_reader(&self, at: &Place<'_>, given: &CommandDescription) {
        if self.reader != Reader::Plant {
            return;
        }
        if let Some(mode) = given.mode {
            let allowed = "no such key: MomentumPlant has no modes; FMU Guidance has, and commands it";
            at.key("mode").report(named("the mode", mode), allowed);
        }
        if given.scenario == Some(Scenario::Burn) {
            let allowed = "another scenario: in MomentumPlant a change of velocity is an [[event]] with `maneuver`; FMU Guidance \
                           steers burns";
            at.key("scenario").report(named("the scenario", Scenario::Burn), allowed);
        }
    }

    /// Returns a command's direction of the Sun in a downlink.
    pub(super) fn downlink(&self, at: &Place<'_>, given: &CommandDescription) -> DownlinkOverride {
        let place = at.key("sun");
        let sun = given.sun.as_ref().map(|sun| SunAngles {
            azimuth_rad: or_zero(&place.key("azimuth"), &sun.azimuth, &TURN),
            elevation_rad: or_zero(&place.key("elevation"), &sun.elevation, &LATITUDE),
        });
        DownlinkOverride { sun, alternate: given.alternate.unwrap_or_default() }
    }

    /// Changes of the Sun keep-in zone.
    pub(super) fn keep_in(&self, at: &Place<'_>, given: Option<&KeepInDescription>) -> KeepInOverride {
        let Some(given) = given else { return KeepInOverride::default() };
        let place = at.key("keepIn");
        place.rules(KeepInDescription::RULES);
        let angle = |key: &str, quantity: &Option<Quantity>| {
            Some(quantity.as_ref()?.read(&place.key(key), &QUARTER_TURN))
        };
        KeepInOverride {
            enabled: given.enabled,
            azimuth_rad: angle("azimuth", &given.azimuth),
            elevation_rad: angle("elevation", &given.elevation),
        }
    }

    fn report_lack_of_scenario(&self, at: &Place<'_>, given: &CommandDescription) {
        if let Some(table) = TABLES.iter().find(|table| at.key(table).is_written()) {
            at.report_lack("scenario", format_args!("a scenario, which `{table}` is for"));
        } else if given.keep_in.is_none() && given.mode.is_none() {
            let lacks = ["scenario", "attitude", "keepIn", "mode"];
            if !lacks.iter().any(|key| at.key(key).is_stand_in()) {
                at.push("a command of nothing", "at least one of scenario, attitude, keepIn, mode");
            }
        }
    }

    /// Reports keys among the `known` ones that the scenario does not read, and keys that lack.
    fn check_scenario_keys(&self, at: &Place<'_>, known: &[&str], read: Keys) {
        read.check(at, known, &self.scenario);
    }

    /// The same where an option reads them, unless nobody wrote the option.
    fn check_option_keys(at: &Place<'_>, known: &[&str], option: impl OptionKeys) {
        if !at.key("option").is_stand_in() {
            option.keys().check(at, known, &named("the option", option));
        }
    }

    /// Reports a boresight for which the spacecraft has no device.
    fn check_device(&self, at: &Place<'_>, option: BoresightOption) {
        let found = named("the option", option);
        match option {
            BoresightOption::Gimbal => check_gimbal(self.spacecraft, at, found),
            BoresightOption::PhasedArray => check_fan(self.spacecraft, at, found),
            BoresightOption::Vector | BoresightOption::AzimuthElevation => {}
        }
    }

    fn boresight(
        &self,
        at: &Place<'_>,
        given: &BoresightDescription,
        scenario: Scenario,
    ) -> BoresightCommand {
        let place = at.key("option");
        match (scenario, given.option.filter(|_| !place.is_stand_in())) {
            (Scenario::Generic, Some(option)) => {
                self.check_device(&place, option);
                Self::check_option_keys(at, &BORESIGHT[1..], option);
            }
            (Scenario::Generic, None) => self.check_scenario_keys(at, &["option"], keys(&["option"], &[])),
            // That the scenario's own boresight is the boresight may be written.
            (Scenario::Gimbal, None | Some(BoresightOption::Gimbal)) => {
                self.check_scenario_keys(at, BORESIGHT, keys(&["angle"], &["option"]));
            }
            (Scenario::Downlink, None | Some(BoresightOption::PhasedArray)) => {
                let is_given = ["option", "azimuth"].iter().any(|key| at.key(key).is_written());
                let read = if is_given { keys(&["option", "azimuth"], &[]) } else { NOTHING };
                if is_given && !self.spacecraft.antennas.is_empty() {
                    self.check_device(&place, BoresightOption::PhasedArray);
                }
                self.check_scenario_keys(at, BORESIGHT, read);
            }
            (Scenario::Gimbal, Some(option)) => {
                place.report(named("the option", option), "gimbal, this scenario's boresight");
            }
            (Scenario::Downlink, Some(option)) => {
                let allowed = "phasedArray, this scenario's boresight, or no boresight";
                place.report(named("the option", option), allowed);
            }
            _ => self.check_scenario_keys(at, BORESIGHT, keys(&[], &["instrument"])),
        }
        let named_instrument = given.instrument.as_ref();
        BoresightCommand {
            option: given.option,
            vector: direction(&at.key("vector"), given.vector),
            azimuth_rad: or_zero(&at.key("azimuth"), &given.azimuth, &TURN),
            elevation_rad: or_zero(&at.key("elevation"), &given.elevation, &LATITUDE),
            angle_rad: or_zero(&at.key("angle"), &given.angle, &TURN),
            instrument: named_instrument
                .map_or(0, |name| instrument(self.spacecraft, &at.key("instrument"), name)),
        }
    }

    fn aimpoint(&self, at: &Place<'_>, given: &AimpointDescription, scenario: Scenario) -> AimpointCommand {
        match own_aimpoint(scenario).filter(|own| *own != given.option) {
            Some(own) => {
                let allowed = named("no aimpoint, or this scenario's own:", own);
                at.key("option").report(named("the option", given.option), allowed);
            }
            None => Self::check_option_keys(at, AIMPOINT, given.option),
        }
        AimpointCommand {
            option: Some(given.option),
            vector: direction(&at.key("vector"), given.vector),
            position_m: three(&at.key("position"), given.position.as_ref(), &LENGTH).into(),
            velocity_m_s: Vector3::zeros(),
            right_ascension_rad: or_zero(&at.key("rightAscension"), &given.right_ascension, &TURN),
            declination_rad: or_zero(&at.key("declination"), &given.declination, &LATITUDE),
            latitude_rad: or_zero(&at.key("latitude"), &given.latitude, &LATITUDE),
            longitude_rad: or_zero(&at.key("longitude"), &given.longitude, &TURN),
            height_m: or_zero(&at.key("height"), &given.height, &LENGTH),
            azimuth_rad: or_zero(&at.key("azimuth"), &given.azimuth, &TURN),
            elevation_rad: or_zero(&at.key("elevation"), &given.elevation, &LATITUDE),
            body: body(self.spacecraft, &at.key("body"), given.body),
        }
    }

    fn body_roll(&self, at: &Place<'_>, given: &BodyRollDescription) -> BodyRollCommand {
        let known = &["vector", "azimuth", "elevation"];
        Self::check_option_keys(at, known, given.option);
        BodyRollCommand {
            option: Some(given.option),
            vector: direction(&at.key("vector"), given.vector),
            azimuth_rad: or_zero(&at.key("azimuth"), &given.azimuth, &TURN),
            elevation_rad: or_zero(&at.key("elevation"), &given.elevation, &LATITUDE),
        }
    }

    fn external_roll(&self, at: &Place<'_>, given: &ExternalRollDescription) -> ExternalRollCommand {
        let known = &["vector", "rightAscension", "declination"];
        Self::check_option_keys(at, known, given.option);
        ExternalRollCommand {
            option: Some(given.option),
            vector: direction(&at.key("vector"), given.vector),
            right_ascension_rad: or_zero(&at.key("rightAscension"), &given.right_ascension, &TURN),
            declination_rad: or_zero(&at.key("declination"), &given.declination, &LATITUDE),
        }
    }

    fn limb(&self, at: &Place<'_>, given: &LimbDescription, scenario: Scenario) -> LimbCommand {
        self.check_scenario_keys(at, &["azimuth", "reference", "height", "heightRate"], limb_keys(scenario));
        LimbCommand {
            azimuth_rad: or_zero(&at.key("azimuth"), &given.azimuth, &TURN),
            reference: given.reference,
            height_m: or_zero(&at.key("height"), &given.height, &LENGTH),
            height_rate_m_s: or_zero(&at.key("heightRate"), &given.height_rate, &SPEED),
        }
    }
}

/// A vector that has a direction, if one is given.
fn direction(at: &Place<'_>, given: Option<Point>) -> Vector3<f64> {
    let vector = given.value().unwrap_or_default();
    if given.is_some() && vector == Vector3::zeros() {
        at.report("a zero vector", "a vector of any length but 0");
    }
    vector
}

/// A scenario, option or frame by its name in the file, behind what it is.
pub(super) fn named(what: &str, item: impl Enumerated) -> String {
    format!("{what} {}", item.name())
}

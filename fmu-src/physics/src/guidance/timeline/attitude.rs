//! A command's attitude instead of a scenario, as a command of the scenario generic; and its name.

use nalgebra::Vector3;

use super::commands::{Commands, named};
use super::description::CommandDescription;
use super::reads::{TABLES, keys};
use crate::attitude::Attitude;
use crate::guidance::pointing::command::{
    AimpointCommand, AimpointOption, BodyRollCommand, BodyRollOption, BoresightCommand, BoresightOption,
    ExternalRollCommand, ExternalRollOption, PointingCommand, Scenario,
};
use crate::toml::KeyPath;

impl Commands<'_, '_> {
    /// The command of an attitude, without its scan.
    pub(super) fn by_attitude(
        &mut self,
        at: &KeyPath,
        attitude: &[f64; 4],
        given: &CommandDescription,
    ) -> PointingCommand {
        let place = at.key("attitude");
        if given.scenario.is_some() {
            self.check.report(&place, "it beside `scenario`", "one of both");
        }
        "the attitude".clone_into(&mut self.scenario);
        self.check_mode(&place, Scenario::Generic, given.mode);
        self.check_scenario_keys(at, TABLES, keys(&[], &["scan"]));
        match Attitude::from_quaternion(*attitude) {
            Ok(attitude) => held(&attitude),
            Err(error) => {
                let allowed = "a quaternion from EME2000 to the body, scalar last, of norm 1 within 1e-3";
                self.check.report(&place, format_args!("a norm of {}", error.norm), allowed);
                PointingCommand::default()
            }
        }
    }

    /// The name of a command: its own, or its scenario's or attitude's.
    pub(super) fn name(&mut self, at: &KeyPath, given: &CommandDescription) -> String {
        /// Longest name in a report.
        const MOST: usize = 60;
        match (&given.name, given.scenario) {
            (Some(name), _) => {
                if name.trim().is_empty() || name.chars().count() > MOST || name.chars().any(char::is_control) {
                    let allowed = format!("a text of 1 to {MOST} characters on one line");
                    self.check.report(&at.key("name"), format_args!("{name:?}"), allowed);
                }
                name.clone()
            }
            (None, Some(scenario)) => named("", scenario).trim_start().to_owned(),
            (None, None) if given.attitude.is_some() => "inertial".to_owned(),
            (None, None) => "guided".to_owned(),
        }
    }
}

/// The command that holds an attitude.
fn held(attitude: &Attitude) -> PointingCommand {
    let inertial = |axis_body: Vector3<f64>| attitude.to_inertial(&axis_body);
    let (boresight_body, roll_body) = (Vector3::z(), -Vector3::y());
    PointingCommand {
        scenario: Some(Scenario::Generic),
        boresight: BoresightCommand {
            option: Some(BoresightOption::Vector),
            vector: boresight_body,
            ..BoresightCommand::default()
        },
        aimpoint: AimpointCommand {
            option: Some(AimpointOption::Vector),
            vector: inertial(boresight_body),
            ..AimpointCommand::default()
        },
        body_roll: BodyRollCommand {
            option: Some(BodyRollOption::Vector),
            vector: roll_body,
            ..BodyRollCommand::default()
        },
        external_roll: ExternalRollCommand {
            option: Some(ExternalRollOption::Vector),
            vector: inertial(roll_body),
            ..ExternalRollCommand::default()
        },
        ..PointingCommand::default()
    }
}

//! Events at one time: dumps, impulsive maneuvers, another centre of mass.

use nalgebra::Vector3;

use super::burn::thruster_set;
use super::commands::Commands;
use super::description::{DumpDescription, EventDescription, ManeuverDescription};
use super::entry::{TimelineDump, TimelineEvent, TimelineManeuver};
use super::quantity::{LENGTH, MOMENTUM, Quantity, SPEED};
use crate::toml::{KeyPath, Table};

/// The event of the list's item at `at`, at `at_s` of the clock.
pub(super) fn event(
    commands: &mut Commands<'_, '_>,
    at: &KeyPath,
    given: &EventDescription,
    at_s: f64,
) -> TimelineEvent {
    commands.check.rules(at, EventDescription::RULES);
    let maneuver = given.maneuver.as_ref().map(|it| maneuver(commands, &at.key("maneuver"), it));
    let center_of_mass = given.center_of_mass.as_ref();
    TimelineEvent {
        line: commands.check.line(at),
        at_s,
        dump: given.dump.as_ref().and_then(|it| dump(commands, &at.key("dump"), it)),
        maneuver,
        center_of_mass_body_m: center_of_mass
            .map(|it| commands.three(&at.key("centerOfMass"), &Some(it.clone()), &LENGTH).into()),
    }
}

fn dump(commands: &mut Commands<'_, '_>, at: &KeyPath, given: &DumpDescription) -> Option<TimelineDump> {
    match given {
        DumpDescription::Is(true) => Some(TimelineDump::Requested),
        DumpDescription::Is(false) => {
            commands.check.report(at, "false", "true, the momentum after it, or no such key");
            None
        }
        DumpDescription::To(momentum) => {
            let Ok(momentum) = <[Quantity; 3]>::try_from(momentum.clone()) else {
                let found = format!("{} numbers", momentum.len());
                commands.check.report(at, found, "true, or three numbers: the momentum after it, body frame");
                return None;
            };
            let momentum = commands.three(at, &Some(momentum), &MOMENTUM);
            Some(TimelineDump::To { momentum_body_n_m_s: momentum.into() })
        }
    }
}

fn maneuver(commands: &mut Commands<'_, '_>, at: &KeyPath, given: &ManeuverDescription) -> TimelineManeuver {
    let place = at.key("deltaV");
    let delta_v = Vector3::from(commands.three(&place, &Some(given.delta_v.clone()), &SPEED));
    if delta_v == Vector3::zeros() && !commands.check.has_reported(&place) {
        commands.check.report(&place, "a zero vector", "a velocity of any size but 0, in m/s");
    }
    let name = given.thrusters.as_ref();
    TimelineManeuver {
        delta_v_inertial_m_s: delta_v,
        thrusters: name.and_then(|name| thruster_set(commands, &at.key("thrusters"), name)),
        dumps: given.dump,
    }
}

//! Panels from a time on, and events at one time: dumps, impulsive maneuvers, another centre of mass.

use nalgebra::Vector3;

use super::burn::thruster_set;
use super::commands::Commands;
use super::description::{
    AnglesDescription, DumpDescription, EventDescription, ManeuverDescription, PanelsDescription,
};
use super::entry::{TimelineDump, TimelineEvent, TimelineManeuver, TimelinePanels};
use super::quantity::{HALF_TURN, LENGTH, MOMENTUM, Quantity, SPEED};
use crate::toml::{KeyPath, Table};

/// The panels of the list's item at `at`, from `at_s` of the clock on.
pub(super) fn panels(
    commands: &mut Commands<'_, '_>,
    at: &KeyPath,
    given: &PanelsDescription,
    at_s: f64,
) -> TimelinePanels {
    let count = commands.spacecraft.panels.len();
    let place = at.key("sunOffset");
    if count == 0 {
        commands.check.report(at, "[[panels]]", "no such list: the spacecraft has no [[panels]]");
    }
    let sun_offsets_rad = match &given.sun_offset {
        AnglesDescription::All(angle) => vec![commands.quantity(&place, angle, &HALF_TURN); count],
        AnglesDescription::Each(angles) => {
            if angles.len() != count {
                let found = format!("{} of them", angles.len());
                let allowed = format!("one angle, or one for each of the spacecraft's {count} panels");
                commands.check.report(&place, found, allowed);
            }
            let each = angles.iter().enumerate();
            each.map(|(index, angle)| commands.quantity(&place.item(index), angle, &HALF_TURN)).collect()
        }
    };
    let windmill_place = at.key("windmill");
    let windmill = given.windmill.as_ref();
    let windmill_rad = windmill.map_or(0.0, |angle| commands.quantity(&windmill_place, angle, &HALF_TURN));
    if windmill_rad != 0.0 && commands.spacecraft.panels.iter().all(|panel| panel.windmill_side == 0.0) {
        let allowed =
            "0, or no such key: no panel of the spacecraft has a side, see [[panels]] windmill_side";
        commands.check.report(&windmill_place, format!("{windmill_rad:?} rad"), allowed);
    }
    TimelinePanels { line: commands.check.line(at), at_s, sun_offsets_rad, windmill_rad }
}

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

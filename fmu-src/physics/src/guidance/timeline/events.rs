//! Panels from a time on, and events at one time: dumps, impulsive maneuvers, another centre of mass.

use nalgebra::Vector3;

use super::burn::thruster_set;
use super::description::{
    AnglesDescription, DumpDescription, EventDescription, ManeuverDescription, PanelsDescription,
};
use super::entry::{TimelineDump, TimelineEvent, TimelineManeuver, TimelinePanels};
use super::quantity::{HALF_TURN, LENGTH, MOMENTUM, Quantity, SPEED, or_zero, three};
use crate::spacecraft::{Panel, Spacecraft};
use crate::toml::{Place, Table};

/// The panels of the list's item at `at`, from `at_s` of the clock on.
pub(super) fn panels(
    at: &Place<'_>,
    given: &PanelsDescription,
    at_s: f64,
    panels: &[Panel],
) -> TimelinePanels {
    let count = panels.len();
    let place = at.key("sunOffset");
    if count == 0 {
        at.report("[[panels]]", "no such list: the spacecraft has no [[panels]]");
    }
    let sun_offsets_rad = match &given.sun_offset {
        AnglesDescription::All(angle) => vec![angle.read(&place, &HALF_TURN); count],
        AnglesDescription::Each(angles) => {
            if angles.len() != count {
                let found = format!("{} of them", angles.len());
                let allowed = format!("one angle, or one for each of the spacecraft's {count} panels");
                place.report(found, allowed);
            }
            place.items(angles).map(|(at, angle)| angle.read(&at, &HALF_TURN)).collect()
        }
    };
    let windmill_place = at.key("windmill");
    let windmill_rad = or_zero(&windmill_place, &given.windmill, &HALF_TURN);
    if windmill_rad != 0.0 && panels.iter().all(|panel| panel.windmill_side == 0.0) {
        let allowed =
            "0, or no such key: no panel of the spacecraft has a side, see [[panels]] windmill_side";
        windmill_place.report(format!("{windmill_rad:?} rad"), allowed);
    }
    TimelinePanels { line: at.line(), at_s, sun_offsets_rad, windmill_rad }
}

/// The event of the list's item at `at`, at `at_s` of the clock.
pub(super) fn event(
    spacecraft: &Spacecraft,
    at: &Place<'_>,
    given: &EventDescription,
    at_s: f64,
) -> TimelineEvent {
    at.rules(EventDescription::RULES);
    let maneuver = given.maneuver.as_ref().map(|it| maneuver(spacecraft, &at.key("maneuver"), it));
    let center_of_mass = given.center_of_mass.as_ref();
    TimelineEvent {
        line: at.line(),
        at_s,
        dump: given.dump.as_ref().and_then(|it| dump(&at.key("dump"), it)),
        maneuver,
        center_of_mass_body_m: center_of_mass
            .map(|it| three(&at.key("centerOfMass"), Some(it), &LENGTH).into()),
    }
}

fn dump(at: &Place<'_>, given: &DumpDescription) -> Option<TimelineDump> {
    match given {
        DumpDescription::Is(true) => Some(TimelineDump::Requested),
        DumpDescription::Is(false) => {
            at.report("false", "true, the momentum after it, or no such key");
            None
        }
        DumpDescription::To(momentum) => {
            let found = format!("{} numbers", momentum.len());
            let momentum = <[Quantity; 3]>::try_from(momentum.clone()).ok();
            let momentum =
                at.known(momentum, found, "true, or three numbers: the momentum after it, body frame")?;
            let momentum = three(at, Some(&momentum), &MOMENTUM);
            Some(TimelineDump::To { momentum_body_n_m_s: momentum.into() })
        }
    }
}

fn maneuver(spacecraft: &Spacecraft, at: &Place<'_>, given: &ManeuverDescription) -> TimelineManeuver {
    let place = at.key("deltaV");
    let delta_v = Vector3::from(three(&place, Some(&given.delta_v), &SPEED));
    if delta_v == Vector3::zeros() && !place.has_reported() {
        place.report("a zero vector", "a velocity of any size but 0, in m/s");
    }
    let name = given.thrusters.as_ref();
    TimelineManeuver {
        delta_v_inertial_m_s: delta_v,
        thrusters: name.and_then(|name| thruster_set(spacecraft, &at.key("thrusters"), name)),
        dumps: given.dump,
    }
}

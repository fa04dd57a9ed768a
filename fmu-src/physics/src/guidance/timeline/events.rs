//! Events at one time: dumps, impulsive maneuvers, another centre of mass.

use nalgebra::Vector3;

use super::burn::thruster_set;
use super::description::{DumpDescription, EventDescription, ManeuverDescription};
use super::entry::{TimelineDump, TimelineEvent, TimelineManeuver};
use super::quantity::{LENGTH, MOMENTUM, Quantity, SPEED, three};
use crate::spacecraft::Spacecraft;
use crate::toml::{Place, Table};

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

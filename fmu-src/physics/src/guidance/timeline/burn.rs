//! The burn of a command: the velocity to add, by which thrusters, and when.

use nalgebra::Vector3;

use super::description::BurnDescription;
use super::entry::{TimelineBurn, TimelineClock};
use super::quantity::{SPEED, TIME, three};
use super::times::{instant, is_date};
use crate::guidance::burn::nominal_thrust::NominalThrust;
use crate::guidance::burn::velocity_path::VelocityPath;
use crate::numerics::Span;
use crate::spacecraft::{Spacecraft, ThrusterSet};
use crate::toml::{Place, Positive, hint};

/// The burn of the command at `at`, within its span on this clock, whose end may be infinite.
pub(super) fn burn(
    spacecraft: &Spacecraft,
    at: &Place<'_>,
    given: &BurnDescription,
    clock: TimelineClock,
    span: Span,
) -> TimelineBurn {
    let delta_v_m_s = Vector3::from(three(&at.key("deltaV"), Some(&given.delta_v), &SPEED));
    let profile_place = at.key("profile");
    let rows = given.profile.as_ref().map_or([[0.0; 3]; 3], |rows| {
        [0, 1, 2].map(|i| three(&profile_place.item(i), Some(&rows[i]), &SPEED))
    });
    let columns = [0, 1, 2].map(|power| Vector3::from(rows.map(|component| component[power])));
    let path = match VelocityPath::of_burn(delta_v_m_s, columns) {
        Ok(Some(path)) => Some(path),
        Ok(None) => {
            at.key("deltaV").report("a zero vector", "a velocity of any size but 0, in m/s");
            None
        }
        Err(error) => {
            let allowed =
                "rows whose sums are deltaV, one a component: its powers 1, 2 and 3 of the progress";
            profile_place.report(error, allowed);
            None
        }
    };
    let set = thruster_set(spacecraft, &at.key("thrusters"), &given.thrusters);
    let begin_s = start(at, given, clock, span.start_s);
    let duration_s = given.duration.as_ref().map(|duration| {
        let place = at.key("duration");
        let duration_s = duration.read(&place, &TIME);
        place.within(duration_s, [f64::MIN_POSITIVE, 1e12], Positive::ALLOWED)
    });
    let nominal = NominalThrust::new(spacecraft, set, Vector3::zeros());
    let acceleration_m_s2 = nominal.acceleration_m_s2;
    let nominal_s =
        path.filter(|_| acceleration_m_s2 > 0.0).map(|path| path.length_m_s() / acceleration_m_s2);
    let lasts_s = duration_s.or(nominal_s).unwrap_or(0.0);
    let first_s = begin_s.unwrap_or(span.start_s);
    if first_s.is_finite() && first_s < span.start_s {
        let written = given.start.as_ref().map(ToString::to_string).unwrap_or_default();
        let allowed = "a time after `at`, or no such key: when the attitude is reached";
        at.key("start").report(format_args!("{written}, before the command begins"), allowed);
    } else if first_s + lasts_s > span.end_s {
        let key = if given.start.is_some() { "start" } else { "duration" };
        let place = if at.key(key).is_written() { at.key(key) } else { at.clone() };
        let late_s = first_s + lasts_s - span.end_s;
        let found = format!("a burn that lasts {lasts_s:.1} s and ends {late_s:.1} s after the command does");
        place.report(found, "one that ends before `until` and the next command");
    }
    TimelineBurn { path, thrusters: set, nominal, start_s: begin_s, duration_s }
}

/// When the burn begins, in s of the clock; `None` when the attitude is reached.
fn start(at: &Place<'_>, given: &BurnDescription, clock: TimelineClock, since_s: f64) -> Option<f64> {
    let (place, written) = (at.key("start"), given.start.as_ref()?);
    if !is_date(written) {
        return Some(since_s + written.read(&place, &TIME));
    }
    let (counted_by, start_s) = instant(&place, written)?;
    if counted_by != clock {
        let allowed = "a time after `at`, as FMI time in s or with a unit: this file counts in FMI time";
        place.report(format_args!("{written}, a date"), allowed);
        return None;
    }
    Some(start_s)
}

/// The set of this name.
pub(super) fn thruster_set(spacecraft: &Spacecraft, at: &Place<'_>, name: &str) -> Option<ThrusterSet> {
    let sets: Vec<&str> = spacecraft.thruster_sets.iter().map(String::as_str).collect();
    let allowed = match sets.is_empty() {
        true => "a set of thrusters; the spacecraft has none: give its [[thrusters]] a `set`".to_owned(),
        false => format!("a set of the spacecraft's thrusters: {}", sets.join(", ")),
    };
    let unknown = format!("the unknown set `{name}`{}", hint(name, &sets));
    at.known(spacecraft.thruster_set(name), unknown, allowed)
}

//! How the panels stand from a time on.

use super::description::{AnglesDescription, PanelsDescription};
use super::entry::TimelinePanels;
use super::quantity::{HALF_TURN, or_zero};
use crate::spacecraft::Panel;
use crate::toml::Place;

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

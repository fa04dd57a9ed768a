//! How the panels stand from a time on.

use super::commands::Commands;
use super::description::{AnglesDescription, PanelsDescription};
use super::entry::TimelinePanels;
use super::quantity::HALF_TURN;
use crate::toml::KeyPath;

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

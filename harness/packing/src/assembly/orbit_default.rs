//! The default of `orbit.dynamics` by the values of a mission, which the FMU that simulates it is set to later.

use fmi::{Binary, Described};
use inputs::{mission::Mission, variables::item};
use model_description::Description;

use super::{
    source::description,
    start::{self, START},
};

/// The choice whose default follows from the orbit.
const DYNAMICS: &str = "orbit.dynamics";
/// Groups of variables that it follows from.
const GROUPS: [&str; 4] = ["orbit.", "planet.", "aerodynamics.", "atmosphere."];

/// The setting that a mission's values lead to, with the place of the last of them; `None` where it gives the dynamics itself, or leads
/// to the file's own. Values that the model refuses are left to who sets them.
pub(super) fn of_mission(
    binary: &Binary,
    (described, own): (&Described, &Description),
    setup: &str,
    mission: &Mission,
) -> Option<(String, String)> {
    let before = item(own, &[], DYNAMICS)?.to_owned();
    let settings = mission.settings(own);
    let is_of = |name: &str| settings.iter().any(|(_, setting)| setting.trim_start().starts_with(name));
    if is_of(DYNAMICS) || !GROUPS.iter().any(|group| is_of(group)) {
        return None;
    }
    let at = settings.last()?.0.clone();
    let text = start::with_values(setup, START, &described.model, own, &settings).ok()?;
    let with_values = description(&binary.describe(&described.model, None, Some(&text)).ok()?).ok()?;
    let after = item(&with_values, &[], DYNAMICS)?;
    (after != before).then(|| (at, format!("{DYNAMICS}={after}")))
}

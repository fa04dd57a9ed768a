//! Entries of a spacecraft's file without effect in an FMU made of it.

use model_description::{Description, VariableKind};
use physics::{plausibility::defaults_at_their_bounds, spacecraft::Spacecraft};

/// The parameter that chooses how planet light is summed, and its item for a map.
const METHOD: (&str, i32) = ("planetLight.method", 3);

/// The switch that lets planet light act.
const SWITCH: &str = "planetLight.enabled";

/// Whether a model can take the map of a file.
pub fn can_read_map(description: &Description) -> bool {
    description.variables.iter().any(|it| it.name == METHOD.0)
}

/// A warning where the file has a map of the planet that the FMU, as described, does not use.
pub fn unused_map(setup: &str, model: &str, description: &Description) -> Option<String> {
    Spacecraft::from_toml("", setup).ok()?.planet_map?;
    let start = |name: &str| description.variables.iter().find(|it| it.name == name).map(|it| &it.kind);
    match (start(METHOD.0), start(SWITCH)) {
        (Some(VariableKind::Enumeration { start, .. }), switch) => {
            let on = !matches!(switch, Some(VariableKind::Boolean { start: Some(false), .. }));
            (*start != Some(METHOD.1) || !on).then(|| {
                format!(
                    "[planet_map] has an effect in {model} with {SWITCH} = true and {} = map alone",
                    METHOD.0
                )
            })
        }
        // A model without light of the planet has no use for its places.
        (_, None) => None,
        _ => Some(format!(
            "[planet_map] is without effect in {model}; DisturbanceTorque takes it, with {SWITCH} = true and {} = map",
            METHOD.0
        )),
    }
}

/// A warning for each default of the spacecraft that lies at its bound.
pub fn defaults_at_bounds(setup: &str) -> Vec<String> {
    Spacecraft::from_toml("", setup).map_or_else(|_| Vec::new(), |it| defaults_at_their_bounds(&it))
}

//! Packing the shipped FMUs and systems into `dist/`.

use crate::build::{Built, build, scratch};
use crate::shell::{Outcome, command, root, run};
use crate::systems;

/// File without its ending, model name and the shipped spacecraft it is packed with.
const SHIPPED: &[(&str, &str, &str)] = &[
    ("MomentumPlant", "MomentumPlant", "messenger.toml"),
    ("MessengerFull", "MomentumPlant", "messenger-full.toml"),
    ("SpinPlant", "SpinPlant", "ace.toml"),
    ("DisturbanceTorque", "DisturbanceTorque", "messenger-thermal.toml"),
    ("FlexibleCraft", "MomentumPlant", "examples/flexible-craft.toml"),
    ("Guidance", "Guidance", "messenger.toml"),
];

/// Builds, then packs everything that is shipped.
pub fn dist() -> Result<Built, String> {
    let built = build()?;
    pack(&built)?;
    systems::pack(&built, &scratch("systems")?)?;
    Ok(built)
}

fn pack(built: &Built) -> Outcome {
    for (file, model, spacecraft) in SHIPPED {
        run(command(&built.heliotorque)
            .args(["pack", "--model", model, "--library"])
            .arg(&built.library)
            .arg("--spacecraft")
            .arg(root().join("fmu-src").join("resources").join(spacecraft))
            .arg("--output")
            .arg(root().join("dist").join(format!("{file}.fmu"))))?;
    }
    Ok(())
}

//! Packing the shipped FMUs and systems into `dist/`.

use crate::build::{Built, build, scratch};
use crate::shell::{Outcome, command, root, run};
use crate::systems;

/// Model name and the shipped spacecraft it is packed with.
const SHIPPED: &[(&str, &str)] = &[
    ("MomentumPlant", "messenger.toml"),
    ("SpinPlant", "ace.toml"),
    ("DisturbanceTorque", "messenger-thermal.toml"),
    ("Guidance", "messenger.toml"),
];

/// Builds, then packs everything that is shipped.
pub fn dist() -> Result<Built, String> {
    let built = build()?;
    pack(&built)?;
    systems::pack(&built, &scratch("systems")?)?;
    Ok(built)
}

fn pack(built: &Built) -> Outcome {
    for (model, spacecraft) in SHIPPED {
        run(command(&built.heliotorque)
            .args(["pack", "--model", model, "--library"])
            .arg(&built.library)
            .arg("--spacecraft")
            .arg(root().join("fmu-src").join("resources").join(spacecraft))
            .arg("--output")
            .arg(root().join("dist").join(format!("{model}.fmu"))))?;
    }
    Ok(())
}

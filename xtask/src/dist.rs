//! Packing the shipped FMUs and systems into `dist/`.

use std::fs;
use std::path::{Path, PathBuf};

use crate::build::{Built, build, scratch};
use crate::shell::{Outcome, command, run, target};
use crate::{archives, paths, platforms, systems};

/// An FMU: file name, model, spacecraft, further options of `pack`.
type Shipped = (&'static str, &'static str, &'static str, &'static str);

const SHIPPED: &[Shipped] = &[
    ("MomentumPlant", "MomentumPlant", "messenger.toml", ""),
    ("SpinPlant", "SpinPlant", "ace.toml", ""),
    ("DisturbanceTorque", "DisturbanceTorque", "messenger-thermal.toml", ""),
    ("Guidance", "Guidance", "messenger.toml", ""),
    ("FlexibleCraft", "MomentumPlant", "examples/flexible-craft.toml", ""),
    // Controlled by its own guidance, from the attitude that it commands first.
    (
        "MessengerFull",
        "MomentumPlant",
        "messenger-full.toml",
        "--set attitude.source=controlled --set command.source=guidance --set shadowing.enabled=true \
         --set solver.dynamicsStep=10 --per-plate --set GUIDED_AT_START",
    ),
    ("Cubesat", "MomentumPlant", "examples/cubesat-12u.toml", ""),
    ("MessengerLight", "DisturbanceTorque", "messenger-full.toml", "--set shadowing.enabled=true"),
];

/// Names of the shipped FMUs.
pub(crate) fn names() -> impl Iterator<Item = &'static str> {
    SHIPPED.iter().map(|(name, ..)| *name)
}

/// Builds, then packs everything that is shipped.
pub(crate) fn dist() -> Result<Built, String> {
    let built = build()?;
    pack_all(&built)?;
    Ok(built)
}

/// Packs what was built.
pub(crate) fn pack_all(built: &Built) -> Outcome {
    let scratch = scratch("systems")?;
    // Each waits for one core.
    std::thread::scope(|scope| {
        let systems = scope.spawn(|| systems::pack(built, &scratch));
        pack(built)?;
        systems.join().unwrap_or_else(|_| Err("the thread of the systems panicked".to_owned()))
    })?;
    // Only here is everything packed, and `current` looks at it.
    paths::write(&stamp(), "")
}

/// Builds what is shipped, for old systems where that is possible, and packs it.
pub(crate) fn shipped() -> Result<Built, String> {
    let built = platforms::portable()?;
    pack_all(&built)?;
    Ok(built)
}

/// Builds for every platform, packs FMUs with all their libraries, and archives what is installed on each.
pub(crate) fn all_platforms() -> Result<Built, String> {
    let built = platforms::all()?;
    pack_all(&built)?;
    archives::write(&built)?;
    Ok(built)
}

/// Packs what was built, where program or library are newer than what is packed.
pub(crate) fn pack_stale(built: &Built) -> Outcome {
    let changed = |path: &Path| fs::metadata(path).and_then(|file| file.modified()).ok();
    let packed = changed(&stamp());
    let is_current =
        [&built.heliotorque, &built.library].iter().all(|path| packed.is_some() && changed(path) <= packed);
    if is_current { Ok(()) } else { pack_all(built) }
}

/// Written after everything was packed.
fn stamp() -> PathBuf {
    target().join("dist.stamp")
}

fn pack(built: &Built) -> Outcome {
    SHIPPED.iter().try_for_each(|(name, model, spacecraft, options)| {
        run(command(&built.heliotorque)
            .args(["pack", "--name", name, "--model", model])
            .args(built.library_options(|it| &it.library))
            .arg("--spacecraft")
            .arg(paths::resource(spacecraft))
            .args(systems::options(options))
            .arg("--output")
            .arg(paths::dist(format!("{name}.fmu")))
            // The standard output may be a shell's, as that of `env` is.
            .stdout(std::io::stderr()))
    })
}

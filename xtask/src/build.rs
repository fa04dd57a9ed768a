//! Building the library and the command line.

use std::path::PathBuf;
use std::process::Command;

use crate::shell::{self, cargo, root, run, target};

/// What a build leaves.
pub struct Built {
    /// The command line.
    pub heliotorque: PathBuf,
    /// The shared library of every shipped FMU.
    pub library: PathBuf,
    /// The probe's shared library.
    pub probe: PathBuf,
}

/// One choice of features for programs and tests, so that no crate is compiled twice.
pub const EVERYTHING: [&str; 4] = ["--locked", "--release", "--workspace", "--all-features"];

/// Builds the shared library, the probe and the command line.
pub fn build() -> Result<Built, String> {
    run(&mut library())?;
    run(cargo(&["build"]).args(EVERYTHING))?;
    Ok(built())
}

/// Where a build leaves what it made.
pub fn built() -> Built {
    let library = |folder: &str, name: &str| {
        let file = format!("{}{name}{}", std::env::consts::DLL_PREFIX, std::env::consts::DLL_SUFFIX);
        target().join(folder).join(file)
    };
    Built {
        heliotorque: target().join("release").join(format!("heliotorque{}", std::env::consts::EXE_SUFFIX)),
        library: library("fmu", "heliotorque"),
        probe: library("release", "probe"),
    }
}

/// Builds the shared library, whole-program optimised.
pub fn library() -> Command {
    cargo(&["build", "--locked", "--profile", "fmu", "-p", "component"])
}

/// The environment in which tests find what was built.
pub fn test_environment(built: &Built) -> [(&'static str, PathBuf); 4] {
    [
        ("HELIOTORQUE_LIBRARY", built.library.clone()),
        ("HELIOTORQUE_PROBE_LIBRARY", built.probe.clone()),
        ("HELIOTORQUE_DIST", root().join("dist")),
        ("HELIOTORQUE", built.heliotorque.clone()),
    ]
}

/// Where the tests may leave files.
pub fn scratch(name: &str) -> Result<PathBuf, String> {
    let folder = shell::target().join("scratch").join(name);
    std::fs::create_dir_all(&folder)
        .map_err(|error| format!("cannot create {}: {error}", folder.display()))?;
    Ok(folder)
}

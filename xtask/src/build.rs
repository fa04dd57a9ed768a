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

/// Programs and tests have the same features, so that hardly a crate is compiled twice.
pub const TESTS: &str = "--locked --release --workspace --all-features";

/// Builds the shared libraries and the command line.
pub fn build() -> Result<Built, String> {
    run(&mut libraries())?;
    run(&mut cargo("build --locked --release -p heliotorque --all-features"))?;
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
        probe: library("fmu", "probe"),
    }
}

/// Builds the shared library and the probe's, whole-program optimised.
pub fn libraries() -> Command {
    cargo("build --locked --profile fmu -p component -p probe")
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

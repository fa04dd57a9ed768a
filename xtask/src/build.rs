//! Building the library and the command line.

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::python;
use crate::shell::{self, cargo, command, root, run, target};

/// What a build leaves.
pub(crate) struct Built {
    /// The command line.
    pub heliotorque: PathBuf,
    /// The shared library of every shipped FMU.
    pub library: PathBuf,
    /// The probe's shared library.
    pub probe: PathBuf,
}

/// Programs and tests have the same features, so that hardly a crate is compiled twice.
pub(crate) const TESTS: &str = "--locked --release --workspace --all-features";

/// Builds the shared libraries and the command line.
pub(crate) fn build() -> Result<Built, String> {
    run(&mut libraries())?;
    run(&mut cargo("build --locked --release -p heliotorque --all-features"))?;
    Ok(built())
}

/// The oldest system that what is shipped loads on.
const SHIPPED_FOR: &str = "x86_64-unknown-linux-gnu.2.17";

/// Builds library and program for glibc 2.17 with the pinned linker; where that cannot be had, for this machine, and says so.
pub(crate) fn portable() -> Result<Built, String> {
    if !cfg!(all(target_os = "linux", target_arch = "x86_64", target_env = "gnu")) {
        eprintln!("note: built for this machine; libraries for {SHIPPED_FOR} are made on x86-64 Linux only");
        return build();
    }
    let programs = match python::zig_programs() {
        Ok(programs) => programs,
        Err(problem) => {
            eprintln!(
                "note: built for this machine, whose glibc users must have; for {SHIPPED_FOR} the packages of \
                 xtask/zig-requirements.txt are missing: {problem}"
            );
            return build();
        }
    };
    let others = std::env::var_os("PATH").unwrap_or_default();
    let path = std::env::join_paths(std::iter::once(programs.clone()).chain(std::env::split_paths(&others)))
        .map_err(|error| format!("PATH: {error}"))?;
    let zigbuild = |arguments: &[&str]| {
        run(command(programs.join("cargo-zigbuild"))
            .args(["zigbuild", "--locked", "--target", SHIPPED_FOR])
            .args(arguments)
            .env("PATH", &path))
    };
    zigbuild(&["--profile", "fmu", "-p", "component", "-p", "probe"])?;
    zigbuild(&["--release", "-p", "heliotorque", "--all-features"])?;
    Ok(built_in(&target().join("x86_64-unknown-linux-gnu")))
}

/// Where a build leaves what it made.
pub(crate) fn built() -> Built {
    built_in(&target())
}

fn built_in(target: &Path) -> Built {
    let library = |folder: &str, name: &str| {
        let file = format!("{}{name}{}", std::env::consts::DLL_PREFIX, std::env::consts::DLL_SUFFIX);
        target.join(folder).join(file)
    };
    Built {
        heliotorque: target.join("release").join(format!("heliotorque{}", std::env::consts::EXE_SUFFIX)),
        library: library("fmu", "heliotorque"),
        probe: library("fmu", "probe"),
    }
}

/// Builds the shared library and the probe's, whole-program optimised.
pub(crate) fn libraries() -> Command {
    cargo("build --locked --profile fmu -p component -p probe")
}

/// The environment in which tests find what was built.
pub(crate) fn test_environment(built: &Built) -> [(&'static str, PathBuf); 4] {
    [
        ("HELIOTORQUE_LIBRARY", built.library.clone()),
        ("HELIOTORQUE_PROBE_LIBRARY", built.probe.clone()),
        ("HELIOTORQUE_DIST", root().join("dist")),
        ("HELIOTORQUE", built.heliotorque.clone()),
    ]
}

/// Where the tests may leave files.
pub(crate) fn scratch(name: &str) -> Result<PathBuf, String> {
    let folder = shell::target().join("scratch").join(name);
    std::fs::create_dir_all(&folder)
        .map_err(|error| format!("cannot create {}: {error}", folder.display()))?;
    Ok(folder)
}

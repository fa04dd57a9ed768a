//! Building the library and the command line.

use std::path::{Path, PathBuf};

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
    /// Folder of the packed FMUs and systems.
    pub dist: PathBuf,
}

/// Programs and tests have the same features, so that hardly a crate is compiled twice.
pub(crate) const TESTS: &str = "--locked --release --workspace --all-features";

/// Builds the shared libraries, with link-time optimisation, and the command line.
pub(crate) fn build() -> Result<Built, String> {
    run(&mut cargo("build --locked --profile fmu -p component -p probe"))?;
    run(&mut cargo("build --locked --release -p heliotorque --all-features"))?;
    Ok(built_in(&target(), "fmu", root().join("dist")))
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
    Ok(built_in(&target().join("x86_64-unknown-linux-gnu"), "fmu", root().join("dist")))
}

/// Builds all tests with the program and the shared libraries that they load. One command: features of dependencies differ between
/// builds with and without tests. The libraries have the profile `release`: link-time optimisation takes minutes.
pub(crate) fn build_for_tests() -> Result<Built, String> {
    run(&mut cargo(&format!("build --quiet {TESTS} --all-targets")))?;
    Ok(built_in(&target(), "release", target().join("dist")))
}

/// Paths of a build in the folder `target`, whose libraries were built with the profile `libraries`.
fn built_in(target: &Path, libraries: &str, dist: PathBuf) -> Built {
    let library = |name: &str| {
        let file = format!("{}{name}{}", std::env::consts::DLL_PREFIX, std::env::consts::DLL_SUFFIX);
        target.join(libraries).join(file)
    };
    Built {
        heliotorque: target.join("release").join(format!("heliotorque{}", std::env::consts::EXE_SUFFIX)),
        library: library("heliotorque"),
        probe: library("probe"),
        dist,
    }
}

/// The environment in which tests find what was built.
pub(crate) fn test_environment(built: &Built) -> [(&'static str, PathBuf); 4] {
    [
        ("HELIOTORQUE_LIBRARY", built.library.clone()),
        ("HELIOTORQUE_PROBE_LIBRARY", built.probe.clone()),
        ("HELIOTORQUE_DIST", built.dist.clone()),
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

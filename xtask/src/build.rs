//! Building the library and the command line.

use std::env::consts::{DLL_PREFIX, DLL_SUFFIX, EXE_SUFFIX};
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::paths;
use crate::shell::{cargo, root, run, target};

/// Products of a build.
pub(crate) struct Built {
    /// The command line.
    pub heliotorque: PathBuf,
    /// The shared library of every shipped FMU.
    pub library: PathBuf,
    /// The probe's shared library.
    pub probe: PathBuf,
    /// The same for other platforms.
    pub others: Vec<Built>,
}

impl Built {
    /// The products of a build for one platform below `folder`, its libraries of a profile: by prefix and suffix of its libraries and the
    /// suffix of its programs.
    pub(crate) fn below(
        folder: &Path,
        profile: &str,
        (prefix, suffix): (&str, &str),
        program_suffix: &str,
    ) -> Self {
        let library = |name: &str| folder.join(profile).join(format!("{prefix}{name}{suffix}"));
        Self {
            heliotorque: folder.join("release").join(format!("heliotorque{program_suffix}")),
            library: library("heliotorque"),
            probe: library("probe"),
            others: Vec::new(),
        }
    }

    /// The build for the host, then those for other platforms.
    pub(crate) fn each(&self) -> impl Iterator<Item = &Built> {
        std::iter::once(self).chain(&self.others)
    }

    /// The options of `pack` that name a library of each platform.
    pub(crate) fn library_options(&self, of: fn(&Built) -> &PathBuf) -> impl Iterator<Item = OsString> {
        self.each().flat_map(move |it| ["--library".into(), of(it).into()])
    }
}

/// Programs and tests have the same features, so that hardly a crate is compiled twice.
pub(crate) const TESTS: &str = "--locked --release --workspace --all-features";

/// Builds the shared libraries and the command line.
pub(crate) fn build() -> Result<Built, String> {
    run(&mut libraries())?;
    run(&mut cargo("build --locked --release -p heliotorque --all-features"))?;
    Ok(built())
}

/// Profile of the shipped libraries, which are optimised as a whole.
pub(crate) const SHIPPED: &str = "fmu";

/// Returns the products of the host's build.
pub(crate) fn built() -> Built {
    Built::below(&target(), SHIPPED, (DLL_PREFIX, DLL_SUFFIX), EXE_SUFFIX)
}

/// Builds the tests with all that they read; returns programs and libraries of profile `release`, which are hardly slower than the
/// shipped ones and come with the tests.
pub(crate) fn tested(quiet: &str) -> Result<Built, String> {
    run(&mut cargo(&format!("test --no-run --tests {quiet} {TESTS}")))?;
    // The library; neither this program nor the derive, which the tests have.
    let others = "--exclude xtask --exclude fmi-export-derive";
    run(&mut cargo(&format!("build {quiet} {TESTS} {others}")))?;
    Ok(built_with_tests())
}

/// Returns the same products where they were built.
fn built_with_tests() -> Built {
    Built::below(&target(), "release", (DLL_PREFIX, DLL_SUFFIX), EXE_SUFFIX)
}

/// Returns the host's products with the libraries that were built last, shipped ones or those of the tests.
pub(crate) fn latest() -> Built {
    let age = |built: &Built| std::fs::metadata(&built.library).and_then(|file| file.modified()).ok();
    let (shipped, tested) = (built(), built_with_tests());
    if age(&tested) > age(&shipped) { tested } else { shipped }
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

/// Returns an existing folder for files of tests.
pub(crate) fn scratch(name: &str) -> Result<PathBuf, String> {
    paths::created(target().join("scratch").join(name))
}

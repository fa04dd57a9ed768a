//! The program on Windows, tested under Wine.

use std::ffi::OsString;
use std::path::PathBuf;

use crate::build::Built;
use crate::platforms::{WINDOWS, mingw};
use crate::shell::{Outcome, run, target};
use crate::{paths, test};

/// Crates whose unit tests ask the operating system for something.
const OF_THE_SYSTEM: &str = "-p files -p fmi";

/// Runs the tests of program and libraries for Windows under Wine; everything is built and packed.
pub(crate) fn test(built: &Built) -> Outcome {
    run(mingw(&format!("test --locked --release --all-features --lib {OF_THE_SYSTEM}")).envs(wine()))?;
    let environment = test::environment(built)?.into_iter().map(|(name, it)| (name, it.into()));
    let windows = [("HELIOTORQUE_WINDOWS", shipped()?.into())];
    test::python_file("test_windows.py", environment.chain(windows).chain(wine()))
}

/// Program and libraries in one folder.
fn shipped() -> Result<PathBuf, String> {
    let folder = paths::created(target().join("windows"))?;
    let Built { heliotorque, library, probe, .. } = WINDOWS.built();
    for from in [heliotorque, library, probe] {
        let to = folder.join(from.file_name().unwrap_or_default());
        paths::at(&from, std::fs::copy(&from, to))?;
    }
    Ok(folder)
}

/// Wine with a registry of its own, which is silent and offers nothing to install.
pub(crate) fn wine() -> [(&'static str, OsString); 3] {
    [
        ("WINEPREFIX", target().join("wine").into()),
        ("WINEDEBUG", "-all".into()),
        ("WINEDLLOVERRIDES", "mscoree,mshtml=".into()),
    ]
}

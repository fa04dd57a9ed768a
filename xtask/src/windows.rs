//! The program on Windows: built by mingw's linker, tested under Wine.

use std::ffi::OsString;
use std::path::PathBuf;
use std::process::Command;

use crate::shell::{self, Outcome, cargo, command, need, run, target};
use crate::test;

/// Windows 7 and later. The target for Windows 10 takes its random numbers from a library that Wine 8 lacks.
const TARGET: &str = "x86_64-win7-windows-gnu";
/// The linker, of Debian's package gcc-mingw-w64-x86-64.
const LINKER: &str = "x86_64-w64-mingw32-gcc";
/// Crates whose unit tests ask the operating system for something.
const OF_THE_SYSTEM: &str = "-p files -p loader";

/// Builds program and libraries for Windows and runs their tests under Wine; what this machine lacks is named.
pub(crate) fn test() -> Outcome {
    let needs = [(LINKER, "the build for Windows"), ("wine", "the program on Windows")];
    for (program, what_for) in needs {
        if !need(program, what_for)? {
            return Ok(());
        }
    }
    if !need_standard_library()? {
        return Ok(());
    }
    run(&mut build("build --locked --profile fmu -p component -p probe"))?;
    run(&mut build("build --locked --release -p heliotorque --all-features"))?;
    let folder = shipped()?;
    run(build(&format!("test --locked --release --all-features --lib {OF_THE_SYSTEM}")).envs(wine()))?;
    let mut environment = test::current_environment()?;
    environment.push(("HELIOTORQUE_WINDOWS", folder));
    test::python_file(
        "test_windows.py",
        environment.into_iter().map(|(name, it)| (name, it.into())).chain(wine()),
    )
}

/// The standard library is built too: none is distributed for this target.
fn build(arguments: &str) -> Command {
    let mut cargo = cargo(arguments);
    cargo
        .args(["-Zbuild-std=std,panic_unwind", "--target", TARGET])
        // That takes a feature which the released compiler hides.
        .env("RUSTC_BOOTSTRAP", "1")
        .env("CARGO_TARGET_X86_64_WIN7_WINDOWS_GNU_LINKER", LINKER)
        .env("CARGO_TARGET_X86_64_WIN7_WINDOWS_GNU_RUNNER", "wine");
    cargo
}

fn need_standard_library() -> Result<bool, String> {
    let compiler = shell::output(command("rustc").args(["--print", "sysroot"]))?;
    let source = PathBuf::from(compiler.trim()).join("lib/rustlib/src/rust/library/Cargo.lock");
    if source.is_file() {
        return Ok(true);
    }
    let missing = "the source of the standard library is missing (rustup component add rust-src), needed for the build for Windows";
    if std::env::var_os("CI").is_some() {
        return Err(missing.to_owned());
    }
    eprintln!("skipped: {missing}");
    Ok(false)
}

/// Program and libraries in one folder.
fn shipped() -> Result<PathBuf, String> {
    let folder = target().join("windows");
    let built = target().join(TARGET);
    let files = [("release", "heliotorque.exe"), ("fmu", "heliotorque.dll"), ("fmu", "probe.dll")];
    std::fs::create_dir_all(&folder)
        .map_err(|error| format!("cannot create {}: {error}", folder.display()))?;
    for (profile, name) in files {
        let from = built.join(profile).join(name);
        std::fs::copy(&from, folder.join(name)).map_err(|error| format!("{}: {error}", from.display()))?;
    }
    Ok(folder)
}

/// Wine with a registry of its own, which is silent and offers nothing to install.
fn wine() -> [(&'static str, OsString); 3] {
    [
        ("WINEPREFIX", target().join("wine").into()),
        ("WINEDEBUG", "-all".into()),
        ("WINEDLLOVERRIDES", "mscoree,mshtml=".into()),
    ]
}

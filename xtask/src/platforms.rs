//! The platforms that library and program are built for, and how each is built.

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::build::{self, Built};
use crate::shell::{Outcome, cargo, command, run, target};
use crate::{python, tools};

/// A platform.
pub(crate) struct Platform {
    /// Folder below `binaries/` of an FMU (FMI 2.0.5, 2.3).
    pub folder: &'static str,
    /// Rust's target triple.
    pub target: &'static str,
    /// Oldest supported glibc.
    glibc: Option<&'static str>,
    /// Prefix and suffix of a shared library.
    library_affixes: (&'static str, &'static str),
    /// Suffix of a program.
    pub program_suffix: &'static str,
    /// Platform tag of a wheel.
    pub wheel_tag: &'static str,
}

pub(crate) const LINUX: Platform = Platform {
    folder: "linux64",
    target: "x86_64-unknown-linux-gnu",
    glibc: Some("2.17"),
    library_affixes: ("lib", ".so"),
    program_suffix: "",
    wheel_tag: "manylinux_2_17_x86_64",
};

/// Not `x86_64-pc-windows-gnu`, whose standard library needs bcryptprimitives.dll, which Windows 7 and wine 8 do not have.
pub(crate) const WINDOWS: Platform = Platform {
    folder: "win64",
    target: "x86_64-win7-windows-gnu",
    glibc: None,
    library_affixes: ("", ".dll"),
    program_suffix: ".exe",
    wheel_tag: "win_amd64",
};

pub(crate) const ARM: Platform = Platform {
    folder: "aarch64-linux",
    target: "aarch64-unknown-linux-gnu",
    wheel_tag: "manylinux_2_17_aarch64",
    ..LINUX
};

/// The host first.
pub(crate) const ALL: [Platform; 3] = [LINUX, WINDOWS, ARM];

const LIBRARIES: [&str; 7] = ["--profile", "fmu", "-p", "component", "-p", "probe", "--locked"];
const PROGRAM: [&str; 5] = ["--release", "-p", "heliotorque", "--all-features", "--locked"];

impl Platform {
    /// Files of a build.
    pub(crate) fn built(&self) -> Built {
        let folder = self.target_folder().join(self.target);
        Built::below(&folder, build::SHIPPED, self.library_affixes, self.program_suffix)
    }

    /// Folder of its builds. Windows has one of its own: macros and build scripts depend on `RUSTC_BOOTSTRAP`, so that builds with and
    /// without it would make one another stale.
    fn target_folder(&self) -> PathBuf {
        if self.folder == WINDOWS.folder { target().join("mingw") } else { target() }
    }

    /// Ending of its shared libraries.
    pub(crate) fn library_suffix(&self) -> &'static str {
        self.library_affixes.1
    }

    /// Builds library and program.
    fn build(&self) -> Result<Built, String> {
        let build = || match self.glibc {
            Some(version) => zig_build(&format!("{}.{version}", self.target)),
            None => Ok(mingw("build")),
        };
        run(build()?.args(LIBRARIES))?;
        run(build()?.args(PROGRAM))?;
        Ok(self.built())
    }

    /// Checks that all tools are available.
    fn need(&self) -> Outcome {
        match self.glibc {
            Some(_) => tools::need_library_for(self.target).and_then(|()| python::zig_programs().map(|_| ())),
            None => tools::need_library_sources().and_then(|()| tools::need(&[&tools::MINGW])),
        }
    }
}

/// `cargo zigbuild`, which links for an older glibc.
fn zig_build(target: &str) -> Result<Command, String> {
    let programs = python::zig_programs()?;
    let mut zig_build = command(programs.join("cargo-zigbuild"));
    zig_build.args(["zigbuild", "--target", target]).env("PATH", path_with(&programs)?);
    Ok(zig_build)
}

fn path_with(folder: &Path) -> Result<std::ffi::OsString, String> {
    let others = std::env::var_os("PATH").unwrap_or_default();
    let folders = std::iter::once(PathBuf::from(folder)).chain(std::env::split_paths(&others));
    std::env::join_paths(folders).map_err(|error| format!("PATH: {error}"))
}

/// A command of cargo for Windows, with a standard library built too: none is distributed for this target.
pub(crate) fn mingw(arguments: &str) -> Command {
    let triple = WINDOWS.target.to_uppercase().replace('-', "_");
    let variable = |name: &str| format!("CARGO_TARGET_{triple}_{name}");
    let mut cargo = cargo(arguments);
    cargo
        .args(["-Zbuild-std=std,panic_unwind", "--target", WINDOWS.target, "--target-dir"])
        .arg(WINDOWS.target_folder())
        // `-Zbuild-std` is an unstable feature.
        .env("RUSTC_BOOTSTRAP", "1")
        .env(variable("LINKER"), tools::MINGW.program)
        .env(variable("RUNNER"), tools::WINE.program);
    cargo
}

/// Builds for Linux with glibc 2.17 or later; where that cannot be had, for this machine, and is reported.
pub(crate) fn portable() -> Result<Built, String> {
    let shown = format!("{} with glibc {}", LINUX.target, LINUX.glibc.unwrap_or_default());
    if !cfg!(all(target_os = "linux", target_arch = "x86_64", target_env = "gnu")) {
        eprintln!("note: built for this machine; what is for {shown} is made on x86-64 Linux only");
        return build::build();
    }
    if let Err(problem) = python::zig_programs() {
        eprintln!(
            "note: built for this machine, whose glibc users must have; for {shown} the packages of \
             xtask/zig-requirements.txt are missing: {problem}"
        );
        return build::build();
    }
    LINUX.build()
}

/// Builds for every platform; what this machine lacks is named before anything is built.
pub(crate) fn all() -> Result<Built, String> {
    if !cfg!(all(target_os = "linux", target_arch = "x86_64", target_env = "gnu")) {
        return Err("all platforms are built on x86-64 Linux only".to_owned());
    }
    let missing: Vec<String> = ALL.iter().filter_map(|platform| platform.need().err()).collect();
    if !missing.is_empty() {
        return Err(missing.join("\n"));
    }
    let [here, others @ ..] = &ALL;
    let others = others.iter().map(Platform::build).collect::<Result<_, _>>()?;
    Ok(Built { others, ..here.build()? })
}

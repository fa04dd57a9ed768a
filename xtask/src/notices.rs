//! `cargo xtask notices`: the licences of the crates linked into the shared library, as every FMU carries them; those of the program
//! for its archives and wheels.
//!
//! The library's text is committed, so that packing needs no sources, and a test compares it with what `Cargo.lock` lists.
//!
//! Why not `cargo-about`: it is a program to install, from the network and in minutes, before the test could run on a
//! fresh machine; and it knows neither the Rust standard library nor GCC's unwinder, whose notices stand here too.

use std::{
    collections::BTreeMap,
    fmt::Write as _,
    fs,
    path::{Path, PathBuf},
};

use serde_json::Value;

use crate::paths;
use crate::shell::{self, Outcome, cargo};

/// The same crates wherever the notices of the library are made.
const TARGET: &str = "x86_64-unknown-linux-gnu";

const OF_PROGRAM: &str = "\
Third-party notices of the program
==================================

The program heliotorque, whose own licences are the other files of this folder, is made from the crates below. Where a crate
offers a choice that includes the MIT licence, that is the one taken. What is said in THIRD-PARTY.txt of the Rust standard library,
the geomagnetic field, the unwinder and mingw-w64 holds for the program too.

The crates anise and hifitime are under the Mozilla Public License 2.0, given below; their source code is at
https://crates.io/crates/anise and https://crates.io/crates/hifitime.

";

const OF_LIBRARY: &str = "\
Third-party notices
===================

The shared library of this FMU is made from heliotorque, whose own licences are the other files of this folder, and
from the crates below. Where a crate offers a choice that includes the MIT licence, that is the one taken.

The Rust standard library is linked in too: MIT OR Apache-2.0, by the Rust project's contributors, taken under the
Apache licence; its text is given below.

The crate hifitime is under the Mozilla Public License 2.0, given below; its source code is at
https://crates.io/crates/hifitime.

The coefficients of the International Geomagnetic Reference Field, 14th generation, are compiled in unchanged: by the
International Association of Geomagnetism and Aeronomy (2024), https://doi.org/10.5281/zenodo.14012302, Creative Commons
Attribution 4.0 International, https://creativecommons.org/licenses/by/4.0/.

An unwinder is linked in too. In libraries for Linux with glibc 2.17 and later it is LLVM's (libunwind and compiler-rt):
Apache-2.0 WITH LLVM-exception, by the LLVM project's contributors; the text of the Apache licence is given below. In
those for Windows, and in others for Linux, it is GCC's (libgcc_eh and libgcc): GPL-3.0-or-later WITH GCC-exception-3.1, by
the Free Software Foundation; the exception lets it be passed on as part of this library under the licences of this folder.

In libraries for Windows start-up code and functions of mingw-w64 are linked in, copyright 2009 to 2016 by the mingw-w64
project: in the public domain, and under the Zope Public License 2.1, given below.

";

/// The licence of what mingw-w64 brings.
const MINGW: &str = include_str!("mingw-w64.txt");

/// A crate and the licences it is offered under.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Crate {
    name: String,
    version: String,
    license: String,
}

/// File of the notices.
fn path() -> PathBuf {
    shell::root().join("fmu-src").join("component").join("THIRD-PARTY.txt")
}

/// Writes the notices anew.
pub(crate) fn write() -> Outcome {
    let path = path();
    fs::write(&path, of_library()?).map_err(|error| format!("cannot write {}: {error}", path.display()))
}

/// The notices of the library as the lock file and the crates' own files give them.
fn of_library() -> Result<String, String> {
    let mingw = format!("\n\n{0}\nmingw-w64\n{0}\n\n{MINGW}", "-".repeat(80));
    text("component", TARGET, OF_LIBRARY, &mingw)
}

/// The same of the program for a target triple.
pub(crate) fn of_program(target: &str) -> Result<String, String> {
    text("heliotorque", target, OF_PROGRAM, "")
}

/// The notices of a package and its crates: the head, their list, what else is linked, the licences' texts.
fn text(package: &str, target: &str, head: &str, more: &str) -> Result<String, String> {
    let crates = linked(package, target)?;
    let metadata = "metadata --locked --all-features --format-version 1 --filter-platform";
    let metadata = shell::output(cargo(metadata).arg(target))?;
    let metadata: Value =
        serde_json::from_str(&metadata).map_err(|error| format!("cargo metadata: {error}"))?;
    let mut text = head.to_owned();
    let (mut texts, mut without_text) = (BTreeMap::<String, Vec<&Crate>>::new(), Vec::new());
    for it in &crates {
        let _ = writeln!(text, "{} {}: {}", it.name, it.version, it.license);
        let folder = folder(&metadata, it).ok_or_else(|| format!("cargo knows no folder of {it:?}"))?;
        let notices = notices(&folder, &it.license)?;
        if notices.is_empty() {
            without_text.push((it, folder));
        }
        for notice in notices {
            texts.entry(notice).or_default().push(it);
        }
    }
    // Their licence's text is that of another crate under it.
    for (it, folder) in without_text {
        let same = texts.values_mut().find(|crates| crates.iter().any(|other| other.license == it.license));
        let missing = || format!("{}: no file with its licence ({})", folder.display(), it.license);
        same.ok_or_else(missing)?.push(it);
    }
    text.push_str(more);
    // In the order of the first crate of each, not of the texts.
    let mut texts: Vec<(String, Vec<&Crate>)> = texts.into_iter().collect();
    texts.sort_by(|a, b| a.1.cmp(&b.1));
    for (notice, crates) in texts {
        let names: Vec<&str> = crates.iter().map(|it| it.name.as_str()).collect();
        let _ = write!(text, "\n\n{0}\n{1}\n{0}\n\n{notice}", "-".repeat(80), names.join(", "));
    }
    Ok(text)
}

/// Crates in a package that are not ours, by name.
fn linked(package: &str, target: &str) -> Result<Vec<Crate>, String> {
    let tree = "tree --locked --all-features --edges normal,no-proc-macro --prefix none --format {p}|{l}";
    let tree = shell::output(cargo(tree).args(["--package", package, "--target", target]))?;
    let mut crates: Vec<Crate> = tree.lines().filter_map(crate_of).collect();
    crates.sort();
    crates.dedup();
    Ok(crates)
}

/// A line of the tree: `name vVersion|license`, for ours with the folder after the version.
fn crate_of(line: &str) -> Option<Crate> {
    let (package, license) = line.split_once('|')?;
    let mut words = package.split_whitespace();
    let (name, version) = (words.next()?, words.next()?.strip_prefix('v')?);
    let ours = words.next().is_some();
    // Seen before in the tree.
    let license = license.trim_end_matches("(*)").trim();
    let text = str::to_owned;
    (!ours).then(|| Crate { name: text(name), version: text(version), license: text(license) })
}

/// The crate's folder, from cargo's description of the workspace.
fn folder(metadata: &Value, it: &Crate) -> Option<PathBuf> {
    let is_meant = |package: &&Value| package["name"] == it.name && package["version"] == it.version;
    let package = metadata["packages"].as_array()?.iter().find(is_meant)?;
    Path::new(package["manifest_path"].as_str()?).parent().map(Path::to_owned)
}

/// The texts that a crate's licence requires to be passed on, as far as they are files of the crate.
fn notices(folder: &Path, license: &str) -> Result<Vec<String>, String> {
    let mut names = Vec::new();
    for path in paths::entries(folder)? {
        let name = paths::name_of(&path);
        let upper = name.to_uppercase();
        if !["LICENSE", "LICENCE", "COPYING", "NOTICE"].iter().any(|start| upper.starts_with(start)) {
            continue;
        }
        match path.is_dir() {
            true => {
                let within = paths::entries(&path)?;
                names.extend(within.iter().map(|file| format!("{name}/{}", paths::name_of(file))));
            }
            false => names.push(name),
        }
    }
    names.sort();
    let choice = license.contains(" OR ") || license.contains('/');
    let mit = |name: &String| name.to_uppercase().contains("MIT");
    if choice && !license.contains(" AND ") && names.iter().any(mit) {
        names.retain(|name| mit(name) || name.to_uppercase().starts_with("NOTICE"));
    }
    names.iter().map(|name| paths::read(&folder.join(name)).map(|text| tidy(&text))).collect()
}

/// Lines end alike and without blanks, whatever the crate's authors use.
fn tidy(text: &str) -> String {
    let lines: Vec<&str> = text.trim_start_matches('\u{feff}').lines().map(str::trim_end).collect();
    lines.join("\n").trim_matches('\n').to_owned() + "\n"
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests")]

    use super::*;

    #[test]
    fn the_committed_notices_are_those_of_the_lock_file() {
        let committed = fs::read_to_string(path()).unwrap_or_default().replace("\r\n", "\n");
        assert!(committed == of_library().unwrap(), "other crates are linked now: run `cargo xtask notices`");
    }

    #[test]
    fn the_program_has_more_notices_than_the_library() {
        let (program, library) = (of_program(TARGET).unwrap(), of_library().unwrap());
        let names = |text: &str, name: &str| text.lines().any(|line| line.starts_with(name));
        // anise comes without a text of its own.
        for name in ["clap ", "rustix ", "anise "] {
            assert!(names(&program, name) && !names(&library, name), "{name}");
        }
        assert!(program.contains("\nanise, hifitime\n") || program.contains("\nhifitime, anise\n"));
    }

    #[test]
    fn lines_of_the_tree_are_crates_of_others() {
        let found = crate_of("toml v1.2.1+spec-1.1.0|MIT OR Apache-2.0 (*)").unwrap();
        let expected = ["toml", "1.2.1+spec-1.1.0", "MIT OR Apache-2.0"];
        assert_eq!([found.name.as_str(), found.version.as_str(), found.license.as_str()], expected);
        assert_eq!(crate_of("physics v0.1.0 (/home/me/physics)|MIT OR Apache-2.0"), None);
        assert_eq!(crate_of(""), None);
    }

    #[test]
    fn texts_are_compared_without_their_authors_line_ends() {
        assert_eq!(tidy("\u{feff}\r\na \r\n\r\n b\r\n\r\n"), "a\n\n b\n");
    }
}

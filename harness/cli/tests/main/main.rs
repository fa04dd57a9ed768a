//! Tests of the program as people run it: arguments in, text, files and exit status out.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::disallowed_methods,
    reason = "tests"
)]

mod annotated;
mod campaigns;
mod checked_files;
mod checks;
mod compares;
mod drawings;
mod encounters;
mod ephemerides;
mod files;
mod flyby_mistakes;
mod flybys;
mod hostile;
mod installed;
mod kernels;
mod legs;
mod limits;
mod mapped;
mod maps;
mod missions;
mod mistakes;
mod momentum_plans;
mod new_files;
mod objects;
mod packs;
mod plans;
mod plots;
mod refits;
mod replays;
mod runs;
mod size_answers;
mod sizes;
mod statuses;
mod sweeps;
mod timelines;
mod usage;

use std::{
    collections::BTreeMap,
    fs,
    path::{Path, PathBuf},
    process::{Command, Output},
    sync::{Mutex, PoisonError},
};

use tempfile::TempDir;

/// The program with arguments.
pub fn heliotorque(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_heliotorque"));
    command.args(arguments);
    command
}

/// The words of a command line; none of them has a blank.
pub fn words(line: &str) -> Vec<&str> {
    line.split(' ').collect()
}

/// Whether the tests run in their long extent, as `cargo xtask test --long` sets it.
pub fn is_long() -> bool {
    std::env::var_os("HELIOTORQUE_LONG").is_some()
}

/// What it printed, both streams.
pub fn text(output: &Output) -> String {
    String::from_utf8_lossy(&output.stdout).into_owned() + &String::from_utf8_lossy(&output.stderr)
}

/// Runs it and expects this exit status.
pub fn run(arguments: &[&str], status: i32) -> String {
    let output = heliotorque(arguments).output().unwrap();
    let text = text(&output);
    assert_eq!(output.status.code(), Some(status), "{arguments:?}: {text}");
    text
}

/// Asserts that a text has all of these parts.
#[track_caller]
pub fn says(text: &str, parts: &[&str]) {
    parts.iter().for_each(|part| assert!(text.contains(part), "{text} lacks {part}"));
}

/// A path as text.
pub fn shown(path: &Path) -> &str {
    path.to_str().unwrap()
}

/// The shared library of the probe models, or a line that gives the reason why a test is left out.
pub fn probe_library() -> Option<PathBuf> {
    built("HELIOTORQUE_PROBE_LIBRARY")
}

/// The shared library of the shipped models, likewise.
pub fn library() -> Option<PathBuf> {
    built("HELIOTORQUE_LIBRARY")
}

/// What `cargo xtask test` has built and names in `variable`; in CI it must be there.
#[track_caller]
pub fn built(variable: &str) -> Option<PathBuf> {
    let path = std::env::var_os(variable).map(PathBuf::from);
    if path.is_none() {
        assert!(std::env::var_os("CI").is_none(), "{variable} is not set");
        eprintln!("skipped: {variable} is not set: run `cargo xtask test`");
    }
    path
}

/// A packed probe model in a fresh folder.
pub fn packed(model: &str) -> Option<(TempDir, PathBuf)> {
    packed_from(&probe_library()?, model, &format!("{model}.fmu"), &[])
}

/// `template.fmu` in a fresh folder: a MomentumPlant, whose library reads every file.
pub fn template() -> Option<(TempDir, PathBuf)> {
    packed_from(&library()?, "MomentumPlant", "template.fmu", &[])
}

/// A model packed with these options in a fresh folder: by the first test that needs it, for the others a copy.
pub fn packed_from(library: &Path, model: &str, name: &str, more: &[&str]) -> Option<(TempDir, PathBuf)> {
    static PACKED: Mutex<BTreeMap<Vec<String>, Vec<u8>>> = Mutex::new(BTreeMap::new());
    let scratch = tempfile::tempdir().unwrap();
    let fmu = scratch.path().join(name);
    let key = [&[shown(library), model][..], more].concat().into_iter().map(str::to_owned).collect();
    let mut packed = PACKED.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(content) = packed.get(&key) {
        fs::write(&fmu, content).unwrap();
    } else {
        let pack = ["pack", "--library", shown(library), "--model", model, "--output", shown(&fmu)];
        run(&[&pack[..], more].concat(), 0);
        packed.insert(key, fs::read(&fmu).unwrap());
    }
    Some((scratch, fmu))
}

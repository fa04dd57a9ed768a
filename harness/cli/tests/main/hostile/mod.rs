//! FMUs that exit, crash, hang, print, allocate, fork and lie: `run` and `check` outlive them, name the call, keep the
//! rows and leave no process. They are compiled here from `tests/hostile/hostile.c`.
#![cfg(unix)]

mod checks;
mod commands;
mod runs;
mod sweeps;

use std::{
    fs,
    path::{Path, PathBuf},
    process::{Child, Command, Output, Stdio},
    time::{Duration, Instant},
};

use tempfile::TempDir;

use crate::{built, heliotorque, run, says, shown, text};

const DESCRIPTION: &str = include_str!("../../hostile/modelDescription.xml");

/// The time after which the test counts a command as hanging: far beyond what any of these takes.
const LONG: Duration = Duration::from_secs(60);

/// An unpacked FMU that does this behaviour at this place; `None`, with a line that gives the reason, where there is no compiler.
fn hostile(behaviour: &str, place: &str) -> Option<TempDir> {
    if Command::new("gcc").arg("--version").output().is_err() {
        assert!(std::env::var_os("CI").is_none(), "gcc is missing");
        eprintln!("skipped: hostile FMUs (no gcc on this machine)");
        return None;
    }
    let scratch = tempfile::tempdir().unwrap();
    let binaries = scratch.path().join("fmu/binaries").join(fmi::platform_folders()[0]);
    fs::create_dir_all(&binaries).unwrap();
    fs::create_dir_all(scratch.path().join("tmp")).unwrap();
    fs::write(scratch.path().join("fmu/modelDescription.xml"), DESCRIPTION).unwrap();
    let output = Command::new("gcc")
        .args(["-std=c11", "-O0", "-shared", "-fPIC", "-w"])
        .args([format!("-DBEHAVIOUR={behaviour}"), format!("-D{place}")])
        .arg(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/hostile/hostile.c"))
        .arg("-o")
        .arg(binaries.join(format!("Hostile{}", std::env::consts::DLL_SUFFIX)))
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", text(&output));
    Some(scratch)
}

/// The program with its temporary files in the scratch folder.
fn program(scratch: &TempDir, arguments: &[&str]) -> Command {
    let mut command = heliotorque(arguments);
    command.env("TMPDIR", scratch.path().join("tmp")).stdin(Stdio::null());
    command
}

/// A command on the FMU.
fn command(scratch: &TempDir, name: &str, more: &[&str]) -> Command {
    program(scratch, &[&[name, shown(&scratch.path().join("fmu"))], more].concat())
}

/// Waits for its end, which must not be long in coming.
fn wait(mut child: Child) -> Output {
    let began = Instant::now();
    while child.try_wait().unwrap().is_none() {
        if began.elapsed() > LONG {
            child.kill().unwrap();
            panic!("it hangs");
        }
        std::thread::sleep(Duration::from_millis(5));
    }
    child.wait_with_output().unwrap()
}

/// Waits until something is so.
#[track_caller]
fn until(is_so: impl Fn() -> bool) {
    let began = Instant::now();
    while !is_so() {
        assert!(began.elapsed() < LONG, "it does not come to that");
        std::thread::sleep(Duration::from_millis(1));
    }
}

fn start(mut command: Command) -> Child {
    command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap()
}

/// What it prints, once it ended with this status.
fn ended(scratch: &TempDir, name: &str, more: &[&str], status: i32) -> String {
    let output = start_to_file(scratch, command(scratch, name, more));
    let printed = text(&output);
    assert_eq!(output.status.code(), Some(status), "{printed}");
    nothing_left(scratch);
    printed
}

/// As `wait`, for programs that say more than a pipe holds.
fn start_to_file(scratch: &TempDir, mut command: Command) -> Output {
    let (out, err) = (scratch.path().join("stdout"), scratch.path().join("stderr"));
    command.stdout(fs::File::create(&out).unwrap()).stderr(fs::File::create(&err).unwrap());
    let mut output = wait(command.spawn().unwrap());
    output.stdout = fs::read(out).unwrap();
    output.stderr = fs::read(err).unwrap();
    output
}

/// Commands that load the library of an FMU in this folder, all but `run` and `check` of the FMU itself; an FMU of each of the
/// models stands there, with the library of the hostile one. `None` where there are none.
fn commands_that_load(scratch: &TempDir) -> Option<Vec<Vec<String>>> {
    let dist = built("HELIOTORQUE_DIST")?;
    let at = |name: &str| scratch.path().join(name);
    let platform = fmi::platform_folders()[0];
    let library = |fmu: &str, name: &str| {
        at(fmu).join("binaries").join(platform).join(format!("{name}{}", std::env::consts::DLL_SUFFIX))
    };
    for name in ["MomentumPlant", "SpinPlant"] {
        let folder = at(&format!("{name}.fmu"));
        fs::create_dir(&folder).unwrap();
        fmi::unpack(&dist.join(format!("{name}.fmu")), &folder, fmi::ArchiveLimits::default()).unwrap();
        fs::copy(library("fmu", "Hostile"), library(&format!("{name}.fmu"), name)).unwrap();
    }
    run(&["new", "spacecraft", shown(&at("my.toml"))], 0);
    run(&["new", "mission", shown(&at("m.toml"))], 0);
    let places = [
        ("PLANT", at("MomentumPlant.fmu")),
        ("SPIN", at("SpinPlant.fmu")),
        ("LIBRARY", library("fmu", "Hostile")),
        ("CRAFT", at("my.toml")),
        ("MISSION", at("m.toml")),
        ("OUT", at("out.fmu")),
        ("ROWS", at("out.csv")),
        ("TOML", at("out.toml")),
        ("PICTURE", at("out.svg")),
    ];
    let lines = [
        "pack --template PLANT --output OUT",
        "pack --library LIBRARY --model M --output OUT",
        "pack --mission MISSION --template PLANT --output OUT",
        "map PLANT --output PICTURE",
        "map CRAFT --template PLANT --output PICTURE",
        "info PLANT --coefficients",
        "check CRAFT --template PLANT",
        "check MISSION --template PLANT",
        "run MISSION --template PLANT --output ROWS",
        "ephemeris --template PLANT --start 2011-04-06TDB --stop 2011-05-06TDB --output TOML",
        "plan spin --template SPIN",
    ];
    let place = |word: &str| {
        let found = places.iter().find(|(name, _)| *name == word);
        found.map_or_else(|| word.to_owned(), |(_, path)| shown(path).to_owned())
    };
    Some(lines.map(|line| line.split(' ').map(place).collect()).to_vec())
}

/// One of [`commands_that_load`].
fn loading(scratch: &TempDir, command: &[String]) -> Command {
    program(scratch, &command.iter().map(String::as_str).collect::<Vec<_>>())
}

/// Whether a letter moves the cursor.
fn is_control(letter: char) -> bool {
    letter.is_control() && letter != '\n' && letter != '\t'
}

/// No temporary file, and no process that works in or on this folder.
fn nothing_left(scratch: &TempDir) {
    let left: Vec<PathBuf> =
        fs::read_dir(scratch.path().join("tmp")).unwrap().map(|entry| entry.unwrap().path()).collect();
    assert!(left.is_empty(), "{left:?}");
    until(|| processes(scratch.path()).is_empty());
}

/// Processes, no zombies, whose arguments or environment name this folder: children and what they start inherit that of the program.
fn processes(folder: &Path) -> Vec<u32> {
    let entries = fs::read_dir("/proc").into_iter().flatten().flatten();
    let numbers = entries.filter_map(|entry| entry.file_name().to_str()?.parse::<u32>().ok());
    let names_it = |number: &u32| {
        // Both of a zombie are empty.
        ["cmdline", "environ"].iter().any(|file| {
            let text = fs::read(format!("/proc/{number}/{file}")).unwrap_or_default();
            String::from_utf8_lossy(&text).contains(shown(folder))
        })
    };
    numbers.filter(names_it).collect()
}

fn rows(path: &Path) -> Vec<String> {
    let text = fs::read_to_string(path).unwrap_or_default();
    assert!(text.is_empty() || text.ends_with('\n'), "a damaged row: {text}");
    text.lines().skip(1).map(str::to_owned).collect()
}

fn signal(child: &Child, name: &str) {
    let kill = ["-c", "kill -$1 $2", "sh", name, &child.id().to_string()];
    assert!(Command::new("sh").args(kill).status().unwrap().success());
}

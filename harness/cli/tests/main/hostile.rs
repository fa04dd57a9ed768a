//! FMUs that exit, crash, hang, print, allocate, fork and lie: `run` and `check` outlive them, name the call, keep the
//! rows and leave no process. They are compiled here from `tests/hostile/hostile.c`.
#![cfg(unix)]

use std::{
    fs,
    path::{Path, PathBuf},
    process::{Child, Command, Output, Stdio},
    time::{Duration, Instant},
};

use tempfile::TempDir;

use crate::{built, heliotorque, run, shown, text};

const DESCRIPTION: &str = r#"<?xml version="1.0" encoding="UTF-8"?>
<fmiModelDescription fmiVersion="2.0" modelName="Hostile" guid="{hostile}">
  <CoSimulation modelIdentifier="Hostile" canHandleVariableCommunicationStepSize="true"/>
  <LogCategories><Category name="logStatusError"/></LogCategories>
  <DefaultExperiment startTime="0" stopTime="10" stepSize="1"/>
  <ModelVariables>
    <ScalarVariable name="x" valueReference="0" causality="output" initial="calculated"><Real/></ScalarVariable>
  </ModelVariables>
  <ModelStructure>
    <Outputs><Unknown index="1"/></Outputs>
    <InitialUnknowns><Unknown index="1"/></InitialUnknowns>
  </ModelStructure>
</fmiModelDescription>
"#;

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
    let binaries = scratch.path().join("fmu/binaries").join(loader::platform_folders()[0]);
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

fn command(scratch: &TempDir, name: &str, more: &[&str]) -> Command {
    let fmu = scratch.path().join("fmu");
    let mut command = heliotorque(&[&[name, shown(&fmu)], more].concat());
    command.env("TMPDIR", scratch.path().join("tmp")).stdin(Stdio::null());
    command
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
    let platform = loader::platform_folders()[0];
    let library = |fmu: &str, name: &str| {
        at(fmu).join("binaries").join(platform).join(format!("{name}{}", std::env::consts::DLL_SUFFIX))
    };
    for name in ["MomentumPlant", "SpinPlant"] {
        let folder = at(&format!("{name}.fmu"));
        fs::create_dir(&folder).unwrap();
        loader::unpack(&dist.join(format!("{name}.fmu")), &folder, loader::Limits::default()).unwrap();
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
        ("FOLDER", scratch.path().to_owned()),
        ("OUT", at("out")),
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
        "run MISSION --template PLANT --output OUT",
        "ephemeris PLANT --start 2011-04-06TDB --stop 2011-05-06TDB --output OUT",
        "plan spin --fmu SPIN",
        "study momentum/table2 --dist FOLDER --output OUT",
    ];
    let place = |word: &str| {
        let found = places.iter().find(|(name, _)| *name == word);
        found.map_or_else(|| word.to_owned(), |(_, path)| shown(path).to_owned())
    };
    Some(lines.map(|line| line.split(' ').map(place).collect()).to_vec())
}

#[test]
fn no_command_loads_a_library_in_its_own_process() {
    for (behaviour, expected) in [
        ("EXITS", "loading the shared library: the process ended: it exited with status 0"),
        ("LIES", "loading the shared library: the process ended: it exited with status 0"),
        ("CRASHES", "loading the shared library: the process ended: signal 11 (segmentation fault)"),
        ("ABORTS", "loading the shared library: the process ended: signal 6 (abort)"),
        ("ALLOCATES", "loading the shared library: the process ended: signal 6 (abort)"),
        ("SLEEPS", "hangs: "),
        ("PRINTS", "hangs: "),
    ] {
        let Some(scratch) = hostile(behaviour, "AT_LOADING") else { return };
        let Some(commands) = commands_that_load(&scratch) else { return };
        for words in commands {
            let words: Vec<&str> = words.iter().map(String::as_str).collect();
            let mut command = heliotorque(&[&words[..], &["--timeout", "0.4s"]].concat());
            command.env("TMPDIR", scratch.path().join("tmp")).stdin(Stdio::null());
            let output = start_to_file(&scratch, command);
            let printed = text(&output);
            assert_eq!(output.status.code(), Some(1), "{behaviour}, {words:?}: {printed}");
            let named =
                printed.lines().filter(|line| line.contains("heliotorque: ") && line.contains(expected));
            assert_eq!(named.count(), 1, "{behaviour}, {words:?}: {printed}");
            assert!(printed.len() < 3 << 20, "{behaviour}, {words:?}: {} bytes", printed.len());
            for name in ["out", "out.svg"] {
                assert!(!scratch.path().join(name).exists(), "{behaviour}, {words:?}");
            }
            nothing_left(&scratch);
        }
    }
}

#[cfg(target_os = "linux")]
#[test]
fn ctrl_c_ends_every_command_that_loads_a_library_that_hangs() {
    let Some(scratch) = hostile("SLEEPS", "AT_LOADING") else { return };
    let Some(commands) = commands_that_load(&scratch) else { return };
    for words in commands {
        let words: Vec<&str> = words.iter().map(String::as_str).collect();
        let mut command = heliotorque(&words);
        command.env("TMPDIR", scratch.path().join("tmp")).stdin(Stdio::null());
        let child = start(command);
        let began = Instant::now();
        while processes(scratch.path()).len() < 2 {
            assert!(began.elapsed() < LONG, "{words:?} does not begin");
            std::thread::sleep(Duration::from_millis(1));
        }
        signal(&child, "INT");
        let raised = Instant::now();
        let output = wait(child);
        assert_eq!(output.status.code(), Some(130), "{words:?}: {}", text(&output));
        assert!(raised.elapsed() < Duration::from_secs(1), "{words:?}: {:?}", raised.elapsed());
        nothing_left(&scratch);
    }
}

#[test]
fn a_library_that_hangs_or_exits_while_it_describes_its_models_is_named_with_the_call() {
    for (behaviour, expected) in [
        ("SLEEPS", "hangs: the call did not return within 0.3 s (see --timeout)"),
        ("EXITS", "the process ended"),
    ] {
        let Some(scratch) = hostile(behaviour, "IN_DESCRIBE") else { return };
        let fmu = scratch.path().join("fmu");
        for name in ["pack", "map"] {
            let more: &[&str] = if name == "pack" { &["--template", shown(&fmu)] } else { &[shown(&fmu)] };
            let mut command = heliotorque(&[&[name, "--timeout", "0.3s"], more].concat());
            command.env("TMPDIR", scratch.path().join("tmp")).stdin(Stdio::null());
            let output = start_to_file(&scratch, command);
            let printed = text(&output);
            assert_eq!(output.status.code(), Some(1), "{behaviour}, {name}: {printed}");
            assert!(
                printed.contains(&format!("fmi_export_describe: {expected}")),
                "{behaviour}, {name}: {printed}"
            );
            nothing_left(&scratch);
        }
    }
}

/// No temporary file, and no process that works in or on this folder.
fn nothing_left(scratch: &TempDir) {
    let left: Vec<PathBuf> =
        fs::read_dir(scratch.path().join("tmp")).unwrap().map(|entry| entry.unwrap().path()).collect();
    assert!(left.is_empty(), "{left:?}");
    let began = Instant::now();
    while !processes(scratch.path()).is_empty() {
        assert!(began.elapsed() < LONG, "processes are left: {:?}", processes(scratch.path()));
        std::thread::sleep(Duration::from_millis(5));
    }
}

/// Processes, no zombies, whose arguments name this folder.
fn processes(folder: &Path) -> Vec<u32> {
    let entries = fs::read_dir("/proc").into_iter().flatten().flatten();
    let numbers = entries.filter_map(|entry| entry.file_name().to_str()?.parse::<u32>().ok());
    let names_it = |number: &u32| {
        // The arguments of a zombie are empty.
        let arguments = fs::read(format!("/proc/{number}/cmdline")).unwrap_or_default();
        String::from_utf8_lossy(&arguments).contains(shown(folder))
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

#[test]
fn a_run_names_the_call_that_killed_or_stopped_it_and_keeps_the_rows() {
    let in_step = "fmi2DoStep(currentCommunicationPoint=3, communicationStepSize=1): ";
    for (behaviour, more, expected) in [
        ("EXITS", &[][..], "the process ended: it exited with status 0"),
        ("CRASHES", &[], "signal 11 (segmentation fault)"),
        ("ABORTS", &[], "signal 6 (abort)"),
        ("FAILS", &[], "answered fmi2Error"),
        ("LIES", &[], "the process ended: it exited with status 0"),
        ("SLEEPS", &["--timeout", "0.3s"], "hangs: the call did not return within 0.3 s (see --timeout)"),
        ("SPINS", &["--timeout", "300ms"], "hangs: the call did not return within 0.3 s (see --timeout)"),
        ("PRINTS", &["--timeout", "0.5s"], "hangs: the call did not return within 0.5 s (see --timeout)"),
    ] {
        let Some(scratch) = hostile(behaviour, "IN_STEP") else { return };
        let (table, part) = (scratch.path().join("a.csv"), scratch.path().join("a.csv.part"));
        fs::write(&table, "the last good one").unwrap();
        let printed = ended(&scratch, "run", &[&["--output", shown(&table)], more].concat(), 1);
        assert!(printed.contains(in_step) && printed.contains(expected), "{behaviour}: {printed}");
        assert!(
            printed.contains("4 rows so far: ") && printed.contains("a.csv.part"),
            "{behaviour}: {printed}"
        );
        assert_eq!(rows(&part), ["0,0", "1,1", "2,2", "3,3"], "{behaviour}");
        assert_eq!(fs::read_to_string(&table).unwrap(), "the last good one", "{behaviour}");
        // What it prints is bounded.
        assert!(printed.len() < 3 << 20, "{behaviour}: {} bytes", printed.len());
    }
}

#[test]
fn nan_is_an_error_that_names_the_variable_and_keeps_the_rows_before() {
    let Some(scratch) = hostile("ANSWERS_NAN", "IN_STEP") else { return };
    let table = scratch.path().join("a.csv");
    let printed = ended(&scratch, "run", &["--output", shown(&table)], 1);
    assert!(printed.contains("fmi2GetReal(x): answered NaN at 3 s"), "{printed}");
    assert_eq!(rows(&scratch.path().join("a.csv.part")), ["0,0", "1,1", "2,2"]);
    assert!(!table.exists());
}

#[test]
fn a_run_names_the_call_before_the_first_step_too() {
    for (place, expected) in
        [("IN_INSTANTIATE", "fmi2Instantiate: "), ("AT_LOADING", "loading the shared library: ")]
    {
        let Some(scratch) = hostile("CRASHES", place) else { return };
        let table = scratch.path().join("a.csv");
        let printed = ended(&scratch, "run", &["--output", shown(&table)], 1);
        assert!(printed.contains(expected) && printed.contains("segmentation fault"), "{printed}");
        assert!(!table.exists() && !scratch.path().join("a.csv.part").exists());
    }
}

#[test]
fn what_an_fmu_forks_ends_with_the_run_and_sends_nothing() {
    for behaviour in ["FORKS", "RETURNS_TWICE"] {
        let Some(scratch) = hostile(behaviour, "IN_STEP") else { return };
        let table = scratch.path().join("a.csv");
        ended(&scratch, "run", &["--stop", "6", "--output", shown(&table)], 0);
        assert_eq!(rows(&table), ["0,0", "1,1", "2,2", "3,3", "4,4", "5,5", "6,6"], "{behaviour}");
    }
}

#[test]
fn a_check_outlives_every_fmu_and_leaves_nothing() {
    for (behaviour, place, expected) in [
        (
            "EXITS",
            "IN_STEP",
            "fmi2DoStep(currentCommunicationPoint=3, communicationStepSize=1): the process ended",
        ),
        ("CRASHES", "IN_STEP", "segmentation fault"),
        ("CRASHES", "AT_LOADING", "loading the shared library: the process ended"),
        ("SLEEPS", "IN_INSTANTIATE", "fmi2Instantiate: hangs: still busy after 1 s in all (see --timeout)"),
        ("SPINS", "IN_INSTANTIATE", "fmi2Instantiate: hangs: still busy after 1 s in all (see --timeout)"),
        // Of 64 MiB each, with those of the process itself 4 GiB.
        ("ALLOCATES", "IN_INSTANTIATE", "it could allocate 6"),
        ("LIES", "IN_INSTANTIATE", "fmi2Instantiate: the process ended: it exited with status 0"),
        // Fewer than it may, for the process has files of its own.
        ("OPENS", "IN_INSTANTIATE", "it could open 10"),
    ] {
        let Some(scratch) = hostile(behaviour, place) else { return };
        let printed = ended(&scratch, "check", &["--only", "simulation", "--timeout", "1s"], 1);
        assert!(printed.contains(expected), "{behaviour}: {printed}");
        // What it printed last is quoted, and nothing it printed is a verdict.
        let is_verdict = |line: &str| line.contains("everything is fine") && !line.contains("| ");
        assert!(!printed.lines().any(is_verdict) && printed.contains("1 wrong"), "{behaviour}: {printed}");
    }
}

#[test]
fn a_check_takes_no_verdict_from_a_fork_and_waits_for_none() {
    for behaviour in ["FORKS", "RETURNS_TWICE"] {
        let Some(scratch) = hostile(behaviour, "IN_INSTANTIATE") else { return };
        let printed = ended(&scratch, "check", &["--only", "simulation", "--timeout", "20s", "--verbose"], 0);
        assert_eq!(printed.matches("comes to its end").count().max(1), 1, "{printed}");
        assert!(!printed.contains("hangs") && !printed.contains("WRONG  "), "{printed}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_check_of_an_fmu_that_prints_without_end_stays_small() {
    let Some(scratch) = hostile("PRINTS", "IN_INSTANTIATE") else { return };
    let mut child = start(command(&scratch, "check", &["--only", "simulation"]));
    let mut most_kb = 0;
    while child.try_wait().unwrap().is_none() {
        let status = fs::read_to_string(format!("/proc/{}/status", child.id())).unwrap_or_default();
        let peak = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
        let peak = peak.and_then(|text| text.trim().strip_suffix(" kB")?.parse::<u64>().ok());
        most_kb = most_kb.max(peak.unwrap_or(0));
        std::thread::sleep(Duration::from_millis(1));
    }
    let printed = text(&wait(child));
    assert!(printed.contains("fmi2Instantiate: prints without end: more than 16 MiB"), "{printed}");
    assert!((1..100_000).contains(&most_kb), "{most_kb} kB");
    nothing_left(&scratch);
}

#[cfg(target_os = "linux")]
#[test]
fn signals_end_what_hangs_and_leave_nothing() {
    for (name, place) in [("run", "IN_STEP"), ("check", "IN_INSTANTIATE")] {
        for signal_name in ["INT", "TERM", "HUP"] {
            let Some(scratch) = hostile("SLEEPS", place) else { return };
            let table = scratch.path().join("a.csv");
            let more: &[&str] =
                if name == "run" { &["--output", shown(&table)] } else { &["--only", "simulation"] };
            let child = start(command(&scratch, name, more));
            // Parent and child; the run has sent its rows.
            let began = Instant::now();
            let is_ready = || {
                let hangs = name == "check" || rows(&scratch.path().join("a.csv.part")).len() == 4;
                hangs && processes(scratch.path()).len() == 2
            };
            while !is_ready() {
                assert!(began.elapsed() < LONG, "it does not begin");
                std::thread::sleep(Duration::from_millis(5));
            }
            signal(&child, signal_name);
            let raised = Instant::now();
            let output = wait(child);
            assert!(
                raised.elapsed() < Duration::from_secs(1),
                "{name}, {signal_name}: {:?}",
                raised.elapsed()
            );
            let printed = text(&output);
            assert_eq!(output.status.code(), Some(130), "{name}, {signal_name}: {printed}");
            nothing_left(&scratch);
            if name == "run" {
                assert!(
                    printed.contains("interrupted at 3 s") && printed.contains("fmi2DoStep("),
                    "{printed}"
                );
                assert_eq!(rows(&table).len(), 4);
                assert!(!scratch.path().join("a.csv.part").exists());
            }
        }
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_daemon_that_an_fmu_leaves_behind_is_ended_and_named() {
    const LEFT: &str = "left processes behind, which were ended: ";
    let Some(scratch) = hostile("DETACHES", "IN_STEP") else { return };
    let table = scratch.path().join("a.csv");
    let printed = ended(&scratch, "run", &["--output", shown(&table)], 0);
    assert!(printed.contains(&format!("Hostile: {LEFT}")) && printed.contains("(heliotorque)"), "{printed}");
    assert_eq!(rows(&table).len(), 11);

    let Some(scratch) = hostile("DETACHES", "IN_INSTANTIATE") else { return };
    let printed = ended(&scratch, "check", &["--only", "simulation", "--timeout", "20s"], 0);
    assert!(printed.contains(&format!("note    {LEFT}")), "{printed}");

    let Some(scratch) = hostile("DETACHES", "AT_LOADING") else { return };
    let fmu = scratch.path().join("fmu");
    let mut command = heliotorque(&["pack", "--template", shown(&fmu)]);
    command.env("TMPDIR", scratch.path().join("tmp")).stdin(Stdio::null());
    let printed = text(&start_to_file(&scratch, command));
    assert!(printed.contains(LEFT), "{printed}");
    nothing_left(&scratch);
}

#[cfg(target_os = "linux")]
#[test]
fn a_signal_ends_a_daemon_too() {
    for (name, place) in [("run", "IN_STEP"), ("check", "IN_INSTANTIATE")] {
        let Some(scratch) = hostile("DETACHES", place) else { return };
        let more: &[&str] =
            if name == "run" { &["--stop", "40000000", "--record", "x", "--every", "1h"] } else { &[] };
        let child = start(command(&scratch, name, more));
        let began = Instant::now();
        while processes(scratch.path()).len() < 3 {
            assert!(began.elapsed() < LONG, "it does not begin");
            std::thread::sleep(Duration::from_millis(1));
        }
        signal(&child, "TERM");
        let output = wait(child);
        assert_eq!(output.status.code(), Some(130), "{name}: {}", text(&output));
        nothing_left(&scratch);
    }
}

#[test]
fn one_time_bounds_the_whole_check() {
    let Some(scratch) = hostile("SLEEPS", "IN_INSTANTIATE") else { return };
    let began = Instant::now();
    let printed = ended(&scratch, "check", &["--timeout", "2s"], 1);
    assert!(began.elapsed() < Duration::from_secs(6), "{:?}", began.elapsed());
    assert!(printed.contains("still busy after 2 s in all (see --timeout)"), "{printed}");
    assert!(printed.contains("skipped the 2 s of the check are over (see --timeout)"), "{printed}");
}

#[cfg(target_os = "linux")]
#[test]
fn temporary_folders_of_a_killed_program_are_removed_by_the_next() {
    let Some(scratch) = hostile("SLEEPS", "IN_INSTANTIATE") else { return };
    let temporaries = || fs::read_dir(scratch.path().join("tmp")).unwrap().count();
    let mut child = start(command(&scratch, "check", &["--only", "simulation"]));
    let began = Instant::now();
    while processes(scratch.path()).len() < 2 {
        assert!(began.elapsed() < LONG, "it does not begin");
        std::thread::sleep(Duration::from_millis(1));
    }
    // One that runs keeps its own.
    let _ = text(&wait(start(command(&scratch, "check", &["--only", "simulation", "--timeout", "0.2s"]))));
    assert_eq!(temporaries(), 1);
    child.kill().unwrap();
    child.wait().unwrap();
    assert_eq!(temporaries(), 1);
    ended(&scratch, "check", &["--only", "simulation", "--timeout", "0.2s"], 1);
}

#[test]
fn a_run_ends_when_the_reader_of_its_output_goes() {
    let Some(scratch) = hostile("FAILS", "NOWHERE") else { return };
    // Minutes, if nobody ends it.
    let endless = ["--stop", "60000000", "--output", "-", "--quiet"];
    let began = Instant::now();
    let mut child = start(command(&scratch, "run", &endless));
    let mut line = String::new();
    let mut reader = std::io::BufReader::new(child.stdout.take().unwrap());
    std::io::BufRead::read_line(&mut reader, &mut line).unwrap();
    assert_eq!(line, "time,x\n");
    drop(reader);
    let output = wait(child);
    assert!(began.elapsed() < Duration::from_secs(10), "{:?}", began.elapsed());
    assert_eq!((output.status.code(), text(&output)), (Some(0), String::new()));
    nothing_left(&scratch);
    // A picture that is not drawn is no success.
    let picture = scratch.path().join("a.svg");
    let mut child = start(command(&scratch, "run", &[&endless[..], &["--plot", shown(&picture)]].concat()));
    drop(child.stdout.take());
    let output = wait(child);
    assert!(
        text(&output).contains("nobody reads the standard output any more: the run ends at"),
        "{output:?}"
    );
    assert!(output.status.code() == Some(1) && !picture.exists());
}

#[cfg(target_os = "linux")]
#[test]
fn a_run_that_is_killed_leaves_whole_rows_and_no_process() {
    let Some(scratch) = hostile("SLEEPS", "IN_STEP") else { return };
    let (table, part) = (scratch.path().join("a.csv"), scratch.path().join("a.csv.part"));
    fs::write(&table, "the last good one").unwrap();
    let mut child = start(command(&scratch, "run", &["--output", shown(&table)]));
    let began = Instant::now();
    while rows(&part).len() < 4 {
        assert!(began.elapsed() < LONG, "it does not begin");
        std::thread::sleep(Duration::from_millis(5));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    nothing_left(&scratch);
    assert_eq!(rows(&part).len(), 4);
    assert_eq!(fs::read_to_string(&table).unwrap(), "the last good one");
    // The next run takes its place.
    ended(&scratch, "run", &["--stop", "3", "--output", shown(&table)], 0);
    assert_eq!(rows(&table).len(), 4);
    assert!(!part.exists());
}

#[test]
fn what_an_fmu_says_moves_no_cursor() {
    let Some(scratch) = hostile("STAINS", "IN_STEP") else { return };
    let printed = ended(&scratch, "run", &["--log"], 1);
    assert!(
        printed.contains("\\u{1b}[2Jcleared\\u{7}") && printed.contains("\\u{1b}]0;title\\u{7} a\\rb"),
        "{printed}"
    );
    let is_control = |letter: char| letter.is_control() && letter != '\n' && letter != '\t';
    assert!(!printed.contains(is_control), "{printed:?}");
    // Names and texts of the description too.
    let xml = DESCRIPTION.replace("guid=", "description=\"&#x9b;2J &#x85;\" guid=");
    fs::write(scratch.path().join("fmu/modelDescription.xml"), xml).unwrap();
    let printed = ended(&scratch, "info", &[], 0);
    assert!(printed.contains("\\u{9b}2J") && !printed.contains(is_control), "{printed:?}");
}

#[test]
fn what_a_template_prints_moves_no_cursor() {
    let Some(scratch) = hostile("STAINS", "AT_LOADING") else { return };
    let Some(commands) = commands_that_load(&scratch) else { return };
    for words in commands {
        let words: Vec<&str> = words.iter().map(String::as_str).collect();
        let mut command = heliotorque(&words);
        command.env("TMPDIR", scratch.path().join("tmp")).stdin(Stdio::null());
        let printed = text(&start_to_file(&scratch, command));
        let is_control = |letter: char| letter.is_control() && letter != '\n' && letter != '\t';
        assert!(printed.contains("\\u{1b}[2Jcleared\\u{7}"), "{words:?}: {printed}");
        assert!(!printed.contains(is_control), "{words:?}: {printed:?}");
    }
}

/// Both components are the same FMU; the first one is stepped first.
const SYSTEM: &str = r#"<ssd:SystemStructureDescription name="Pair" version="1.0"><ssd:System name="Pair"><ssd:Elements>
<ssd:Component name="one" source="resources/hostile.fmu"/><ssd:Component name="two" source="resources/hostile.fmu"/>
</ssd:Elements></ssd:System></ssd:SystemStructureDescription>"#;

#[test]
fn a_component_that_crashes_or_hangs_is_named_with_its_call_and_the_rows_stay() {
    for (behaviour, more, said) in [
        ("CRASHES", &[][..], "the process ended"),
        ("SLEEPS", &["--timeout", "0.5"], "did not return within 0.5 s"),
    ] {
        let Some(scratch) = hostile(behaviour, "IN_STEP") else { return };
        let system = scratch.path().join("system");
        fs::create_dir_all(system.join("resources")).unwrap();
        fs::rename(scratch.path().join("fmu"), system.join("resources/hostile.fmu")).unwrap();
        fs::write(system.join("SystemStructure.ssd"), SYSTEM).unwrap();
        fs::rename(&system, scratch.path().join("fmu")).unwrap();
        let csv = scratch.path().join("rows.csv");
        let printed = ended(&scratch, "run", &[&["--output", shown(&csv)], more].concat(), 1);
        let call = "Pair, component one: fmi2DoStep(currentCommunicationPoint=3";
        assert!(printed.contains(call) && printed.contains(said), "{printed}");
        let rows = fs::read_to_string(scratch.path().join("rows.csv.part")).unwrap();
        assert_eq!(rows, "time,one.x,two.x\n0,0,0\n1,1,1\n2,2,2\n3,3,3\n");
    }
}

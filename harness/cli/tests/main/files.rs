//! Files are written whole or not at all, inputs stay, and what is no file is refused by name.
#![cfg(unix)]

use std::{
    fs,
    os::unix::fs::{MetadataExt, symlink},
    path::Path,
    process::{Command, Stdio},
    time::Duration,
};

use crate::{heliotorque, packed, probe_library, run, says, shown, text};

/// Names of a folder's files.
fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    let mut names: Vec<String> =
        entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

fn fifo(path: &Path) {
    assert!(Command::new("mkfifo").arg(path).status().unwrap().success());
}

#[test]
fn no_file_is_written_in_place() {
    let Some((scratch, fmu)) = packed("AllTypes") else { return };
    let library = probe_library().unwrap();
    let at = |name: &str| scratch.path().join(name);
    let (table, picture, archive) = (at("a.csv"), at("a.svg"), at("a.fmu"));
    // Who holds the old content keeps it: the new one is another file.
    for path in [&table, &picture, &archive] {
        fs::write(path, "old").unwrap();
        fs::hard_link(path, at(&format!("held-{}", path.extension().unwrap().display()))).unwrap();
    }
    run(&["run", shown(&fmu), "--output", shown(&table), "--output", shown(&picture)], 0);
    run(&["pack", "--library", shown(&library), "--model", "AllTypes", "--output", shown(&archive)], 0);
    for extension in ["csv", "svg", "fmu"] {
        assert_eq!(fs::read_to_string(at(&format!("held-{extension}"))).unwrap(), "old");
        assert!(fs::metadata(at(&format!("a.{extension}"))).unwrap().len() > 3);
    }
    assert!(!names(scratch.path()).iter().any(|name| name.ends_with(".tmp") || name.ends_with(".part")));
}

#[cfg(target_os = "linux")]
#[test]
fn a_killed_program_leaves_the_old_file_or_the_new_one() {
    let Some((scratch, fmu)) = packed("AllTypes") else { return };
    let library = probe_library().unwrap();
    let at = |name: &str| scratch.path().join(name);
    let (picture, archive) = (at("a.svg"), at("a.fmu"));
    let plot = ["run", shown(&fmu), "--quiet", "--output", shown(&picture)];
    let pack = ["pack", "--library", shown(&library), "--model", "AllTypes", "--output", shown(&archive)];
    for (arguments, target) in [(&plot[..], &picture), (&pack[..], &archive)] {
        let began = std::time::Instant::now();
        run(arguments, 0);
        let whole_run = began.elapsed();
        let whole = fs::read(target).unwrap();
        let mut kills = 0;
        for part in 0..40 {
            fs::write(target, "old").unwrap();
            let mut child =
                heliotorque(arguments).stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
            std::thread::sleep(whole_run * part / 40);
            child.kill().unwrap();
            kills += u32::from(!child.wait().unwrap().success());
            let found = fs::read(target).unwrap();
            assert!(found == b"old" || found == whole, "damaged after {part}/40 of {whole_run:?}");
        }
        assert!(kills > 10, "it was too fast to be killed: {kills}");
    }
}

#[test]
fn an_input_is_never_written_over() {
    let Some((scratch, fmu)) = packed("AllTypes") else { return };
    let at = |name: &str| scratch.path().join(name);
    let input = at("in.csv");
    fs::write(&input, "time,input.real\n0,1\n").unwrap();
    let before = (fs::read(&fmu).unwrap(), fs::read(&input).unwrap());
    fs::hard_link(&input, at("hard.csv")).unwrap();
    symlink("hard.csv", at("soft.csv")).unwrap();
    fs::hard_link(&fmu, at("hard.svg")).unwrap();
    fs::hard_link(&fmu, at("hard.fmu")).unwrap();
    let simulate = ["run", shown(&fmu), "--input", shown(&input)];
    for (option, path) in [
        ("--output", &input),
        ("--output", &at("hard.csv")),
        ("--output", &at("soft.csv")),
        ("--output", &at("hard.svg")),
    ] {
        let printed = run(&[&simulate[..], &[option, shown(path)]].concat(), 2);
        says(&printed, &["it is an input too", &format!("see {option}")]);
    }
    // The recording in progress would be the input.
    fs::rename(&input, at("x.csv.part")).unwrap();
    let part = at("x.csv.part");
    let printed = run(&["run", shown(&fmu), "--input", shown(&part), "--output", shown(&at("x.csv"))], 2);
    assert!(printed.contains("x.csv.part: it is an input too"), "{printed}");
    // One file for two outputs, by two names.
    fs::write(at("y.csv"), "").unwrap();
    fs::hard_link(at("y.csv"), at("y.svg")).unwrap();
    let (one, other) = (at("y.csv"), at("y.svg"));
    let both = run(&["run", shown(&fmu), "--output", shown(&one), "--output", shown(&other)], 2);
    says(&both, &["one file cannot take table and picture"]);

    let library = probe_library().unwrap();
    let copy = at("library.so");
    fs::copy(&library, &copy).unwrap();
    fs::hard_link(&copy, at("hard.so")).unwrap();
    let toml = at("my.toml");
    fs::write(&toml, "").unwrap();
    for path in [&copy, &at("hard.so"), &toml] {
        let pack = ["pack", "--library", shown(&copy), "--model", "AllTypes", "--spacecraft", shown(&toml)];
        let printed = run(&[&pack[..], &["--output", shown(path)]].concat(), 2);
        assert!(printed.contains("it is an input too") || printed.contains("my.toml"), "{printed}");
    }
    let printed = run(&["pack", "--template", shown(&fmu), "--output", shown(&at("hard.fmu"))], 2);
    assert!(printed.contains("it is an input too"), "{printed}");
    assert_eq!((fs::read(&fmu).unwrap(), fs::read(&part).unwrap()), before);
    assert_eq!(fs::read(&copy).unwrap(), fs::read(&library).unwrap());
}

#[test]
fn what_is_no_file_is_refused_by_name() {
    let Some((scratch, fmu)) = packed("AllTypes") else { return };
    let at = |name: &str| scratch.path().join(name);
    for name in ["pipe.csv", "pipe.svg", "pipe.fmu", "pipe.toml"] {
        fifo(&at(name));
    }
    fs::create_dir(at("folder.svg")).unwrap();
    symlink("/dev/zero", at("zero.fmu")).unwrap();
    let library = probe_library().unwrap();
    let (csv, svg, archive, toml) = (at("pipe.csv"), at("pipe.svg"), at("pipe.fmu"), at("pipe.toml"));
    let (folder, zero) = (at("folder.svg"), at("zero.fmu"));
    let simulate = ["run", shown(&fmu)];
    let from_library = ["pack", "--library", shown(&library), "--model", "AllTypes"];
    let cases: Vec<(Vec<&str>, &str, &str)> = vec![
        (vec!["run", shown(&archive)], "pipe.fmu", "found a FIFO, allowed: a regular file"),
        (vec!["info", shown(&zero)], "zero.fmu", "found a character device, allowed: a regular file"),
        (vec!["check", shown(&archive)], "pipe.fmu", "found a FIFO"),
        (vec!["check", shown(&toml), "--template", shown(&fmu)], "pipe.toml", "found a FIFO"),
        ([&simulate[..], &["--input", shown(&csv)]].concat(), "pipe.csv", "found a FIFO"),
        ([&simulate[..], &["--input", shown(&folder)]].concat(), "folder.svg", "found a directory"),
        (
            [&simulate[..], &["--output", shown(&csv)]].concat(),
            "pipe.csv",
            "found a FIFO, allowed: a regular file or -",
        ),
        (
            [&simulate[..], &["--output", "/dev/null"]].concat(),
            "/dev/null",
            "allowed: .csv, .svg, or - for CSV",
        ),
        ([&simulate[..], &["--output", shown(&svg)]].concat(), "pipe.svg", "found a FIFO"),
        ([&simulate[..], &["--output", shown(&folder)]].concat(), "folder.svg", "found a directory"),
        ([&from_library[..], &["--output", shown(&archive)]].concat(), "pipe.fmu", "found a FIFO"),
        ([&from_library[..], &["--spacecraft", shown(&toml)]].concat(), "pipe.toml", "found a FIFO"),
        (vec!["pack", "--library", shown(&archive), "--model", "M"], "pipe.fmu", "found a FIFO"),
        (vec!["pack", "--template", shown(&archive)], "pipe.fmu", "found a FIFO"),
    ];
    for (arguments, name, expected) in cases {
        // What is wrong with an FMU is the answer of `check`.
        let is_answer = arguments[..2] == ["check", shown(&archive)];
        let printed = run(&arguments, if is_answer { 1 } else { 2 });
        assert!(printed.contains(name) && printed.contains(expected), "{arguments:?}: {printed}");
    }
}

#[test]
fn a_dash_is_the_standard_output() {
    let Some((scratch, fmu)) = packed("AllTypes") else { return };
    let table = scratch.path().join("a.csv");
    let simulate = ["run", shown(&fmu), "--record", "output.*", "--output"];
    run(&[&simulate[..], &[shown(&table)]].concat(), 0);
    let output = heliotorque(&[&simulate[..], &["-"]].concat()).output().unwrap();
    assert!(output.status.success() && output.stdout == fs::read(&table).unwrap(), "{}", text(&output));
    assert!(run(&[&simulate[..], &["-", "--output", "-"]].concat(), 2).contains("found two files of .csv"));
    let library = probe_library().unwrap();
    let pack = ["pack", "--library", shown(&library), "--model", "AllTypes", "--output", "-"];
    let output = heliotorque(&pack).current_dir(scratch.path()).output().unwrap();
    assert!(output.status.success() && output.stdout == fs::read(&fmu).unwrap());
    assert!(!scratch.path().join("-").exists());
}

#[test]
fn a_dash_is_the_standard_input() {
    let Some((scratch, fmu)) = packed("AllTypes") else { return };
    let (input, temporary) = (scratch.path().join("in.csv"), scratch.path().join("tmp"));
    fs::create_dir(&temporary).unwrap();
    let simulate = |path: &str, table: &str| {
        fs::write(&input, table).unwrap();
        let times = ["--stop", "8", "--step", "1", "--record", "output.integral", "--output", "-"];
        let mut command = heliotorque(&[&["run", shown(&fmu), "--input", path], &times[..]].concat());
        command.env("TMPDIR", &temporary).stdin(fs::File::open(&input).unwrap()).output().unwrap()
    };
    let table = "time,input.real\n0,0\n4,4\n";
    let (piped, named) = (simulate("-", table), simulate(shown(&input), table));
    assert!(piped.status.success() && piped.stdout == named.stdout, "{}", text(&piped));
    assert!(text(&piped).lines().count() > 8, "{}", text(&piped));
    let wrong = simulate("-", "time,input.rael\n");
    assert_eq!(wrong.status.code(), Some(2));
    assert!(text(&wrong).contains("-: ") && text(&wrong).contains("near it: input.real"), "{}", text(&wrong));
    assert!(names(&temporary).is_empty(), "{:?}", names(&temporary));
}

#[test]
fn a_signal_leaves_no_temporary_file() {
    let Some((scratch, fmu)) = packed("AllTypes") else { return };
    let temporary = scratch.path().join("tmp");
    fs::create_dir(&temporary).unwrap();
    // Hours of stepping, from a folder that the archive was unpacked into.
    let mut command = heliotorque(&["run", shown(&fmu), "--stop", "1e10", "--step", "1", "--every", "1e5"]);
    let child = command.env("TMPDIR", &temporary).stderr(Stdio::piped()).spawn().unwrap();
    while names(&temporary).is_empty() {
        std::thread::sleep(Duration::from_millis(1));
    }
    std::thread::sleep(Duration::from_millis(100));
    let kill = ["-c", "kill -TERM $1", "sh", &child.id().to_string()];
    assert!(Command::new("sh").args(kill).status().unwrap().success());
    assert_eq!(child.wait_with_output().unwrap().status.code(), Some(130));
    assert!(names(&temporary).is_empty(), "{:?}", names(&temporary));
}

#[test]
fn a_new_file_has_the_permissions_of_its_user() {
    let Some((scratch, fmu)) = packed("AllTypes") else { return };
    let (plain, table) = (scratch.path().join("plain"), scratch.path().join("a.csv"));
    fs::write(&plain, "").unwrap();
    let picture = scratch.path().join("a.svg");
    run(&["run", shown(&fmu), "--output", shown(&table), "--output", shown(&picture)], 0);
    let mode = |path: &Path| fs::metadata(path).unwrap().mode();
    for path in [&table, &picture, &fmu] {
        assert_eq!(mode(path), mode(&plain), "{}", path.display());
    }
}

#[test]
fn two_runs_with_one_output_do_not_mix() {
    let Some((scratch, fmu)) = packed("Empty") else { return };
    let at = |name: &str| scratch.path().join(name);
    let start = |stop: &str, table: &Path| {
        let arguments =
            ["run", shown(&fmu), "--stop", stop, "--step", "1", "--quiet", "--output", shown(table)];
        heliotorque(&arguments).stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap()
    };
    let stops = ["200000", "150000"];
    let alone = stops.map(|stop| {
        let table = at(&format!("{stop}.csv"));
        assert!(start(stop, &table).wait_with_output().unwrap().status.success());
        fs::read(table).unwrap()
    });
    let mut refusals = 0;
    for pair in 0..10 {
        let table = at(&format!("pair-{pair}.csv"));
        let outputs = stops.map(|stop| start(stop, &table)).map(|child| child.wait_with_output().unwrap());
        let good: Vec<usize> = (0..2).filter(|index| outputs[*index].status.success()).collect();
        assert!(!good.is_empty(), "{outputs:?}");
        for output in outputs.iter().filter(|output| !output.status.success()) {
            let reported = text(output);
            assert!(
                output.status.code() == Some(2)
                    && reported.contains("another run is writing it: see --output"),
                "{reported}"
            );
            refusals += 1;
        }
        // What stands there is one of the good ones, whole.
        let found = fs::read(&table).unwrap();
        assert!(good.iter().any(|index| found == alone[*index]), "{good:?}");
        assert!(!at(&format!("pair-{pair}.csv.part")).exists());
    }
    assert!(refusals > 0, "no two runs of a pair were at work together");
}

#[cfg(target_os = "linux")]
#[test]
fn the_systems_name_of_the_standard_output_is_a_dash() {
    let Some((_scratch, fmu)) = packed("Empty") else { return };
    let dash = heliotorque(&["run", shown(&fmu), "--quiet", "--output", "-"]).output().unwrap();
    for name in ["/dev/stdout", "/proc/self/fd/1", "/dev/fd/1"] {
        let output = heliotorque(&["run", shown(&fmu), "--quiet", "--output", name]).output().unwrap();
        assert!(output.status.success() && output.stdout == dash.stdout, "{name}: {output:?}");
    }
    assert!(
        run(&["run", shown(&fmu), "--output", "/dev/full"], 2)
            .contains("or - for CSV on the standard output")
    );
}

#[test]
fn a_command_that_is_refused_leaves_no_folder() {
    let scratch = tempfile::tempdir().unwrap();
    let at = |name: &str| scratch.path().join(name);
    std::fs::write(at("bad.toml"), "nothing = 1\n").unwrap();
    let (bad, out) = (at("bad.toml"), at("deep/out"));
    for command in ["size", "plan"] {
        crate::run(&[command, shown(&bad), "--output", shown(&out)], 2);
        assert!(!at("deep").exists(), "{command:?}");
    }
}

#[test]
fn spans_beyond_memory_are_refused_by_name() {
    let refused = crate::run(&["ephemeris", "--start", "2011-04-06 UTC", "--stop", "3011-04-06 UTC"], 2);
    says(&refused, &["--stop: found \"3011-04-06 UTC\", 1000 years after --start, allowed: up to 100"]);
}

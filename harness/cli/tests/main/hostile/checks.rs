//! `check` outlives every FMU; signals and daemons leave nothing.

use super::*;

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
        let printed = ended(&scratch, "check", &["--probe", "simulation", "--timeout", "1s"], 1);
        assert!(printed.contains(expected), "{behaviour}: {printed}");
        // What it printed last is quoted, and nothing it printed is a verdict.
        let is_verdict = |line: &str| line.contains("everything is fine") && !line.contains("| ");
        assert!(!printed.lines().any(is_verdict) && printed.contains("1 failed"), "{behaviour}: {printed}");
    }
}

#[test]
fn a_check_takes_no_verdict_from_a_fork_and_waits_for_none() {
    for behaviour in ["FORKS", "RETURNS_TWICE"] {
        let Some(scratch) = hostile(behaviour, "IN_INSTANTIATE") else { return };
        let printed =
            ended(&scratch, "check", &["--probe", "simulation", "--timeout", "20s", "--verbose"], 0);
        assert_eq!(printed.matches("comes to its end").count().max(1), 1, "{printed}");
        assert!(!printed.contains("hangs") && !printed.contains("failed  "), "{printed}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_check_of_an_fmu_that_prints_without_end_stays_small() {
    let Some(scratch) = hostile("PRINTS", "IN_INSTANTIATE") else { return };
    let mut child = start(command(&scratch, "check", &["--probe", "simulation"]));
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
                if name == "run" { &["--output", shown(&table)] } else { &["--probe", "simulation"] };
            let child = start(command(&scratch, name, more));
            // Parent and child; the run has sent its rows.
            until(|| {
                let hangs = name == "check" || rows(&scratch.path().join("a.csv.part")).len() == 4;
                hangs && processes(scratch.path()).len() == 2
            });
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
                says(&printed, &["interrupted at 3 s", "fmi2DoStep("]);
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
    let printed = ended(&scratch, "check", &["--probe", "simulation", "--timeout", "20s"], 0);
    assert!(printed.contains(&format!("warning {LEFT}")), "{printed}");

    let Some(scratch) = hostile("DETACHES", "AT_LOADING") else { return };
    let fmu = scratch.path().join("fmu");
    let pack = program(&scratch, &["pack", "--template", shown(&fmu)]);
    let printed = text(&start_to_file(&scratch, pack));
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
        until(|| processes(scratch.path()).len() >= 3);
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
    let mut child = start(command(&scratch, "check", &["--probe", "simulation"]));
    until(|| processes(scratch.path()).len() >= 2);
    // One that runs keeps its own.
    let _ = text(&wait(start(command(&scratch, "check", &["--probe", "simulation", "--timeout", "0.2s"]))));
    assert_eq!(temporaries(), 1);
    child.kill().unwrap();
    child.wait().unwrap();
    assert_eq!(temporaries(), 1);
    ended(&scratch, "check", &["--probe", "simulation", "--timeout", "0.2s"], 1);
}

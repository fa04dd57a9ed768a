//! `run` names the failed call and keeps the rows.

use super::*;

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
        let printed = ended(&scratch, "run", &[&["--output", shown(&table)], more].concat(), 2);
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
    let printed = ended(&scratch, "run", &["--output", shown(&table)], 2);
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
        let printed = ended(&scratch, "run", &["--output", shown(&table)], 2);
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
    let mut child = start(command(&scratch, "run", &[&endless[..], &["--output", shown(&picture)]].concat()));
    drop(child.stdout.take());
    let output = wait(child);
    assert!(
        text(&output).contains("nobody reads the standard output any more: the run ends at"),
        "{output:?}"
    );
    assert!(output.status.code() == Some(2) && !picture.exists());
}

#[cfg(target_os = "linux")]
#[test]
fn a_run_that_is_killed_leaves_whole_rows_and_no_process() {
    let Some(scratch) = hostile("SLEEPS", "IN_STEP") else { return };
    let (table, part) = (scratch.path().join("a.csv"), scratch.path().join("a.csv.part"));
    fs::write(&table, "the last good one").unwrap();
    let mut child = start(command(&scratch, "run", &["--output", shown(&table)]));
    until(|| rows(&part).len() >= 4);
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
    let printed = ended(&scratch, "run", &["--log"], 2);
    says(&printed, &["\\u{1b}[2Jcleared\\u{7}", "\\u{1b}]0;title\\u{7} a\\rb"]);
    assert!(!printed.contains(is_control), "{printed:?}");
    // Names and texts of the description too.
    let xml = DESCRIPTION.replace("guid=", "description=\"&#x9b;2J &#x85;\" guid=");
    fs::write(scratch.path().join("fmu/modelDescription.xml"), xml).unwrap();
    let printed = ended(&scratch, "info", &[], 0);
    assert!(printed.contains("\\u{9b}2J") && !printed.contains(is_control), "{printed:?}");
}

/// Both components are the same FMU; the first one is stepped first.
const SYSTEM: &str = r#"<ssd:SystemStructureDescription name="Pair" version="1.0"><ssd:System name="Pair"><ssd:Elements>
<ssd:Component name="one" source="resources/hostile.fmu"/><ssd:Component name="two" source="resources/hostile.fmu"/>
</ssd:Elements></ssd:System></ssd:SystemStructureDescription>"#;

#[test]
fn a_component_that_crashes_or_hangs_is_named_with_its_call_and_the_rows_stay() {
    for (behaviour, more, found) in [
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
        let printed = ended(&scratch, "run", &[&["--output", shown(&csv)], more].concat(), 2);
        let call = "Pair, component one: fmi2DoStep(currentCommunicationPoint=3";
        assert!(printed.contains(call) && printed.contains(found), "{printed}");
        let rows = fs::read_to_string(scratch.path().join("rows.csv.part")).unwrap();
        assert_eq!(rows, "time,one.x,two.x\n0,0,0\n1,1,1\n2,2,2\n3,3,3\n");
    }
}

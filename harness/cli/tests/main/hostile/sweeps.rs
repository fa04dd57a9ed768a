//! Sweeps over FMUs that crash, hang or do not reset: the run is a failed row with its call, the others are as ever.

use std::{fs, path::Path};

use tempfile::TempDir;

use super::{DESCRIPTION, hostile, program, wait};
use crate::{shown, text};

const PARAMETER: &str = r#"<ScalarVariable name="trouble" valueReference="1" causality="parameter" variability="fixed"><Real start="0"/></ScalarVariable>
  </ModelVariables>"#;

/// A campaign of six runs, of which two have trouble.
fn campaign(folder: &Path) {
    let description = DESCRIPTION.replace("</ModelVariables>", PARAMETER);
    fs::write(folder.join("fmu/modelDescription.xml"), description).unwrap();
    let text = "fmu = \"fmu\"\nsampling = \"grid\"\n[vary]\ntrouble = { values = [0, 1, 0, 0, 1, 0] }\n[keep]\nfinal = [\"x\"]\n";
    fs::write(folder.join("campaign.toml"), text).unwrap();
}

#[test]
fn a_run_that_crashes_or_hangs_is_a_failed_row() {
    for (behaviour, reason) in [
        ("CRASHES", ": the process ended: signal 11"),
        ("SLEEPS", ": hangs: the call did not return within 0.5 s"),
        ("FAILS", "fmi2DoStep"),
    ] {
        let Some(scratch) = hostile(behaviour, "IN_STEP_IF") else { return };
        campaign(scratch.path());
        let (file, runs) = (scratch.path().join("campaign.toml"), scratch.path().join("runs.csv"));
        let arguments =
            ["sweep", shown(&file), "--output", shown(&runs), "--workers", "2", "--timeout", "500ms"];
        let mut command = program(&scratch, &arguments);
        let output = wait(
            command
                .stdout(std::process::Stdio::piped())
                .stderr(std::process::Stdio::piped())
                .spawn()
                .unwrap(),
        );
        assert_eq!(output.status.code(), Some(1), "{behaviour}: {}", text(&output));
        assert!(text(&output).contains("4 ok, 2 failed"), "{behaviour}: {}", text(&output));
        let table = fs::read_to_string(&runs).unwrap();
        let rows: Vec<&str> = table.lines().collect();
        assert_eq!(rows[0], "run,trouble,x.final,status,reason");
        for run in [0, 2, 3, 5] {
            assert_eq!(rows[run + 1], format!("{run},0,10,ok,"), "{behaviour}");
        }
        for run in [1, 4] {
            let row = rows[run + 1];
            assert!(
                row.starts_with(&format!("{run},1,,failed,"))
                    && row.contains("fmi2DoStep(currentCommunicationPoint=3")
                    && row.contains(reason),
                "{behaviour}: {row}"
            );
        }
    }
}

#[test]
fn an_fmu_that_does_not_reset_gets_an_instance_a_run() {
    let Some(scratch) = hostile("0", "KEEPS") else { return };
    campaign(scratch.path());
    let (file, runs) = (scratch.path().join("campaign.toml"), scratch.path().join("runs.csv"));
    let arguments = ["sweep", shown(&file), "--output", shown(&runs), "--workers", "1", "--quiet"];
    let output = program(&scratch, &arguments).output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", text(&output));
    let table = fs::read_to_string(&runs).unwrap();
    // x counts the steps of an instance.
    assert!(table.lines().skip(1).all(|row| row.ends_with(",10,ok,")), "{table}");
}

/// The campaign of an FMU, with one process; its table and what is said, once it ended with this status.
fn swept(scratch: &TempDir, more: &[&str], dies: bool, status: i32) -> (String, String) {
    let (file, runs) = (scratch.path().join("campaign.toml"), scratch.path().join("runs.csv"));
    let arguments = ["sweep", shown(&file), "--output", shown(&runs), "--workers", "1"];
    let mut command = program(scratch, &[&arguments[..], more].concat());
    if dies {
        command.env("HOSTILE_DIES", "1");
    }
    let output = command.output().unwrap();
    assert_eq!(output.status.code(), Some(status), "{}", text(&output));
    (fs::read_to_string(&runs).unwrap_or_default(), text(&output))
}

/// Rows of runs that are as they should be.
const UNDISTURBED: &str = "run,trouble,x.final,status,reason\n0,0,10,ok,\n1,1,10,ok,\n2,0,10,ok,\n3,0,10,ok,\n4,1,10,ok,\n5,0,10,ok,\n";

#[test]
fn a_reset_that_fails_is_no_fault_of_the_next_run() {
    for behaviour in ["FAILS", "CRASHES"] {
        let Some(scratch) = hostile(behaviour, "IN_RESET_IF") else { return };
        campaign(scratch.path());
        assert_eq!(swept(&scratch, &[], false, 0).0, UNDISTURBED, "{behaviour}");
    }
}

#[test]
fn what_an_fmu_keeps_over_a_reset_is_warned_of() {
    let Some(scratch) = hostile("0", "CARRIES") else { return };
    campaign(scratch.path());
    let (table, said) = swept(&scratch, &["--quiet"], false, 0);
    assert!(table.contains("\n1,1,10,ok,\n2,0,11,ok,\n"), "{table}");
    assert!(said.contains("run 5: x.final is 11, and 10 in a process of its own"), "{said}");
    assert!(said.contains("found in 1 of 1 runs repeated"), "{said}");
}

#[test]
fn a_run_whose_process_was_killed_is_simulated_again() {
    let Some(scratch) = hostile("DIES", "IN_STEP_IF") else { return };
    campaign(scratch.path());
    let (table, said) = swept(&scratch, &[], true, 2);
    assert!(
        table.is_empty() && said.contains("runs.csv.part: run 1: its process was killed"),
        "{table}{said}"
    );
    assert!(said.contains("--resume simulates it again"), "{said}");
    let (table, said) = swept(&scratch, &["--resume"], false, 0);
    assert_eq!(table, UNDISTURBED);
    assert!(said.contains("6 ok") && said.contains("2 runs in"), "{said}");
    // A run that is killed each time fails.
    swept(&scratch, &["--fresh"], true, 2);
    let (table, said) = swept(&scratch, &["--resume"], true, 1);
    assert_eq!(table.matches(",failed,").count(), 2, "{table}");
    assert!(table.contains("signal 9 (killed)") && said.contains("4 ok, 2 failed"), "{table}{said}");
}

#[test]
fn a_library_that_cannot_be_loaded_ends_the_campaign() {
    let Some(scratch) = hostile("0", "UNDEFINED") else { return };
    campaign(scratch.path());
    let (table, said) = swept(&scratch, &[], false, 2);
    assert!(table.is_empty() && said.contains("defined_nowhere"), "{table}{said}");
}

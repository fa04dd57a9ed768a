//! Sweeps over FMUs that crash, hang or do not reset: the run is a failed row with its call, the others are as ever.

use std::{fs, path::Path};

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

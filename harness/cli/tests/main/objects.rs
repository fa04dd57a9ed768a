//! `--json` prints one object with the numbers of the tables; `--log-calls` has every call; examples of the help
//! name options that there are.

use std::fs;

use serde_json::Value;

use crate::{heliotorque, packed, run, says, shown, template, text};

/// Standard output of a command, as JSON.
fn object(arguments: &[&str], status: i32) -> Value {
    let output = heliotorque(arguments).output().unwrap();
    assert_eq!(output.status.code(), Some(status), "{arguments:?}: {}", text(&output));
    serde_json::from_slice(&output.stdout).unwrap()
}

#[test]
fn info_and_check_are_one_object() {
    let Some((scratch, fmu)) = packed("AllTypes") else { return };
    let found = object(&["info", shown(&fmu), "--json", "--only", "input.choice,input.real"], 0);
    assert_eq!(found["name"], "AllTypes");
    let names: Vec<&str> =
        found["variables"].as_array().unwrap().iter().map(|it| it["name"].as_str().unwrap()).collect();
    assert_eq!(names, ["input.choice", "input.real"]);
    let option = found["variables"][0]["option"].as_str().unwrap();
    assert!(found["options"][option].as_array().unwrap().len() > 1, "{found}");
    let found = object(&["check", shown(&fmu), "--static", "--json"], 0);
    let count = |key: &str| found[key].as_u64().unwrap();
    let all: u64 = ["passed", "skipped", "warnings", "failed"].map(count).iter().sum();
    assert_eq!((found["findings"].as_array().unwrap().len() as u64, count("failed")), (all, 0));
    let Some((_room, template)) = template() else { return };
    let craft = scratch.path().join("craft.toml");
    run(&["new", "spacecraft", shown(&craft)], 0);
    let check = ["check", shown(&craft), "--template", shown(&template), "--json"];
    assert_eq!(object(&check, 0)["findings"][0]["verdict"], "passed");
    let broken = fs::read_to_string(&craft).unwrap().replace("mass_kg = 400.0", "mass_kg = -4.0");
    fs::write(&craft, broken).unwrap();
    let found = object(&check, 1);
    assert!(
        found["failed"] == 1 && found["findings"][0]["text"].as_str().unwrap().contains("mass_kg"),
        "{found}"
    );
}

#[test]
fn a_comparison_is_one_object() {
    let scratch = tempfile::tempdir().unwrap();
    let [one, other] = ["a.csv", "b.csv"].map(|name| scratch.path().join(name));
    fs::write(&one, "time,x,y\n0,1,0\n1,2,5\n").unwrap();
    fs::write(&other, "time,x,z\n0,1,0\n1,3,0\n2,0,0\n").unwrap();
    let found = object(&["compare", shown(&one), shown(&other), "--json"], 1);
    assert_eq!((&found["rows"], &found["variables"], &found["beyond"]), (&2.into(), &1.into(), &1.into()));
    let difference = &found["differences"][0];
    assert_eq!(
        (&difference["name"], &difference["fraction"], &difference["at"]),
        (&"x".into(), &0.5.into(), &1.0.into())
    );
    assert_eq!(found["onlyFirst"]["columns"], serde_json::json!(["y"]));
    assert_eq!(found["onlySecond"], serde_json::json!({ "rows": [2.0], "columns": ["z"] }));
}

#[test]
fn a_sizing_is_one_object() {
    let Some((scratch, template)) = template() else { return };
    let craft = scratch.path().join("craft.toml");
    run(&["new", "spacecraft", shown(&craft)], 0);
    let folder = scratch.path().join("out");
    let size = ["size", shown(&craft), "--template", shown(&template), "--duration", "2d", "--budget", "0s"];
    let found = object(
        &[&size[..], &["--output", shown(&folder), "--json", "--slew", "90 deg in 10 min"]].concat(),
        0,
    );
    assert_eq!(found["flight_s"], 172_800.0);
    let own = found["unloadings"].as_array().unwrap().last().unwrap();
    assert!(
        own["every_s"] == 86_400.0 && own["wheels"][0]["capacity_N_m_s"].as_f64().unwrap() > 0.0,
        "{own}"
    );
    // From rest to rest over an angle a in a time t: peak momentum is twice I a / t.
    let slew = &found["slews"][2];
    let expected_n_m_s = 180.0 * 2.0 * 90_f64.to_radians() / 600.0;
    assert!((slew["momentum_N_m_s"].as_f64().unwrap() / expected_n_m_s - 1.0).abs() < 1e-9, "{slew}");
}

#[test]
fn the_log_has_every_call_with_its_status() {
    let Some((scratch, fmu)) = packed("AllTypes") else { return };
    let log = scratch.path().join("calls.txt");
    let times = ["--start", "0", "--stop", "2", "--step", "1", "--quiet", "--tolerance", "1e-8"];
    run(&[&["run", shown(&fmu), "--log-calls", shown(&log)], &times[..]].concat(), 0);
    let calls = fs::read_to_string(&log).unwrap();
    let steps: Vec<&str> = calls.lines().filter(|line| line.starts_with("fmi2DoStep")).collect();
    assert_eq!(
        steps,
        [
            "fmi2DoStep(currentCommunicationPoint=0, communicationStepSize=1) fmi2OK",
            "fmi2DoStep(currentCommunicationPoint=1, communicationStepSize=1) fmi2OK"
        ]
    );
    says(&calls, &["fmi2Instantiate\n", "fmi2SetupExperiment fmi2OK\n", "fmi2Terminate fmi2OK\n"]);
    assert_eq!(calls.lines().last(), Some("fmi2FreeInstance"));
}

#[test]
fn examples_of_the_help_name_commands_and_options_that_there_are() {
    let commands =
        ["info", "check", "run", "wire", "sweep", "compare", "plot", "new", "draw", "map", "size", "pack"];
    let mut examples = 0;
    for command in commands.into_iter().chain(["ephemeris", "plan", "refit", "completions"]) {
        let help = run(&[command, "--help"], 0);
        for line in help.lines().filter_map(|line| line.trim().strip_prefix("heliotorque ")) {
            let words: Vec<&str> = line.split(" && ").next().unwrap().split_whitespace().collect();
            let of = if words.starts_with(&["plan", "spin"]) { vec!["plan", "spin"] } else { vec![words[0]] };
            let text = run(&[&of[..], &["--help"]].concat(), 0);
            for option in words.iter().filter(|word| word.starts_with("--")) {
                assert!(text.contains(*option), "{command}: {line}: {option}");
            }
            examples += 1;
        }
    }
    assert!(examples > 30, "{examples}");
}

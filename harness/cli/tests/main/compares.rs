//! `compare`: differences against what was calculated by hand, and what only one table has.

use std::{fs, path::Path};

use crate::{heliotorque, run, says, shown, template, text};

const FIRST: &str = "time,h[1],h[2],mode,lone\n0,0,8,nadir,1\n60,1,-10,nadir,1\n120,4,0,safe,1\n";
/// h[1] is off by 0.5 where h reaches 10.
const SECOND: &str =
    "time,h[1],h[2],mode,other\n0,0,8,nadir,1\n60,1.5,-10.0,nadir,1\n90,7,7,burn,1\n120,4,0,safe,1\n";

fn files(first: &str, second: &str) -> tempfile::TempDir {
    let scratch = tempfile::tempdir().unwrap();
    fs::write(scratch.path().join("a.csv"), first).unwrap();
    fs::write(scratch.path().join("b.csv"), second).unwrap();
    scratch
}

fn compared(folder: &Path, more: &[&str], status: i32) -> (String, String) {
    let output =
        heliotorque(&[&["compare", "a.csv", "b.csv"], more].concat()).current_dir(folder).output().unwrap();
    assert_eq!(output.status.code(), Some(status), "{}", text(&output));
    let stream = |bytes: &[u8]| String::from_utf8(bytes.to_vec()).unwrap();
    (stream(&output.stdout), stream(&output.stderr))
}

#[test]
fn a_difference_is_a_fraction_of_its_vectors_largest_magnitude() {
    let scratch = files(FIRST, SECOND);
    let (printed, _) = compared(scratch.path(), &[], 1);
    says(
        &printed,
        &[
            "a.csv and b.csv: 3 times and 3 variables in common",
            "only a.csv has lone",
            "only b.csv has time 90 s",
            "only b.csv has other",
            "1 of 3 beyond 1e-9 of the largest magnitude of its vector; 2 without any difference",
        ],
    );
    let row: Vec<&str> = printed
        .lines()
        .find(|line| line.trim_start().starts_with("h[1]"))
        .unwrap()
        .split_whitespace()
        .collect();
    assert_eq!(row, ["h[1]", "5.000e-1", "5.000e-2", "60", "1", "1.5"]);
    // The tolerance itself is within.
    for (tolerance, status) in [("0.0499", 1), ("0.05", 0), ("0", 1), ("1", 0)] {
        let (printed, _) = compared(scratch.path(), &["--tolerance", tolerance], status);
        assert!(printed.contains(if status == 0 { "none beyond" } else { "1 of 3 beyond" }), "{printed}");
    }
    for bad in ["-1", "nan", "1e-9 m"] {
        let (_, printed) = compared(scratch.path(), &["--tolerance", bad], 2);
        says(&printed, &["--tolerance", "allowed is a number from 0 up"]);
    }
}

#[test]
fn the_same_table_differs_by_nothing() {
    let scratch = files(FIRST, &FIRST.replace("60,1,-10,nadir", "6e1,1.000,-1e1,nadir"));
    let (printed, _) = compared(scratch.path(), &["--tolerance", "0"], 0);
    assert_eq!(printed, "a.csv and b.csv: 3 times and 4 variables in common\nno difference\n");
}

#[test]
fn runs_of_a_campaign_are_compared_by_their_number() {
    let runs = "run,x,h[1].final,h[2].final,status,reason\n0,1,3,4,ok,\n1,2,,,failed,\"fmi2DoStep, hung\"\n2,3,-8,0,limit,h\n";
    let scratch = files(runs, runs);
    fs::write(scratch.path().join("a.csv.toml"), "[units]\n\"h[1].final\" = \"N.m.s\"\n").unwrap();
    assert!(compared(scratch.path(), &[], 0).0.contains("3 rows and 5 variables in common\nno difference"));
    fs::write(
        scratch.path().join("b.csv"),
        runs.replace("-8,0,limit", "-8,2,ok").replace("1,2,,,failed", "1,2,0,0,ok"),
    )
    .unwrap();
    let (printed, _) = compared(scratch.path(), &[], 1);
    let row = |name: &str| -> Vec<String> {
        let line = printed.lines().find(|line| line.trim_start().starts_with(name)).unwrap();
        line.split_whitespace().map(str::to_owned).collect()
    };
    // A run that failed has no number, whatever the other one has.
    assert_eq!(row("h[1].final")[1..5], ["N.m.s", "infinite", "infinite", "1"]);
    assert_eq!(row("status")[1..], ["infinite", "infinite", "1", "failed", "ok"]);
    says(&printed, &["at run", "3 of 5 beyond 1e-9"]);
}

#[test]
fn the_picture_shows_what_differs() {
    let scratch = files(FIRST, SECOND);
    let origin = "start_s = 0\n[[fmus]]\nname = \"Plant\"\n[columns]\n\"h[1]\" = { unit = \"N.m.s\", display = { unit = \"mN.m.s\", factor = 1000.0 } }\n";
    fs::write(scratch.path().join("a.csv.toml"), origin).unwrap();
    compared(scratch.path(), &["--output", "d.svg"], 1);
    let svg = fs::read_to_string(scratch.path().join("d.svg")).unwrap();
    says(&svg, &["b.csv less a.csv", "h [mN.m.s]", ">h[1]<", "time [s]", ">500<"]);
    assert!(!svg.contains("h[2]"), "{svg}");
    let (picture, printed) = compared(scratch.path(), &["--output", "-"], 1);
    assert_eq!(picture, svg);
    says(&printed, &["1 of 3 beyond"]);
    let (_, printed) = compared(scratch.path(), &["--output", "d.png"], 2);
    says(&printed, &["d.png: found another ending, allowed: .svg, or - for SVG", "--output"]);
    let (_, printed) = compared(scratch.path(), &["--output", "b.csv.svg/d.svg"], 2);
    says(&printed, &["there is no folder", "--output"]);
}

#[test]
fn two_runs_of_one_mission_differ_by_nothing() {
    let Some((scratch, fmu)) = template() else { return };
    let [first, second] = ["hourly.csv", "coarse.csv"].map(|name| scratch.path().join(name));
    for (output, step) in [(&first, "1h"), (&second, "2h")] {
        let flight =
            ["run", shown(&fmu), "--stop", "12h", "--step", step, "--output", shown(output), "--quiet"];
        run(&[&flight[..], &["--record", "momentum.body,torque.solar,dump.count"]].concat(), 0);
    }
    let printed = run(&["compare", shown(&first), shown(&first), "--tolerance", "0"], 0);
    says(&printed, &["13 times and 7 variables in common", "no difference"]);
    // The plant's results are independent of the master's steps.
    let printed = run(&["compare", shown(&first), shown(&second), "--tolerance", "0"], 0);
    says(
        &printed,
        &[
            "7 times and 7 variables in common",
            "has time 3600, 10800, 18000, 25200, ... 39600 s (6)",
            "no difference",
        ],
    );
}

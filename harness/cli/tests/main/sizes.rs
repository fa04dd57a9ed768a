//! `size`: momentum by source as a flight of the same FMU gives it, dumps that fall with capacity, wheels by hand, refusals.

use std::fs;

use crate::{built, heliotorque, is_long, run, says, shown, template, text};

const MESSENGER_FULL: &str = "../../fmu-src/resources/messenger-full.toml";

/// Rows of a CSV by column.
fn table(path: &std::path::Path) -> Vec<Vec<String>> {
    let text = fs::read_to_string(path).unwrap();
    text.lines().skip(1).map(|line| line.split(',').map(str::to_owned).collect()).collect()
}

#[test]
fn a_spacecraft_is_sized_by_flights_of_its_fmu() {
    let Some(dist) = built("HELIOTORQUE_DIST") else { return };
    let template = dist.join("MomentumPlant.fmu");
    let scratch = tempfile::tempdir().unwrap();
    let folder = scratch.path().join("sizing");
    let days = if is_long() { 90 } else { 30 };
    let duration = format!("{days}d");
    let shown_template = shown(&template);
    let arguments = [
        "size",
        MESSENGER_FULL,
        "--template",
        shown_template,
        "--duration",
        &duration,
        "--output",
        shown(&folder),
    ];
    let text = run(&[&arguments[..], &["--budget", "0s"]].concat(), 0);
    says(&text, &["dumpsOnly", "predictive", "18 more flights were left out", "unloaded every", "+X", "-Z"]);
    let rows = table(&folder.join("messenger-full-size.csv"));
    assert_eq!(rows.len(), 9, "each strategy at three thresholds: {rows:?}");
    let rows: Vec<_> = rows.into_iter().filter(|row| row[1] == "5.5").collect();
    assert!(fs::read_to_string(folder.join("messenger-full-size.svg")).unwrap().starts_with("<svg"));

    // The same flight by `run`: dumps and propellant are those of these days, scaled to a year.
    let fmu = scratch.path().join("full.fmu");
    run(&["pack", "--spacecraft", MESSENGER_FULL, "--template", shown_template, "--output", shown(&fmu)], 0);
    let output = scratch.path().join("run.csv");
    run(
        &[
            "run",
            shown(&fmu),
            "--stop",
            &duration,
            "--record",
            "dump.count,propellant.used",
            "--output",
            shown(&output),
        ],
        0,
    );
    let simulated = table(&output);
    let last: Vec<f64> = simulated.last().unwrap().iter().map(|cell| cell.parse().unwrap()).collect();
    let own: Vec<f64> = rows[0][5..].iter().map(|cell| cell.parse().unwrap()).collect();
    assert!(last[1] > 0.0, "a dump is among them");
    assert!((own[0] - last[1] * 365.25 / f64::from(days)).abs() < 1e-9, "{own:?}, {last:?}");
    assert!(
        (own[2] - last[2] * 365.25 / f64::from(days)).abs() < 1e-9 * own[2].max(1.0),
        "{own:?}, {last:?}"
    );
    // The file's wheels hold 6.158 N m s of 8 by least-norm sharing.
    let capacity: f64 = rows[0][4].parse().unwrap();
    assert!(
        (capacity - rows[0][1].parse::<f64>().unwrap() * 0.75 * 3.0_f64.sqrt()).abs() < 1e-4,
        "{capacity}"
    );
}

#[test]
fn more_capacity_takes_fewer_dumps_and_more_margin_larger_wheels() {
    let Some(dist) = built("HELIOTORQUE_DIST") else { return };
    let template = dist.join("MomentumPlant.fmu");
    let scratch = tempfile::tempdir().unwrap();
    let sized = |margin: &str| {
        let folder = scratch.path().join(margin);
        let text = run(
            &[
                "size",
                "../../docs/src/tutorial/venus.toml",
                "--template",
                shown(&template),
                "--duration",
                if is_long() { "60d" } else { "30d" },
                "--margin",
                margin,
                "--output",
                shown(&folder),
                "--set",
                "guided.scienceRule=scaled",
            ],
            0,
        );
        (text, table(&folder.join("venus-size.csv")))
    };
    let (small, rows) = sized("0");
    let of_dumps_only: Vec<(f64, f64)> = rows
        .iter()
        .filter(|row| row[0] == "dumpsOnly")
        .map(|row| (row[1].parse().unwrap(), row[5].parse().unwrap()))
        .collect();
    assert!(
        of_dumps_only.windows(2).all(|pair| pair[0].0 < pair[1].0 && pair[0].1 >= pair[1].1),
        "{of_dumps_only:?}"
    );
    let capacity = |text: &str| -> f64 {
        let line = text.lines().find(|line| line.contains("three along X, Y, Z")).unwrap();
        line.split_whitespace().nth(5).unwrap().parse().unwrap()
    };
    let (large, _) = sized("0.5");
    assert!((capacity(&large) / capacity(&small) - 1.5).abs() < 1e-3, "{small}\n{large}");
}

#[test]
fn what_cannot_be_sized_is_refused_by_name() {
    let Some(dist) = built("HELIOTORQUE_DIST") else { return };
    let template = dist.join("MomentumPlant.fmu");
    let scratch = tempfile::tempdir().unwrap();
    let refused = |file: &str, more: &[&str], part: &str| {
        let arguments =
            [&["size", file, "--template", shown(&template), "--output", shown(scratch.path())], more]
                .concat();
        let output = heliotorque(&arguments).output().unwrap();
        let text = text(&output);
        assert!(!output.status.success() && text.contains(part), "{text}");
    };
    refused(
        MESSENGER_FULL,
        &["--set", "attitude.source=controlled"],
        "attitude.source: found controlled, allowed: guided",
    );
    refused(MESSENGER_FULL, &["--margin", "-1"], "allowed is a share from 0 to 10");
    refused("../../fmu-src/resources/examples/timeline.toml", &[], "found a timeline, allowed: a spacecraft");
}

/// In downlink throughout no strategy chooses the Sun's place; the flight is as long as the mission, here the first 50 days.
#[test]
fn a_mission_in_cruise_is_sized_by_its_timeline() {
    let Some((scratch, template)) = template() else { return };
    let missions = std::path::Path::new("../../fmu-src/resources/examples/missions");
    let timeline = "messenger-cruise-timeline.toml";
    fs::copy(missions.join(timeline), scratch.path().join(timeline)).unwrap();
    fs::copy("../../fmu-src/resources/messenger.toml", scratch.path().join("messenger.toml")).unwrap();
    let text = fs::read_to_string(missions.join("messenger-cruise.toml")).unwrap();
    let short =
        text.replace("../../messenger.toml", "messenger.toml").replace("stop = \"200 d\"", "stop = \"50 d\"");
    let mission = scratch.path().join("messenger-cruise.toml");
    fs::write(&mission, short).unwrap();
    let arguments =
        ["size", shown(&mission), "--template", shown(&template), "--output", shown(scratch.path())];
    let text = run(&[&arguments[..], &["--budget", "0s"]].concat(), 0);
    says(&text, &["momentum without dumps, 50 d of flight"]);
    let rows = table(&scratch.path().join("messenger-cruise-size.csv"));
    let strategies: Vec<&str> = rows.iter().map(|row| row[0].as_str()).collect();
    // At each of the three thresholds that are simulated whatever the budget.
    assert_eq!(strategies, ["dumpsOnly"; 3]);
}

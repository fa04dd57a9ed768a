//! Missions: what they name is simulated, drawn, judged and packed; options win; the examples are simulated.

use std::{fs, path::Path};

use crate::{heliotorque, run, says, shown, template, text, words};

const RESOURCES: &str = "../../fmu-src/resources";

/// What a command says in the folder, where it ends with this status.
#[track_caller]
fn printed(folder: &Path, arguments: &[&str], status: i32) -> String {
    let output = heliotorque(arguments).current_dir(folder).output().unwrap();
    assert_eq!(output.status.code(), Some(status), "{arguments:?}: {}", text(&output));
    text(&output)
}

/// The rows of a CSV file.
fn rows(path: &Path) -> Vec<Vec<f64>> {
    let table = fs::read_to_string(path).unwrap();
    table.lines().skip(1).map(|line| line.split(',').map(|cell| cell.parse().unwrap()).collect()).collect()
}

const MISSION: &str = r#"
model = "MomentumPlant"
start = "2011-04-06 UTC"
stop = "2011-04-06T02:00:00 UTC"
step = "60 s"
every = "30 min"
record = ["epoch", "panel[1].sunOffset", "momentum.body[1]"]
output = "out.csv"
[[plot]]
file = "momentum.svg"
names = ["momentum.body[1]", "sun.elevation"]
[set]
"momentum.convention" = "inertial"
"dump.threshold" = [4, 4, 4]
[inputs]
"panel[1].sunOffset" = [[0, "60 deg"], ["1 h", "65 deg"]]
[limits]
"sun.elevation" = { min = "-20 deg", max = "20 deg" }
"#;

#[test]
fn a_mission_is_simulated_as_it_is_written_and_options_win() {
    let Some((scratch, _)) = template() else { return };
    let folder = scratch.path();
    fs::create_dir(folder.join("deep")).unwrap();
    fs::write(folder.join("deep/m.toml"), MISSION).unwrap();
    let simulate = |more: &[&str], status: i32| {
        printed(folder, &[&["run", "deep/m.toml", "--template", "template.fmu"], more].concat(), status)
    };
    let reported = simulate(&[], 0);
    says(&reported, &["120 steps to 7200 s", "kept: sun.elevation from -20 to 20 deg"]);
    // Beside the mission, not where it was started.
    assert!(folder.join("deep/momentum.svg").exists() && !folder.join("out.csv").exists());
    let header = fs::read_to_string(folder.join("deep/out.csv")).unwrap();
    // What is drawn or judged is recorded too.
    let names = "time,epoch,panel[1].sunOffset,momentum.body[1],sun.elevation\n";
    assert!(header.starts_with(names), "{header}");
    let found = rows(&folder.join("deep/out.csv"));
    let times: Vec<f64> = found.iter().map(|row| row[0]).collect();
    assert_eq!(times, [0.0, 1800.0, 3600.0, 5400.0, 7200.0]);
    // 2011-04-06 00:00 UTC is 66.184 s later in TDB: 34 leap seconds and 32.184 s, but for TDB - TT.
    let noon_2000_to_2011_s = 4112.5 * 86_400.0;
    assert!((found[0][1] - noon_2000_to_2011_s - 66.184).abs() < 2e-3, "{}", found[0][1]);
    let offsets: Vec<f64> = found.iter().map(|row| row[2].to_degrees().round()).collect();
    // A row shows what the step before it read.
    assert_eq!(offsets, [60.0, 60.0, 60.0, 65.0, 65.0], "a tunable parameter is held");

    let csv = folder.join("mine.csv");
    let reported = simulate(
        &words(
            "--stop 1h --every 60s --record times*,dump.threshold --output mine.csv --set dump.threshold[2]=3",
        ),
        2,
    );
    assert!(reported.contains("times*"), "{reported}");
    let more = ["--stop", "1h", "--every", "60s", "--record", "dump.threshold", "--output", "mine.csv"];
    simulate(&[&more[..], &["--set", "dump.threshold[2]=3"]].concat(), 0);
    let mine = rows(&csv);
    assert_eq!((mine.len(), &mine[0][1..4]), (61, &[4.0, 3.0, 4.0][..]));
}

#[test]
fn a_limit_that_breaks_is_reported_with_its_time_and_ends_with_one() {
    let Some((scratch, _)) = template() else { return };
    let folder = scratch.path();
    let text = MISSION.replace(r#"min = "-20 deg", max = "20 deg""#, "min = \"100 rad\"");
    fs::write(folder.join("m.toml"), text).unwrap();
    let reported = printed(folder, &["run", "m.toml", "--template", "template.fmu", "--quiet"], 1);
    let expected = "m.toml:18: limits.\"sun.elevation\": found ";
    says(&reported, &[expected, "at 0 s (2011-04-06T00:00:00 UTC), the first time"]);
    assert!(folder.join("out.csv").exists(), "what was simulated is kept");
}

#[test]
fn a_packed_mission_starts_as_the_mission_does() {
    let Some((scratch, _)) = template() else { return };
    let folder = scratch.path();
    // Inputs over time are no start values.
    let text = MISSION.replace("\"60 deg\"], [\"1 h\", \"65 deg\"]", "\"65 deg\"]");
    fs::write(folder.join("m.toml"), &text).unwrap();
    let reported = printed(
        folder,
        &words("pack m.toml --template template.fmu --name Mine --set dump.threshold[3]=5"),
        0,
    );
    assert!(reported.contains("Mine.fmu: Mine, "), "{reported}");
    printed(folder, &["run", "m.toml", "--template", "template.fmu"], 0);
    let record = "epoch,panel[1].sunOffset,momentum.body[1],sun.elevation,dump.threshold[3]";
    let more = ["--every", "30min", "--record", record, "--output", "fmu.csv"];
    printed(folder, &[&["run", "Mine.fmu"], &more[..]].concat(), 0);
    let (of_mission, of_fmu) = (rows(&folder.join("out.csv")), rows(&folder.join("fmu.csv")));
    assert!(of_fmu.iter().all(|row| row[5] == 5.0));
    let same: Vec<Vec<f64>> = of_fmu.into_iter().map(|row| row[..5].to_vec()).collect();
    assert_eq!(of_mission, same);
    // It simulates an FMU too, and then packs nothing.
    let text = text.replace("model = \"MomentumPlant\"", "fmu = \"Mine.fmu\"");
    fs::write(folder.join("of-fmu.toml"), text).unwrap();
    printed(folder, &["run", "of-fmu.toml", "--output", "again.csv"], 0);
    assert_eq!(rows(&folder.join("again.csv")), of_mission);
    let reported = printed(folder, &["pack", "--mission", "of-fmu.toml", "--template", "template.fmu"], 2);
    assert!(reported.contains("which is packed already"), "{reported}");
}

#[test]
fn later_wins_file_mission_option() {
    let Some((scratch, _)) = template() else { return };
    let folder = scratch.path();
    // Its [start.MomentumPlant] has 4, 4, 4.
    fs::create_dir(folder.join("craft")).unwrap();
    printed(folder, &["new", "spacecraft", "craft/s.toml"], 0);
    let mission = "spacecraft = \"craft/s.toml\"\nstop = 60\nstep = 60\nrecord = [\"dump.threshold\"]\noutput = \"out.csv\"\n";
    fs::write(
        folder.join("m.toml"),
        format!("{mission}[set]\n\"dump.threshold[2]\" = 2\n\"dump.threshold[3]\" = 2\n"),
    )
    .unwrap();
    let options = ["--template", "template.fmu", "--set", "dump.threshold[3]=3"];
    printed(folder, &[&["run", "m.toml"], &options[..]].concat(), 0);
    let simulated = rows(&folder.join("out.csv"));
    assert_eq!(simulated[0][1..], [4.0, 2.0, 3.0]);

    printed(folder, &[&["pack", "--mission", "m.toml", "--name", "Mine"], &options[..]].concat(), 0);
    let again = ["run", "Mine.fmu", "--record", "dump.threshold", "--output", "again.csv"];
    printed(folder, &again, 0);
    // Its default experiment is the mission's too.
    assert_eq!(rows(&folder.join("again.csv")), simulated);
}

#[test]
fn the_files_of_a_mission_are_not_written_over() {
    let Some((scratch, _)) = template() else { return };
    let folder = scratch.path();
    let mission = MISSION.replace("output = \"out.csv\"", "output = \"m.toml\"");
    fs::write(folder.join("m.toml"), &mission).unwrap();
    let reported = printed(folder, &["run", "m.toml", "--template", "template.fmu"], 2);
    assert!(reported.contains("m.toml"), "{reported}");
    assert_eq!(fs::read_to_string(folder.join("m.toml")).unwrap(), mission);
    let two = MISSION.replace("[set]", "[[plot]]\nfile = \"momentum.svg\"\n[set]");
    fs::write(folder.join("m.toml"), two).unwrap();
    let reported = printed(folder, &["run", "m.toml", "--template", "template.fmu"], 2);
    assert!(reported.contains("one file cannot take two pictures"), "{reported}");
}

#[test]
fn what_is_no_mission_is_reported() {
    let scratch = tempfile::tempdir().unwrap();
    let spacecraft = format!("{RESOURCES}/messenger.toml");
    let reported = run(&["run", &spacecraft], 2);
    says(&reported, &["found a spacecraft, allowed: a mission: ", "heliotorque new mission"]);
    let fmu = scratch.path().join("no.fmu");
    assert!(run(&["run", shown(&fmu), "--template", "x.fmu"], 2).contains("--template is for a mission"));
}

#[test]
fn the_missions_of_the_examples_are_simulated() {
    let Some((scratch, _)) = template() else { return };
    let at = |name: &str| scratch.path().join(name);
    fs::create_dir_all(at("examples/missions")).unwrap();
    let mut missions = Vec::new();
    for folder in ["", "examples", "examples/missions"] {
        for entry in fs::read_dir(Path::new(RESOURCES).join(folder)).unwrap() {
            let path = entry.unwrap().path();
            if path.extension().is_some_and(|extension| extension == "toml") {
                let name = path.file_name().unwrap();
                fs::copy(&path, at(folder).join(name)).unwrap();
                if folder == "examples/missions" && !path.to_str().unwrap().ends_with("-timeline.toml") {
                    missions.push(name.to_str().unwrap().to_owned());
                }
            }
        }
    }
    missions.sort();
    let expected = [
        "ace",
        "asteroid-orbiter",
        "comsat",
        "cubesat-12u",
        "mercury-orbiter",
        "messenger-cruise",
        "messenger-flyby1",
        "messenger-flyby2",
        "messenger",
        "solar-sailer",
        "sunshield-telescope",
    ];
    assert_eq!(missions, expected.map(|name| format!("{name}.toml")));
    let folder = at("examples/missions");
    let template = ["--template", "../../template.fmu"];
    for mission in &missions {
        let reported = printed(&folder, &[&["check", mission], &template[..]].concat(), 0);
        assert!(reported.contains(".toml: ok: ") && !reported.contains("warning"), "{reported}");
        // ACE's train is over after half an hour; the others last days.
        let stop: &[&str] = if mission == "ace.toml" { &[] } else { &["--stop", "2h"] };
        let reported = printed(&folder, &[&["run", mission], &template[..], stop].concat(), 0);
        assert!(!reported.contains("warning"), "{reported}");
        for kind in ["csv", "svg"] {
            assert!(folder.join(mission.replace("toml", kind)).exists(), "{mission}: {reported}");
        }
    }
}

/// The spacecraft's own orbit is above all air, the mission's within.
#[test]
fn what_a_flight_warns_of_is_said_once_and_a_mission_s_orbit_gives_the_default_dynamics() {
    let Some((scratch, _)) = template() else { return };
    let folder = scratch.path();
    let leo = include_str!("../../../../docs/src/tutorial/leo.toml");
    let high = leo.replace("\"orbit.dynamics\" = \"disturbed\"\n", "").replace("\"6878 km\"", "\"20000 km\"");
    fs::write(folder.join("leo.toml"), high.replace("\"2026-03-20 UTC\"", "2460000.5")).unwrap();
    let mission = "spacecraft = \"leo.toml\"\nmodel = \"MomentumPlant\"\nstop = \"20 min\"\nstep = \"10 min\"\n\
                   record = [\"position\"]\n[set]\n\"orbit.semiMajorAxis\" = \"6878 km\"\n";
    fs::write(folder.join("low.toml"), mission).unwrap();
    for command in ["check", "run"] {
        let printed = printed(folder, &[command, "low.toml", "--template", "template.fmu"], 0);
        assert_eq!(printed.matches("is it a Julian date?").count(), 1, "{command}: {printed}");
        assert_eq!(printed.matches("warning").count(), 1, "{command}: {printed}");
    }
    let printed = printed(folder, &["check", "leo.toml", "--template", "template.fmu"], 0);
    assert_eq!(printed.matches("is it a Julian date?").count(), 1, "{printed}");
}

/// What `check` and `run` say of a mission that both refuse.
fn refused(folder: &Path, name: &str) -> String {
    let template = ["--template", "template.fmu"];
    let checked = printed(folder, &[&["check", name], &template[..]].concat(), 1);
    let reported = printed(folder, &[&["run", name], &template[..]].concat(), 2);
    let reason = reported.lines().find_map(|line| line.strip_prefix("heliotorque: ")).unwrap();
    // The call is made at the same place by both.
    assert!(checked.contains(reason.trim_start_matches("m: ")), "{name}: {checked}\n{reported}");
    reported
}

#[test]
fn a_mission_that_cannot_run_is_refused_by_check_for_the_same_reason() {
    let Some((scratch, _)) = template() else { return };
    let folder = scratch.path();
    for (change, expected) in [
        (("stop = \"2011-04-06T02:00:00 UTC\"", "stop = \"9999999 d\""), "(--every)"),
        (("output = \"out.csv\"", "output = \"no/such/out.csv\""), "there is no folder"),
        (("output = \"out.csv\"", "output = \"m.toml\""), "an input too"),
        (
            ("file = \"momentum.svg\"", "file = \"out.svg\"\n[[plot]]\nfile = \"out.svg\""),
            "one file cannot take two",
        ),
        // What only the FMU knows.
        (("[set]", "[set]\n\"orbit.eccentricity\" = 0.99"), "the periapsis at 101365 m lies inside Mercury"),
    ] {
        fs::write(
            folder.join("m.toml"),
            MISSION.replace(change.0, change.1).replace("every = \"30 min\"", ""),
        )
        .unwrap();
        let reported = refused(folder, "m.toml");
        assert!(reported.contains(expected), "{expected}: {reported}");
    }
}

#[cfg(unix)]
#[test]
fn what_a_mission_writes_stays_beside_it_and_replaces_no_file_of_others() {
    let Some((scratch, _)) = template() else { return };
    let folder = scratch.path();
    fs::create_dir_all(folder.join("home/deep")).unwrap();
    fs::create_dir(folder.join("away")).unwrap();
    fs::rename(folder.join("template.fmu"), folder.join("home/template.fmu")).unwrap();
    std::os::unix::fs::symlink("../away", folder.join("home/link")).unwrap();
    let home = folder.join("home");
    let (output, plot) = ("output = \"out.csv\"", "file = \"momentum.svg\"");
    let mission = |output_to: &str, plot_to: &str| {
        let text = MISSION.replace(output, &format!("output = \"{output_to}\""));
        fs::write(home.join("m.toml"), text.replace(plot, &format!("file = \"{plot_to}\""))).unwrap();
    };
    let absolute = folder.join("away/x.csv");
    for (output_to, plot_to, option) in [
        ("../x.csv", "x.svg", "--output"),
        (shown(&absolute), "x.svg", "--output"),
        ("link/x.csv", "x.svg", "--output"),
        ("x.csv", "../x.svg", "--output"),
        ("x.csv", "link/x.svg", "--output"),
    ] {
        mission(output_to, plot_to);
        let reported = refused(&home, "m.toml");
        says(&reported, &["outside the mission's folder", &format!("{option} may")]);
    }
    // Not a mission's word but the user's.
    let run = |more: &[&str], status: i32| {
        printed(&home, &[&["run", "m.toml", "--template", "template.fmu", "--quiet"], more].concat(), status)
    };
    mission("../x.csv", "../x.svg");
    let reported = run(&["--output", "../away/a.csv", "--output", "../away/a.svg"], 0);
    assert!(folder.join("away/a.csv").exists() && folder.join("away/a.svg").exists(), "{reported}");

    // A file that no run wrote stays; what a run wrote is replaced without a word, a table of another kind with one.
    mission("deep/x.csv", "x.svg");
    for (name, option) in [("deep/x.csv", "--output"), ("x.svg", "--output")] {
        fs::write(home.join(name), "precious").unwrap();
        let reported = refused(&home, "m.toml");
        says(&reported, &["a file that no run wrote", &format!("{option} replaces any")]);
        assert_eq!(fs::read_to_string(home.join(name)).unwrap(), "precious");
        fs::remove_file(home.join(name)).unwrap();
    }
    for expected in ["", "", "found a table with other columns, which this run replaces"] {
        if !expected.is_empty() {
            fs::write(home.join("deep/x.csv"), "time,thrust\n0,1\n").unwrap();
        }
        let reported = run(&[], 0);
        assert!(reported.is_empty() == expected.is_empty() && reported.contains(expected), "{reported}");
        assert_eq!(rows(&home.join("deep/x.csv")).len(), 5);
    }
    fs::write(home.join("deep/x.csv"), "precious").unwrap();
    let reported = run(&["--output", "deep/x.csv"], 0);
    assert_eq!(rows(&home.join("deep/x.csv")).len(), 5, "{reported}");
}

//! A timeline is judged before it is packed, and reported of where it is.

use std::fs;

use model_description::Description;

use crate::{library, packed, probe_library, run, says, shown, template, words};

const SCHEDULE: &str = "all-types-schedule.toml";

fn guid(fmu: &std::path::Path) -> String {
    let fmu = fmi::Fmu::open(fmu).unwrap();
    let Description { guid, .. } = fmu.description().clone();
    guid
}

#[test]
fn a_timeline_is_packed_and_leaves_the_guid() {
    let Some((scratch, plain)) = packed("AllTypes") else { return };
    let library = probe_library().unwrap();
    let path = |name: &str| scratch.path().join(name);
    let (timeline, fmu) = (path("mine.toml"), path("Timed.fmu"));
    let line = format!(
        "pack --library {} --model AllTypes --timeline {} --output {}",
        shown(&library),
        shown(&timeline),
        shown(&fmu)
    );
    let pack = words(&line);
    assert!(run(&pack, 2).contains("mine.toml"));
    fs::write(&timeline, "# torn\nend_s = ").unwrap();
    let text = run(&pack, 2);
    assert!(text.contains("mine.toml: ") && text.contains("line 2") && !fmu.exists(), "{text}");
    fs::write(&timeline, "end_s = 2.0\n").unwrap();
    run(&pack, 0);
    assert_eq!(guid(&fmu), guid(&plain));
    let mut zip = zip::ZipArchive::new(fs::File::open(&fmu).unwrap()).unwrap();
    assert_eq!(zip.by_name(&format!("resources/{SCHEDULE}")).unwrap().size(), 12);
    let arguments = |fmu| ["run", shown(fmu), "--stop", "3", "--step", "0.5", "--quiet"].map(str::to_owned);
    let ran = |fmu| crate::heliotorque(&arguments(fmu).each_ref().map(String::as_str)).output().unwrap();
    assert!(ran(&plain).status.success());
    let text = crate::text(&ran(&fmu));
    assert!(text.contains("ended by itself at 2 s"), "{text}");
}

#[test]
fn a_model_without_timelines_refuses_one_by_name() {
    let Some((scratch, _)) = packed("Empty") else { return };
    let library = probe_library().unwrap();
    let timeline = scratch.path().join("mine.toml");
    fs::write(&timeline, "end_s = 2.0\n").unwrap();
    let pack = ["pack", "--library", shown(&library), "--model", "Empty", "--timeline", shown(&timeline)];
    let text = run(&pack, 2);
    assert!(text.contains("--timeline: Empty takes none, allowed for: AllTypes"), "{text}");
}

#[test]
fn the_timeline_in_an_fmu_is_reported_and_judged() {
    let Some((scratch, fmu)) = packed("Empty") else { return };
    let folder = scratch.path().join("unpacked");
    zip::ZipArchive::new(fs::File::open(fmu).unwrap()).unwrap().extract(&folder).unwrap();
    let resources = folder.join("resources");
    fs::create_dir_all(&resources).unwrap();
    assert!(!run(&["info", shown(&folder)], 0).contains("timeline"));
    let spacecraft = include_str!("../../../../fmu-src/resources/messenger.toml");
    fs::write(resources.join("spacecraft.toml"), spacecraft).unwrap();
    let timeline = include_str!("../../../../fmu-src/resources/examples/timeline.toml");
    fs::write(resources.join("timeline.toml"), timeline).unwrap();
    let reported = "7 commands from 2011-04-06T00:00:00 UTC to 2011-04-07T00:00:00 UTC";
    let text = run(&["info", shown(&folder)], 0);
    assert!(text.contains(reported), "{text}");
    let text = run(&["check", shown(&folder), "--static", "--verbose"], 0);
    assert!(text.contains(reported), "{text}");
    fs::write(resources.join("timeline.toml"), timeline.replace("\"MLA\"", "\"MAL\"")).unwrap();
    assert!(run(&["info", shown(&folder)], 0).contains("with 2 problems"));
    let text = run(&["check", shown(&folder), "--static"], 1);
    assert!(text.contains("timeline.toml:12: command[1].boresight.instrument"), "{text}");
    assert!(text.contains("did you mean \"MLA\"?"), "{text}");
}

#[test]
fn a_spacecraft_with_antennas_about_the_sun_is_in_downlink_throughout() {
    let Some((scratch, template)) = template() else { return };
    let file = scratch.path().join("cruise.toml");
    let spacecraft = include_str!("../../../../fmu-src/resources/messenger.toml");
    fs::write(&file, spacecraft.replace("[start]", "[start]\n\"orbit.center\" = \"sun\"")).unwrap();
    let printed = run(&["check", shown(&file), "--template", shown(&template)], 0);
    says(&printed, &["points               downlink throughout (guided.phase cruise), the Sun on -Y"]);
}

/// Attitudes, panels, events; two lines are Guidance's alone.
const BOTH: &str = "\
[[command]]
at = 0
scenario = \"downlink\"
sun = { azimuth = \"-4 deg\" }
[[command]]
at = \"1 h\"
scenario = \"burn\"
[[command]]
at = \"2 h\"
mode = \"safeHold\"
[[panels]]
at = 0
sunOffset = [\"60 deg\", \"55 deg\"]
windmill = \"1 deg\"
[[panels]]
at = \"90 min\"
sunOffset = \"-60 deg\"
[[event]]
at = \"3 h\"
dump = [0, \"-20 mN.m.s\", \"0.5 N.m.s\"]
[[event]]
at = \"4 h\"
maneuver = { deltaV = [0.1, 0, 0] }
";

#[test]
fn a_file_is_judged_for_both_models() {
    let scratch = tempfile::tempdir().unwrap();
    let file = scratch.path().join("both.toml");
    fs::write(&file, BOTH).unwrap();
    let file = shown(&file);
    says(
        &run(&["check", file], 0),
        &[
            "ok: 3 commands from 0 s to the end, 2 positions of the panels from 0 s to the end, 2 events from 10800 s to 14400 s",
            &format!(
                "\nGuidance only: {file}:7: command[2].scenario: the scenario burn; MomentumPlant refuses it"
            ),
            &format!(
                "\nGuidance only: {file}:10: command[3].mode: the mode safeHold; MomentumPlant refuses it"
            ),
            "\nMomentumPlant only: 2 positions of the panels, 1 maneuver; Guidance leaves them out",
        ],
    );
    // What only one of them reads is judged too.
    fs::write(file, BOTH.replace("\"55 deg\"", "\"5 km\"").replace("N.m.s\"]", "N.m\"]")).unwrap();
    let printed = run(&["check", file], 1);
    says(
        &printed,
        &[
            "both.toml:13: panels[1].sunOffset[2]: found \"5 km\"",
            "both.toml:20: event[1].dump[3]: found \"0.5 N.m\"",
        ],
    );
    says(
        &printed,
        &["an angular momentum: a number in N.m.s or a string with a unit: N.m.s, mN.m.s", "2 problems"],
    );
}

#[test]
fn a_plant_takes_a_timeline_without_burns_and_modes() {
    let Some((scratch, plain)) = template() else { return };
    let library = library().unwrap();
    let (file, fmu) = (scratch.path().join("both.toml"), scratch.path().join("Timed.fmu"));
    fs::write(&file, BOTH).unwrap();
    let pack = |model: &'static str| {
        [
            "pack",
            "--library",
            shown(&library),
            "--model",
            model,
            "--timeline",
            shown(&file),
            "--output",
            shown(&fmu),
        ]
        .map(str::to_owned)
    };
    let arguments = pack("MomentumPlant");
    let arguments = arguments.each_ref().map(String::as_str);
    let printed = run(&arguments, 2);
    says(&printed, &["both.toml:7: command[2].scenario: found the scenario burn, allowed: another scenario"]);
    says(
        &printed,
        &[
            "both.toml:10: command[3].mode: found the mode safeHold, allowed: no such key",
            "[[event]] with `maneuver`",
        ],
    );
    assert!(!fmu.exists());
    run(&pack("Guidance").each_ref().map(String::as_str), 0);
    says(&run(&["info", shown(&fmu)], 0), &["3 commands from 0 s to the end, 2 positions"]);

    let plant = BOTH
        .replace("scenario = \"burn\"", "scenario = \"nadir\"")
        .replace("mode = \"safeHold\"", "scenario = \"nadir\"");
    fs::write(&file, &plant).unwrap();
    // Panels stand by another rule unless it is chosen, and that is reported.
    let without = "[[panels]] of the timeline are without effect: found panel[k].control = sunOffset, sunOffset, allowed: timeline";
    says(&run(&arguments, 0), &[without]);
    assert_eq!(guid(&fmu), guid(&plain));
    says(&run(&["check", shown(&fmu), "--static"], 0), &[without]);
    let chosen = [&arguments[..], &["--set", "panel[1].control=timeline"]].concat();
    assert!(!run(&chosen, 0).contains("warning"));
    let printed = run(&["info", shown(&fmu)], 0);
    says(
        &printed,
        &[
            "3 commands from 0 s to the end, 2 positions of the panels from 0 s to the end, 2 events from 10800 s",
        ],
    );
    let printed = run(&["check", shown(&fmu), "--probe", "simulation", "--verbose"], 0);
    says(&printed, &["2 events from 10800 s to 14400 s"]);

    // A mission names it; the FMU reads its commands.
    let mission = scratch.path().join("timed.toml");
    let text = "model = \"MomentumPlant\"\ntimeline = \"both.toml\"\nstop = \"5 h\"\nstep = \"10 min\"\n\
                record = [\"timeline.command\", \"sun.azimuth\"]\noutput = \"timed.csv\"\n";
    fs::write(&mission, text).unwrap();
    let check = ["check", shown(&mission), "--template", shown(&plain)];
    says(
        &run(&check, 0),
        &["ok: timed runs", "without effect: found panel[k].control = sunOffset, sunOffset"],
    );
    let set = format!("{text}[set]\n\"panel[1].control\" = \"timeline\"\n");
    fs::write(&mission, set).unwrap();
    assert!(!run(&check, 0).contains("without effect"));
    run(&["run", shown(&mission), "--template", shown(&plain), "--quiet"], 0);
    let rows = fs::read_to_string(scratch.path().join("timed.csv")).unwrap();
    let row = |number: usize| {
        rows.lines().nth(number).unwrap().split(',').map(|it| it.parse().unwrap()).collect::<Vec<f64>>()
    };
    let commands = [1, 7, 13, 31].map(|number| row(number)[1]);
    assert_eq!(commands, [1.0, 2.0, 3.0, 3.0], "{rows}");
    // A mission's mistakes are reported by the timeline's lines.
    fs::write(&file, plant.replace("\"90 min\"", "0")).unwrap();
    says(&run(&check, 1), &["both.toml:16: panels[2].at: found 0, when panels[1] begins"]);
}

//! A timeline is judged before it is packed, and reported of where it is.

use std::fs;

use model_description::Description;

use crate::{packed, probe_library, run, shown, words};

const SCHEDULE: &str = "all-types-schedule.toml";

fn guid(fmu: &std::path::Path) -> String {
    let fmu = loader::Fmu::open(fmu).unwrap();
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
    assert!(run(&pack, 1).contains("mine.toml"));
    fs::write(&timeline, "# torn\nend_s = ").unwrap();
    let text = run(&pack, 1);
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
    let text = run(&pack, 1);
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

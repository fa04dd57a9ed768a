//! `check` of a plan, a leg and a campaign: what the file's command refuses before its first flight, in the same words, without a file.

use std::{collections::BTreeSet, fs, path::Path};

use tempfile::TempDir;

use crate::{heliotorque, run, says, template, text, words};

/// Files as `new` writes them, and a template.
fn written() -> Option<TempDir> {
    let (scratch, _) = template()?;
    for kind in ["spacecraft", "plan", "leg", "campaign"] {
        in_folder(scratch.path(), &format!("new {kind}"), 0);
    }
    Some(scratch)
}

fn in_folder(folder: &Path, line: &str, status: i32) -> String {
    let output = heliotorque(&words(line)).current_dir(folder).output().unwrap();
    let text = text(&output);
    assert_eq!(output.status.code(), Some(status), "{line}: {text}");
    text
}

fn names(folder: &Path) -> BTreeSet<String> {
    fs::read_dir(folder).unwrap().map(|it| it.unwrap().file_name().into_string().unwrap()).collect()
}

#[test]
fn what_the_command_refuses_before_its_first_flight_check_refuses() {
    let Some(scratch) = written() else { return };
    let folder = scratch.path();
    let activity = "# [[activity]]\n# name = \"calibration\"\n# start = \"2011-04-12T00:00:00 UTC\"\n# stop = \"2011-04-12T06:00:00 UTC\"\n\
                    # command = ";
    for (kind, edits, expected) in [
        // Unknown variables and values, and ranges the wrong way.
        ("campaign", &[("\"solar.flux\"", "\"solar.fluks\"")][..], "vary.\"solar.fluks\""),
        ("campaign", &[("final = [\"momentum.body\"", "final = [\"momentum.bodi\"")], "keep.final"),
        (
            "campaign",
            &[("[\"2011-04-06 UTC\", \"2011-07-03 UTC\"]", "[\"2011-07-03 UTC\", \"2011-04-06 UTC\"]")],
            "start.epoch",
        ),
        ("campaign", &[("[1353, 1361]", "[1353, -1361]")], "solar.flux"),
        ("campaign", &[("# histories = \"histories\"", "histories = \"../histories\"")], "keep.histories"),
        // A spacecraft in the place of the mission.
        (
            "campaign",
            &[("mission = \"mission.toml\"", "mission = \"spacecraft.toml\"")],
            "found a spacecraft",
        ),
        ("plan", &[("plan-mission.toml", "spacecraft.toml")], "found a spacecraft"),
        ("leg", &[("leg-mission.toml", "spacecraft.toml")], "found a spacecraft"),
        // Missions that are none of such a plan, and times that they do not have.
        (
            "leg",
            &[("leg-mission.toml", "plan-mission.toml")],
            ":9: mission: plan-mission.toml: orbit.dynamics: found ",
        ),
        (
            "leg",
            &[("2011-06-20T12:00:00", "2011-03-20T12:00:00")],
            ":18: arrive.at: found a time that is not after the departure",
        ),
        ("plan", &[("freeze = \"2 d\"", "freeze = \"10 d\"")], ":11: freeze: found 10 d"),
        (
            "plan",
            &[(activity, &activity.replace("# ", "").replace("2011-04", "2012-04"))],
            "activity[1]: found a time outside",
        ),
        (
            "plan",
            &[
                ("freeze = \"2 d\"", "freeze = \"0 d\""),
                ("# [flyby]\n# body = \"mercury\"\n# altitude", "[flyby]\nbody = \"mercury\"\naltitude"),
                ("# angle", "angle"),
            ],
            "plan-mission.toml: ",
        ),
    ] {
        let file = format!("{kind}.toml");
        let good = fs::read_to_string(folder.join(&file)).unwrap();
        let bad = edits.iter().fold(good.clone(), |text, (old, new)| {
            assert!(text.contains(old), "{old}");
            text.replace(old, new)
        });
        let command = match kind {
            "campaign" => "sweep campaign.toml --output out.csv".to_owned(),
            _ => format!("plan {file} --output out"),
        };
        fs::write(folder.join(&file), bad).unwrap();
        let before = names(folder);
        let checked = in_folder(folder, &format!("check {file} --template template.fmu"), 1);
        assert_eq!(names(folder), before, "{checked}");
        let refused = in_folder(folder, &format!("{command} --template template.fmu"), 2);
        fs::write(folder.join(&file), good).unwrap();
        let refusal = refused.strip_prefix("heliotorque: ").unwrap();
        says(refusal, &[expected]);
        let (of_check, last) = checked.trim_end().rsplit_once('\n').unwrap();
        assert_eq!(of_check, refusal.trim_end());
        says(last, &["problem", "judged as a "]);
    }
}

/// Without a library the mission is read, and what takes its variables is named as not judged.
#[test]
fn what_no_library_judges_is_named() {
    let Some(scratch) = written() else { return };
    let folder = scratch.path();
    fs::remove_file(folder.join("template.fmu")).unwrap();
    for (kind, mission) in
        [("plan", "plan-mission.toml"), ("leg", "leg-mission.toml"), ("campaign", "mission.toml")]
    {
        let checked = in_folder(folder, &format!("check {kind}.toml"), 0);
        says(&checked, &["ok: ", "not judged, as no library was found (see --template)", mission]);
        let text = fs::read_to_string(folder.join(format!("{kind}.toml"))).unwrap();
        let wrong = folder.join("wrong.toml");
        fs::write(&wrong, text.replace(&format!("mission = \"{mission}\""), "mission = \"spacecraft.toml\""))
            .unwrap();
        says(&run(&["check", crate::shown(&wrong)], 1), &["found a spacecraft"]);
    }
}

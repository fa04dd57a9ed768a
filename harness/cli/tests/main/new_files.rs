//! `heliotorque new` writes files that work unchanged, and `man` pages of every command.

use std::{fs, path::Path, process::Command};

use crate::{heliotorque, run, says, shown, template, text, words};

const KINDS: [&str; 11] = [
    "spacecraft",
    "spinner",
    "comsat",
    "cubesat",
    "asteroid",
    "telescope",
    "mission",
    "timeline",
    "plan",
    "leg",
    "campaign",
];
/// Craft with a mission beside them that flies them.
const GALLERY: [&str; 5] = ["spinner", "comsat", "cubesat", "asteroid", "telescope"];

#[test]
fn a_file_that_is_there_is_kept() {
    let scratch = tempfile::tempdir().unwrap();
    let file = scratch.path().join("mine.toml");
    for kind in KINDS {
        let _ = fs::remove_file(&file);
        let reported = run(&["new", kind, shown(&file)], 0);
        assert!(reported.contains("mine.toml: written; next: heliotorque "), "{reported}");
        let text = fs::read_to_string(&file).unwrap();
        // Alone it names the file as its kind.
        let alone = text.replace("mine.toml", &format!("{kind}.toml"));
        assert_eq!(run(&["new", kind, "-"], 0), alone, "{kind}");
        fs::write(&file, "# mine\n").unwrap();
        let reported = run(&["new", kind, shown(&file)], 2);
        assert!(reported.contains("mine.toml: found a file") && reported.contains("--force"), "{reported}");
        assert_eq!(fs::read_to_string(&file).unwrap(), "# mine\n");
        run(&["new", kind, shown(&file), "--force"], 0);
        assert_eq!(fs::read_to_string(&file).unwrap(), text, "{kind}");
    }
    run(&["new", "planet"], 2);
}

/// The commands in a file's head and, for some, those that `--help` has behind `new`: all end with status 0.
#[test]
fn every_new_file_works_unchanged() {
    for kind in KINDS {
        let Some((scratch, template)) = template() else { return };
        let folder = scratch.path();
        let printed = |line: &str| {
            let output = heliotorque(&words(line)).current_dir(folder).output().unwrap();
            let reported = text(&output);
            assert_eq!(output.status.code(), Some(0), "{kind}: {line}: {reported}");
            reported
        };
        printed(&format!("new {kind}"));
        let name = format!("{kind}.toml");
        let written = fs::read_to_string(folder.join(&name)).unwrap();
        let lines = written.lines().filter_map(|line| line.strip_prefix("#   heliotorque "));
        // Behind two blanks stands what a command is for.
        let commands: Vec<&str> = lines.map(|line| line.split("  ").next().unwrap()).collect();
        assert!(commands.len() > 1 && commands[0].starts_with("check "), "{commands:?}");
        for command in &commands {
            let takes_no_template =
                ["draw", "plan spin"].iter().any(|it| command.starts_with(it)) || command.contains(".fmu");
            let mut with = if takes_no_template { "" } else { " --template template.fmu" }.to_owned();
            // Longer and more flights change nothing that is looked at.
            with += if command.starts_with("size ") { " --budget 0s --duration 10d" } else { "" };
            // Its options count in quotes for a shell.
            let reported = printed(&format!("{command}{with}").replace('\'', ""));
            if command.starts_with("check ") {
                assert!(reported.contains(".toml: ok") && !reported.contains("warning"), "{reported}");
            }
        }
        packs(kind, folder, &template);
        if GALLERY.contains(&kind) {
            printed(&format!("check {kind}-mission.toml --template template.fmu"));
            printed(&format!("run {kind}-mission.toml --quiet --template template.fmu"));
            assert!(fs::read_dir(folder).unwrap().any(|it| it.unwrap().path().extension().unwrap() == "svg"));
        }
        if kind == "mission" {
            let rows = fs::read_to_string(folder.join("mission.csv")).unwrap();
            let header = "time,momentum.body[1],momentum.body[2],momentum.body[3],dump.count,sun.elevation\n";
            assert!(rows.starts_with(header));
            assert_eq!(rows.lines().count(), 1 + 10 * 144 + 1);
            assert!(folder.join("mission.svg").exists());
        }
    }
}

/// Files made from a new file run.
fn packs(kind: &str, folder: &Path, template: &Path) {
    let (file, fmu) = (folder.join(format!("{kind}.toml")), folder.join("packed.fmu"));
    let spacecraft = ["--spacecraft", shown(&file)];
    let packs: &[&[&str]] = match kind {
        "mission" => &[&["--mission", shown(&file)]],
        "timeline" => &[
            &["--model", "Guidance", "--timeline", shown(&file)],
            &["--timeline", shown(&file), "--set", "panel[1].control=timeline"],
        ],
        // Every model's reference flight suits a file that says little.
        "spacecraft" => &[
            &spacecraft,
            &["--model", "Guidance", "--spacecraft", shown(&file)],
            &["--model", "DisturbanceTorque", "--spacecraft", shown(&file)],
        ],
        "spinner" => &[&spacecraft],
        _ => &[],
    };
    for pack in packs {
        run(&[&["pack", "--output", shown(&fmu)], *pack, &["--template", shown(template)]].concat(), 0);
        run(&["run", shown(&fmu), "--stop", "60", "--quiet"], 0);
    }
}

/// The mission that a file names is kept where one stands there, but for `--force`.
#[test]
fn the_mission_of_a_new_file_is_kept_where_it_is_there() {
    for (kind, mission) in
        [("plan", "plan-mission.toml"), ("leg", "leg-mission.toml"), ("campaign", "mission.toml")]
    {
        let scratch = tempfile::tempdir().unwrap();
        let (file, beside) = (scratch.path().join("mine.toml"), scratch.path().join(mission));
        says(&run(&["new", kind, shown(&file)], 0), &[mission, "written, the mission of"]);
        let written = fs::read_to_string(&beside).unwrap();
        fs::write(&beside, "# mine\n").unwrap();
        fs::remove_file(&file).unwrap();
        says(&run(&["new", kind, shown(&file)], 0), &[mission, "there already, kept"]);
        assert_eq!(fs::read_to_string(&beside).unwrap(), "# mine\n");
        run(&["new", kind, shown(&file)], 2);
        assert_eq!(fs::read_to_string(&beside).unwrap(), "# mine\n");
        run(&["new", kind, shown(&file), "--force"], 0);
        assert_eq!(fs::read_to_string(&beside).unwrap(), written);
    }
}

#[test]
fn every_command_has_a_page_that_man_reads() {
    let scratch = tempfile::tempdir().unwrap();
    run(&["man", "--output", shown(scratch.path())], 0);
    let mut pages: Vec<String> = fs::read_dir(scratch.path())
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    pages.sort();
    let help = run(&["help"], 0);
    let commands: Vec<&str> = help
        .lines()
        .take_while(|line| !line.starts_with("Options:"))
        .filter_map(|line| line.strip_prefix("  ").filter(|line| !line.starts_with(' ')))
        .filter_map(|line| line.split_whitespace().next())
        .filter(|command| !command.starts_with('-') && *command != "help")
        .collect();
    let mut expected: Vec<String> =
        commands.iter().map(|command| format!("heliotorque-{command}.1")).collect();
    expected.extend(["heliotorque.1", "heliotorque-plan-spin.1"].map(str::to_owned));
    expected.sort();
    assert_eq!(pages, expected);
    assert!(commands.contains(&"run") && commands.contains(&"plan"), "{help}");
    for command in commands {
        let page = run(&["man", command], 0);
        says(&page, &[&format!("heliotorque\\-{command}"), ".SH SYNOPSIS"]);
    }
    assert!(run(&["man", "nonsense"], 2).contains("allowed: info, check, run"));
    // Without a warning, where there is a man to read it.
    let page = scratch.path().join("heliotorque-run.1");
    if let Ok(read) = Command::new("man").args(["--warnings", "-l"]).arg(&page).env("MANWIDTH", "80").output()
    {
        let (text, printed) = (String::from_utf8_lossy(&read.stdout), String::from_utf8_lossy(&read.stderr));
        assert!(read.status.success() && printed.is_empty() && text.contains("--stop"), "{printed}{text}");
    }
}

//! `heliotorque new` writes files that work unchanged, and `man` pages of every command.

use std::{fs, process::Command};

use crate::{run, says, shown, template};

const KINDS: [&str; 7] = ["spacecraft", "spinner", "mission", "timeline", "plan", "leg", "campaign"];

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
        let reported = run(&["new", kind, shown(&file)], 1);
        assert!(reported.contains("mine.toml: found a file") && reported.contains("--force"), "{reported}");
        assert_eq!(fs::read_to_string(&file).unwrap(), "# mine\n");
        run(&["new", kind, shown(&file), "--force"], 0);
        assert_eq!(fs::read_to_string(&file).unwrap(), text, "{kind}");
    }
    run(&["new", "planet"], 2);
}

#[test]
fn every_new_file_works_unchanged() {
    let Some((scratch, template)) = template() else { return };
    let at = |name: &str| scratch.path().join(name);
    let with = |arguments: &[&str]| run(&[arguments, &["--template", shown(&template)]].concat(), 0);
    for kind in KINDS {
        let file = at(&format!("{kind}.toml"));
        run(&["new", kind, shown(&file)], 0);
        let reported = with(&["check", shown(&file)]);
        assert!(reported.contains(".toml: ok"), "{reported}");
        assert!(!reported.contains("warning"), "{reported}");
        let fmu = at(&format!("{kind}.fmu"));
        let spacecraft = ["--spacecraft", shown(&file)];
        let packs: &[&[&str]] = match kind {
            "mission" => &[&["--mission", shown(&file)]],
            // They name the mission beside them, and are packed with nothing.
            "plan" | "leg" | "campaign" => &[],
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
            _ => &[&spacecraft],
        };
        for pack in packs {
            with(&[&["pack", "--output", shown(&fmu)], *pack].concat());
            run(&["run", shown(&fmu), "--stop", "60", "--quiet"], 0);
        }
    }
    let reported = with(&["run", shown(&at("mission.toml"))]);
    assert!(reported.contains("wrote") && !reported.contains("found"), "{reported}");
    let rows = fs::read_to_string(at("mission.csv")).unwrap();
    assert!(
        rows.starts_with(
            "time,momentum.body[1],momentum.body[2],momentum.body[3],dump.count,sun.elevation\n"
        )
    );
    assert_eq!(rows.lines().count(), 1 + 10 * 144 + 1);
    assert!(at("mission.svg").exists());
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
        .skip_while(|line| !line.starts_with("Commands:"))
        .filter_map(|line| line.strip_prefix("  ").filter(|line| !line.starts_with(' ')))
        .filter_map(|line| line.split_whitespace().next())
        .filter(|command| !command.starts_with('-') && *command != "help")
        .collect();
    let mut expected: Vec<String> =
        commands.iter().map(|command| format!("heliotorque-{command}.1")).collect();
    let more = [
        "heliotorque.1",
        "heliotorque-plan-flyby.1",
        "heliotorque-plan-leg.1",
        "heliotorque-plan-momentum.1",
        "heliotorque-plan-spin.1",
    ];
    expected.extend(more.map(str::to_owned));
    expected.sort();
    assert_eq!(pages, expected);
    assert!(commands.contains(&"run") && commands.contains(&"plan"), "{help}");
    for command in commands {
        let page = run(&["man", command], 0);
        says(&page, &[&format!("heliotorque\\-{command}"), ".SH SYNOPSIS"]);
    }
    assert!(run(&["man", "nonsense"], 1).contains("allowed: info, check, run"));
    // Without a warning, where there is a man to read it.
    let page = scratch.path().join("heliotorque-run.1");
    if let Ok(read) = Command::new("man").args(["--warnings", "-l"]).arg(&page).env("MANWIDTH", "80").output()
    {
        let (text, printed) = (String::from_utf8_lossy(&read.stdout), String::from_utf8_lossy(&read.stderr));
        assert!(read.status.success() && printed.is_empty() && text.contains("--stop"), "{printed}{text}");
    }
}

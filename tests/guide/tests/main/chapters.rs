//! Every file is a chapter; every model, command, study and drawing has its place.

use std::fs;

use heliotorque_guide::project;

use crate::commands::heliotorque;
use crate::{commands, markdown};

#[test]
fn every_file_is_a_chapter() {
    let folder = project().join("docs").join("src");
    let summary = fs::read_to_string(folder.join("SUMMARY.md")).unwrap();
    let chapters = markdown::links(&summary);
    for path in markdown::files(&folder) {
        let name = path.strip_prefix(&folder).unwrap().to_str().unwrap().replace('\\', "/");
        assert!(name == "SUMMARY.md" || chapters.contains(&name), "{name} is not in SUMMARY.md");
        let text = fs::read_to_string(&path).unwrap();
        assert!(text.starts_with("# "), "{name} begins with no title");
    }
}

#[test]
fn every_model_has_a_chapter() {
    let golden = project().join("modelDescription").join("golden");
    let mut models = 0;
    for entry in fs::read_dir(golden).unwrap() {
        let path = entry.unwrap().path();
        let model = path.file_stem().unwrap().to_str().unwrap();
        let words: String = model
            .chars()
            .enumerate()
            .map(|(k, c)| if c.is_uppercase() && k > 0 { format!("-{c}") } else { c.to_string() })
            .collect();
        let chapter =
            project().join("docs").join("src").join("models").join(words.to_lowercase()).with_extension("md");
        let text = fs::read_to_string(&chapter).unwrap_or_default();
        assert!(text.starts_with(&format!("# {model}\n")), "{}", chapter.display());
        models += 1;
    }
    assert!(models >= 4);
}

#[test]
fn every_command_has_a_section() {
    let page = fs::read_to_string(project().join("docs").join("src").join("commands.md")).unwrap();
    for command in commands::subcommands() {
        assert!(page.contains(&format!("\n## {command}\n")), "commands.md has no section on {command}");
        let shown = markdown::commands(&page);
        assert!(shown.iter().any(|line| line.starts_with(&format!("heliotorque {command}"))), "{command}");
    }
}

#[test]
fn every_study_is_reported_of() {
    let page = fs::read_to_string(project().join("docs").join("src").join("studies.md")).unwrap();
    let mut studies = 0;
    let subjects = fs::read_dir(project().join("harness").join("studies")).unwrap();
    for subject in subjects.map(|entry| entry.unwrap().path()).filter(|path| path.is_dir()) {
        for file in fs::read_dir(&subject).unwrap().map(|entry| entry.unwrap().path()) {
            let is_program = file.extension().is_some_and(|it| it == "py")
                && fs::read_to_string(&file)
                    .unwrap()
                    .lines()
                    .next_back()
                    .unwrap_or_default()
                    .contains("main(");
            if is_program {
                let [subject, name] =
                    [&subject, &file].map(|path| path.file_stem().unwrap().to_str().unwrap());
                assert!(
                    page.contains(&format!("`{subject}/{name}`")),
                    "studies.md does not name {subject}/{name}"
                );
                studies += 1;
            }
        }
    }
    assert!(studies > 15, "{studies}");
}

#[test]
fn every_picture_is_shown() {
    let folder = project().join("docs").join("src");
    let mut shown: String =
        markdown::files(&folder).iter().map(|path| fs::read_to_string(path).unwrap()).collect();
    shown += &fs::read_to_string(project().join("README.md")).unwrap();
    for entry in fs::read_dir(folder.join("pictures")).unwrap() {
        let name = entry.unwrap().file_name().into_string().unwrap();
        assert!(shown.contains(&format!("pictures/{name})")), "{name} is shown nowhere");
    }
}

#[test]
fn every_key_of_every_file_is_reported_of() {
    let book = project().join("docs").join("src").join("files");
    for (schema, chapters) in [
        ("spacecraft", &["spacecraft.md", "start.md"][..]),
        ("spinner", &["spinner.md", "start.md"]),
        ("mission", &["mission.md"]),
        ("timeline", &["timeline.md"]),
        ("ephemeris", &["ephemeris.md"]),
    ] {
        let pages: String =
            chapters.iter().map(|name| fs::read_to_string(book.join(name)).unwrap()).collect();
        let keys = heliotorque(&["new", "--schema", schema]);
        let mut reported = 0;
        for block in keys.split("\"properties\": {").skip(1) {
            // Keys of this object stand one level deeper than its brace.
            let indent = block.lines().nth(1).map_or(0, |line| line.len() - line.trim_start().len());
            let end = " ".repeat(indent.saturating_sub(2)) + "}";
            for line in block.lines().skip(1).take_while(|line| *line != end && *line != format!("{end},")) {
                if line.len() - line.trim_start().len() != indent {
                    continue;
                }
                let key = line.trim_start().strip_prefix('"').and_then(|rest| rest.split_once('"'));
                let Some((key, _)) = key else { continue };
                assert!(
                    [format!("`{key}`"), format!("[{key}]"), format!("`{key} = ")]
                        .iter()
                        .any(|form| pages.contains(form)),
                    "{schema}: no word on {key}"
                );
                reported += 1;
            }
        }
        assert!(reported > 10, "{schema}: {reported}");
    }
}

/// The drawing of the tree names every crate, and the modules of `physics` in their order.
#[test]
fn the_tree_is_complete() {
    let library = fs::read_to_string(project().join("fmu-src/physics/src/lib.rs")).unwrap();
    let modules: Vec<&str> =
        library.lines().filter_map(|line| line.strip_prefix("pub mod ")?.strip_suffix(';')).collect();
    let modules: Vec<&str> = modules.into_iter().filter(|name| *name != "constants").collect();
    let text = fs::read_to_string(project().join("docs/src/architecture.md")).unwrap();
    let tree = text.split("```").find(|block| block.contains("fmu-src/\n")).unwrap();
    let drawn = tree.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(drawn.contains(&modules.join(" -> ")), "{}", modules.join(" -> "));
    for folder in ["fmu-src", "harness"] {
        let entries = fs::read_dir(project().join(folder)).unwrap().map(Result::unwrap);
        for entry in entries.filter(|it| it.path().is_dir()) {
            let name = entry.file_name().into_string().unwrap();
            assert!(tree.contains(&format!("\n  {name}/")), "{folder}/{name}");
        }
    }
}

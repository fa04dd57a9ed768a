//! Wrong usage and files that are none end with 2 and are named, and help helps.

use crate::{run, says, shown};

#[test]
fn wrong_usage_is_two() {
    for arguments in [
        &["simulate"][..],
        &[],
        &["run"],
        &["run", "x.fmu", "--stop", "soon"],
        &["run", "x.fmu", "--slopes"],
        &["run", "x.fmu", "--nonsense"],
        &["pack", "--library", "a.so", "--output", "x.fmu"],
        &["pack", "--model", "M", "--library", "a.so", "--template", "b.fmu", "--output", "x.fmu"],
        &["check"],
        &["compare", "a.csv"],
        &["plot"],
    ] {
        run(arguments, 2);
    }
    assert!(run(&["run", "x.fmu", "--stop", "soon"], 2).contains("10min"));
}

#[test]
fn negative_values_are_values() {
    // Whatever can be negative is taken: the file is the first thing that fails.
    for arguments in [["--start", "-1d"], ["--start", "-1.5e3"], ["--stop", "-0.5 h"]] {
        let text = run(&[&["run", "no/such.fmu"], &arguments[..]].concat(), 2);
        assert!(text.contains("no/such.fmu"), "{text}");
    }
    // Whatever cannot be is refused by its name.
    for (arguments, status) in [
        (["run", "no/such.fmu", "--step", "-5"], 2),
        (["run", "no/such.fmu", "--every", "-1h"], 2),
        (["check", "no/such.fmu", "--timeout", "-2s"], 2),
        (["run", "no/such.fmu", "--timeout", "-2s"], 2),
        (["plan", "spin", "--campaign", "-1d"], 2),
        (["plan", "spin", "--angle", "-2deg"], 2),
    ] {
        let text = run(&arguments, status);
        says(&text, &[arguments[2], arguments[3].trim_end_matches(char::is_alphabetic)]);
    }
}

#[test]
fn a_file_that_is_none_is_named() {
    for command in ["run", "info", "check"] {
        assert!(run(&[command, "no/such.fmu"], 2).contains("no/such.fmu"), "{command}");
    }
    let scratch = tempfile::tempdir().unwrap();
    let file = scratch.path().join("text.fmu");
    std::fs::write(&file, "not an archive").unwrap();
    for (command, status) in [("run", 2), ("info", 2), ("check", 1)] {
        assert!(run(&[command, shown(&file)], status).contains("not a usable FMU archive"), "{command}");
    }
}

#[test]
fn a_study_is_a_program_of_the_sources() {
    for arguments in [&["study", "spin/figure3", "--output", "x"] as &[&str], &["study", "list"], &["study"]]
    {
        says(&run(arguments, 2), &["harness/studies/<subject>/<name>.py", "`cargo xtask study NAME`"]);
    }
}

#[test]
fn what_is_no_fmu_is_named() {
    let scratch = tempfile::tempdir().unwrap();
    let cases: [(&str, &[u8], &str); 9] = [
        ("empty.fmu", b"", "an empty file"),
        ("my.fmu", b"# mine\n\nname = \"A\"\n[mass_properties]\n", "a TOML file"),
        ("table.fmu", b"\n[start]\n", "a TOML file"),
        ("libmine.fmu", b"\x7fELF\x02\x01", "a shared library"),
        ("mine.fmu", b"MZ\x90\0", "a shared library"),
        ("page.fmu", b"\xef\xbb\xbf<?xml version=\"1.0\"?>", "an XML file"),
        ("packed.fmu", b"\x1f\x8b\x08\0", "an archive of another kind"),
        ("words.fmu", "kein Archiv, \u{e4}".as_bytes(), "it is a text file"),
        ("cut.fmu", b"PK\x03\x04", "not a usable FMU archive"),
    ];
    for (name, bytes, expected) in cases {
        let path = scratch.path().join(name);
        std::fs::write(&path, bytes).unwrap();
        for (command, status) in [("info", 2), ("check", 1), ("run", 2)] {
            let text = run(&[command, shown(&path)], status);
            assert!(text.contains(name) && text.contains(expected), "{text}");
            assert!(text.contains("not a usable FMU archive"), "{text}");
        }
    }
    let toml = scratch.path().join("my.toml");
    std::fs::write(&toml, "name = 1").unwrap();
    assert!(run(&["info", shown(&toml)], 2).contains("`heliotorque check`"));
    for command in ["info", "run"] {
        let text = run(&[command, shown(scratch.path())], 2);
        assert!(text.contains("it is a folder that holds no modelDescription.xml"), "{text}");
    }
}

#[test]
fn a_check_that_would_check_nothing_is_refused() {
    let text = run(&["check", "no/such.fmu", "--probe", "xyz"], 2);
    says(&text, &["\"xyz\"", "library", "locale", "instances", "--probe"]);
    assert!(run(&["check", "no/such.fmu", "--template", "nonsense"], 2).contains("--template"));
    assert!(run(&["check", "no/such.toml", "--probe", "locale"], 2).contains("--probe"));
    assert!(run(&["check", "no/such.toml", "--static"], 2).contains("--static"));
    run(&["check", "no/such.fmu", "--static", "--probe", "locale"], 2);
}

#[test]
fn a_reader_that_goes_away_changes_no_status() {
    let status = |arguments: &[&str]| {
        let (reader, writer) = std::io::pipe().unwrap();
        drop(reader);
        let mut command = crate::heliotorque(arguments);
        command.stdout(writer.try_clone().unwrap()).stderr(writer).status().unwrap().code()
    };
    assert_eq!(status(&["new", "--schema", "spacecraft"]), Some(0));
    assert_eq!(status(&["run", "no/such.fmu"]), Some(2));
    let Some((_room, fmu)) = crate::packed("Empty") else { return };
    assert_eq!(status(&["run", shown(&fmu), "--log"]), Some(0));
}

#[test]
fn shells_complete_commands_and_options() {
    for (shell, begin) in
        [("bash", "_heliotorque()"), ("zsh", "#compdef heliotorque"), ("fish", "function __fish_heliotorque")]
    {
        let script = run(&["completions", shell], 0);
        assert!(script.contains(begin), "{shell}: {script}");
        for part in [
            "info",
            "draw",
            "perspective",
            "compare",
            "tornado",
            "pack",
            "per-plate",
            "coefficients",
            "timeline",
        ] {
            assert!(script.contains(part), "{shell}: {script} lacks {part}");
        }
        assert!(!script.contains("in-child"), "{shell}: a hidden command shows");
        // The shell itself reads it, where it is installed.
        let scratch = tempfile::tempdir().unwrap();
        let file = scratch.path().join("script");
        std::fs::write(&file, &script).unwrap();
        let read = std::process::Command::new(shell).arg("-n").arg(&file).output();
        assert!(read.is_err() || read.is_ok_and(|it| it.status.success()), "{shell} does not read it");
    }
    run(&["completions", "tcsh"], 2);
}

/// Texts whose commands are copied into a shell.
fn texts_with_commands(folder: &std::path::Path) -> Vec<String> {
    let mut texts = Vec::new();
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            texts.extend(texts_with_commands(&path));
        } else if path.extension().is_some_and(|extension| extension == "md") {
            texts.push(std::fs::read_to_string(path).unwrap());
        }
    }
    texts
}

#[test]
fn every_shell_takes_the_commands_of_readme_and_guide() {
    let mut texts = texts_with_commands(std::path::Path::new("../../docs/src"));
    texts.push(std::fs::read_to_string("../../README.md").unwrap());
    let mut commands = 0;
    for block in texts.iter().flat_map(|text| text.split("```").skip(1).step_by(2)) {
        let is_console = block.starts_with("console\n");
        let is_shell = block.contains("\nheliotorque ") || block.contains("\ncargo ");
        for line in block.lines().skip(1) {
            // What a console prints is no command.
            let typed = if is_console { line.strip_prefix("$ ") } else { is_shell.then_some(line) };
            let Some(line) = typed else { continue };
            commands += 1;
            // Outside of quotes: what zsh expands, and remarks, which it does not take from a terminal.
            let bare: String = line.split('\'').step_by(2).collect();
            assert!(!bare.contains(['[', ']', '*', '?', '#', '~', '^', '(', ')']), "{line}");
            assert!(line.matches('\'').count() % 2 == 0, "{line}");
        }
    }
    assert!(commands > 60, "{commands}");
}

#[test]
fn every_command_and_flag_has_help() {
    let all = run(&["--help"], 0);
    for command in ["info", "check", "run", "wire", "draw", "map", "pack", "compare", "plot"] {
        assert!(all.contains(command), "{command}");
        let help = run(&[command, "--help"], 0);
        let flags: Vec<&str> = help.lines().filter(|line| line.trim_start().starts_with('-')).collect();
        assert!(!flags.is_empty());
        for flag in flags {
            // A flag and its help stand apart by two spaces.
            assert!(flag.trim().contains("  "), "{command}: {flag}");
        }
    }
    assert!(!all.contains("-in-child"), "a hidden command shows");
    // By hand a child says who starts it.
    let output = crate::heliotorque(&["in-child"]).stdin(std::process::Stdio::null()).output().unwrap();
    let printed = crate::text(&output);
    assert!(printed.contains("a parent process starts this"), "{printed}");
    assert_eq!(output.status.code(), Some(2));
    for earlier in ["run-in-child", "probe-in-child", "sweep-in-child", "assemble"] {
        assert!(run(&[earlier], 2).contains("unrecognized subcommand"), "{earlier}");
    }
    assert!(run(&["new", "--schema", "spacecraft"], 0).trim_start().starts_with('{'));
    assert!(run(&["new", "--schema", "timeline"], 0).contains("heliotorque timeline"));
}

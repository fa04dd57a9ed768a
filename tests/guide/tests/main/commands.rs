//! Commands in the guide and the README exist, with their options.

use std::collections::BTreeMap;
use std::fs;
use std::process::Command;

use heliotorque_guide::project;

use crate::markdown;

/// Options of `ephemeris` that only a build with the feature `spk` has.
const WITH_SPK: &[&str] = &["--kernel", "--center", "--spacecraft"];

/// What the program prints; `cargo xtask test` says where it is.
pub fn heliotorque(arguments: &[&str]) -> String {
    let program =
        std::env::var_os("HELIOTORQUE").expect("HELIOTORQUE: the program, set by `cargo xtask test`");
    let output = Command::new(program).args(arguments).output().unwrap();
    assert!(output.status.success(), "{arguments:?}");
    String::from_utf8(output.stdout).unwrap()
}

/// Commands that `--help` does not list, but the guide has.
const HIDDEN: [&str; 2] = ["completions", "man"];

/// The subcommands that `--help` lists in its groups, and the hidden ones.
pub fn subcommands() -> Vec<String> {
    let help = heliotorque(&["--help"]);
    let (_, groups) = help.split_once("\nAny FMU:\n").unwrap();
    let (groups, _) = groups.split_once("\nOptions:\n").unwrap();
    let rows = groups.lines().filter_map(|line| line.strip_prefix("  "));
    rows.filter_map(|row| row.split(' ').next()).chain(HIDDEN).map(str::to_owned).collect()
}

fn listed(help: &str) -> Vec<String> {
    let Some((_, list)) = help.split_once("Commands:\n") else { return Vec::new() };
    let first = |line: &str| line.split_whitespace().next().map(str::to_owned);
    let names = list.lines().take_while(|line| !line.is_empty()).filter(|line| line.starts_with("  "));
    names.filter(|line| !line.starts_with("    ")).filter_map(first).filter(|name| name != "help").collect()
}

/// Words of a command line as a shell takes them: quotes of both kinds.
fn words(line: &str) -> Vec<String> {
    let mut words = vec![String::new()];
    let mut quote = None;
    for c in line.chars() {
        match (quote, c) {
            (None, '\'' | '"') => quote = Some(c),
            (Some(open), c) if c == open => quote = None,
            (None, c) if c.is_whitespace() => words.push(String::new()),
            (_, c) => words.last_mut().unwrap().push(c),
        }
    }
    words.retain(|word| !word.is_empty());
    words
}

#[test]
fn every_command_exists_with_its_options() {
    let mut help: BTreeMap<Vec<String>, String> = BTreeMap::new();
    let top = subcommands();
    let mut texts = markdown::files(&project().join("docs").join("src"));
    texts.push(project().join("README.md"));
    texts.push(project().join("examples").join("README.md"));
    let mut checked = 0;
    for path in texts {
        for line in markdown::commands(&fs::read_to_string(&path).unwrap()) {
            let words = words(&line);
            // What follows a pipe or a redirection is the shell's.
            let end = words.iter().position(|word| ["|", ">", "<", "&&", "2>"].contains(&word.as_str()));
            let words = &words[1..end.unwrap_or(words.len())];
            let place = format!("{}: {line}", path.display());
            assert!(words.first().is_some_and(|first| top.contains(first) || first == "--help"), "{place}");
            if words[0] == "--help" {
                continue;
            }
            let mut command = vec![words[0].clone()];
            let mut read = |command: &Vec<String>| {
                let found = help.entry(command.clone()).or_insert_with(|| {
                    let mut arguments: Vec<&str> = command.iter().map(String::as_str).collect();
                    arguments.push("--help");
                    heliotorque(&arguments)
                });
                found.clone()
            };
            let mut text = read(&command);
            let below = listed(&text);
            if let Some(second) = words.get(1).filter(|second| below.contains(second)) {
                command.push(second.clone());
                text = read(&command);
            }
            for option in words.iter().filter(|word| word.starts_with('-') && word.len() > 1) {
                let name = option.split('=').next().unwrap();
                if name[1..].starts_with(|c: char| c.is_ascii_digit()) {
                    continue;
                }
                if command[0] == "ephemeris" && WITH_SPK.contains(&name) {
                    continue;
                }
                let known = text.lines().any(|row| {
                    let flags = row.trim_start().split("  ").next().unwrap_or_default();
                    row.trim_start().starts_with('-') && flags.split([' ', ',']).any(|flag| flag == name)
                });
                assert!(known, "{place}: {name}");
            }
            checked += 1;
        }
    }
    assert!(checked > 60, "{checked}");
}

//! Words and keys of a timeline are items and names of Guidance's variables.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use physics::guidance::timeline::Timeline;

fn variables(file: &str) -> String {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../models/src/guidance/variables");
    fs::read_to_string(folder.join(file)).unwrap()
}

/// The items of an enumeration in the source, without those that a timeline leaves out by not naming the key.
fn items(source: &str, enumeration: &str) -> BTreeSet<String> {
    let (_, rest) = source.split_once(&format!("\n    {enumeration}(")).expect(enumeration);
    let (body, _) = rest.split_once("\n    }").unwrap();
    let lines = body.lines().filter(|line| line.contains("=>"));
    lines.map(|line| line.split_whitespace().next().unwrap().to_owned()).collect()
}

/// The names of a group's inputs in the source.
fn inputs(source: &str, group: &str) -> BTreeSet<String> {
    let (_, rest) = source.split_once(&format!("pub struct {group} {{")).expect(group);
    let (body, _) = rest.split_once("\n}").unwrap();
    let fields =
        body.split("#[").filter(|field| field.starts_with("input") || field.starts_with("parameter"));
    let name = |field: &str| {
        let name = field.split_once("pub ").unwrap().1.split(':').next().unwrap().to_owned();
        // Each axis has a variable of its own where FMI has no vectors.
        let name =
            ["_x", "_y", "_z"].iter().find_map(|axis| name.strip_suffix(axis)).unwrap_or(&name).to_owned();
        let mut words = name.split('_');
        let first = words.next().unwrap().to_owned();
        words.fold(first, |name, word| name + &word[..1].to_uppercase() + &word[1..])
    };
    fields.map(name).collect()
}

/// What is allowed where a file has a word or key that nobody knows.
fn allowed(text: &str) -> BTreeSet<String> {
    let error = Timeline::from_toml("t.toml", text, &[]).unwrap_err();
    let unknown = |found: &str| found.contains("unknown") && found.contains("zzzzzzzzzzzzzzzz");
    let problem = error.problems.iter().find(|problem| unknown(&problem.found)).expect(text);
    problem.allowed.split(", ").map(str::to_owned).collect()
}

#[test]
fn words_are_the_items() {
    let choices = variables("choices.rs");
    for (enumeration, place) in [
        ("PointingScenario", "scenario = WORD"),
        ("BoresightOption", "boresight = { option = WORD }"),
        ("AimpointOption", "aimpoint = { option = WORD }"),
        ("AimpointOption", "secondAimpoint = { option = WORD }"),
        ("AimpointBody", "aimpoint = { option = \"body\", body = WORD }"),
        ("BodyRollOption", "bodyRoll = { option = WORD }"),
        ("ExternalRollOption", "externalRoll = { option = WORD }"),
        ("AzimuthReference", "limb = { reference = WORD }"),
        ("AzimuthReference", "scan = { frame = \"body\", reference = WORD }"),
        ("ScanFrame", "scan = { frame = WORD }"),
        ("ModeRequest", "mode = WORD"),
    ] {
        let text = format!("[[command]]\nat = 0\n{place}\n").replace("WORD", "\"zzzzzzzzzzzzzzzz\"");
        assert_eq!(allowed(&text), items(&choices, enumeration), "{enumeration}");
    }
}

#[test]
fn keys_are_the_inputs() {
    let (commands, limits) = (variables("commands.rs"), variables("limits.rs"));
    for (source, group, table) in [
        (&commands, "BoresightVariables", "boresight"),
        (&commands, "AimpointVariables", "aimpoint"),
        (&commands, "AimpointVariables", "secondAimpoint"),
        (&commands, "BodyRollVariables", "bodyRoll"),
        (&commands, "ExternalRollVariables", "externalRoll"),
        (&commands, "LimbVariables", "limb"),
        (&commands, "ScanVariables", "scan"),
        (&limits, "KeepInVariables", "keepIn"),
    ] {
        let found = allowed(&format!("[[command]]\nat = 0\n{table} = {{ zzzzzzzzzzzzzzzz = 1 }}\n"));
        let mut expected = inputs(source, group);
        if table == "keepIn" {
            // What a command can change.
            expected.retain(|name| ["enabled", "azimuth", "elevation"].contains(&name.as_str()));
        }
        assert_eq!(found, expected, "{table}");
    }
}

//! Words and keys of a timeline are items and names of Guidance's variables.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use physics::bodies::Body;
use physics::enumeration::Enumerated;
use physics::guidance::geometry::lvlh::AzimuthReference;
use physics::guidance::modes::mode::Mode;
use physics::guidance::pointing::command::{
    AimpointOption, BodyRollOption, BoresightOption, ExternalRollOption, ScanFrame, Scenario,
};
use physics::guidance::timeline::Timeline;
use physics::spacecraft::{MESSENGER_TOML, Spacecraft};

fn variables(file: &str) -> String {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../fmu-src/models/src/guidance/variables");
    fs::read_to_string(folder.join(file)).unwrap()
}

fn messenger() -> Spacecraft {
    Spacecraft::from_toml("messenger.toml", MESSENGER_TOML).unwrap()
}

/// The names of an enumeration's items.
fn items<E: Enumerated>() -> BTreeSet<String> {
    E::ITEMS.iter().map(|item| item.name.to_owned()).collect()
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

/// The words allowed where a file has a word or key that nobody knows.
fn allowed(text: &str) -> BTreeSet<String> {
    let error = Timeline::from_toml("t.toml", text, &messenger()).unwrap_err();
    let unknown = |found: &str| found.contains("unknown") && found.contains("zzzzzzzzzzzzzzzz");
    let problem = error.problems.iter().find(|problem| unknown(&problem.found)).expect(text);
    problem.allowed.split(", ").map(str::to_owned).collect()
}

#[test]
fn words_are_the_items() {
    for (items, place) in [
        (items::<Scenario>(), "scenario = WORD"),
        (items::<BoresightOption>(), "boresight = { option = WORD }"),
        (items::<AimpointOption>(), "aimpoint = { option = WORD }"),
        (items::<AimpointOption>(), "secondAimpoint = { option = WORD }"),
        (items::<Body>(), "aimpoint = { option = \"body\", body = WORD }"),
        (items::<BodyRollOption>(), "bodyRoll = { option = WORD }"),
        (items::<ExternalRollOption>(), "externalRoll = { option = WORD }"),
        (items::<AzimuthReference>(), "limb = { reference = WORD }"),
        (items::<AzimuthReference>(), "scan = { frame = \"body\", reference = WORD }"),
        (items::<ScanFrame>(), "scan = { frame = WORD }"),
        (items::<Mode>(), "mode = WORD"),
    ] {
        let text = format!("[[command]]\nat = 0\n{place}\n").replace("WORD", "\"zzzzzzzzzzzzzzzz\"");
        assert_eq!(allowed(&text), items, "{place}");
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

//! A loop that is wired means what it says: options that read the connected inputs, the same thruster sets on both sides.

use fmi::{Fmu, Value};
use model_description::DefaultExperiment;
use systems::{System, Wired, Wiring, to_parameter_set, to_xml, wire};

use crate::support::{description, fmu, write};

const SOURCES: &str = r#"<Item name="guided" value="1"/><Item name="commanded" value="2"/><Item name="controlled" value="3"/><Item name="free" value="4"/>"#;
const CONTROLS: &str = r#"<Item name="angle" value="1"/><Item name="command" value="2"/>"#;

/// Gives commands and a panel's offset.
fn guidance(items: &str) -> String {
    let outputs = [
        "output command.q[1] Real unit=\"m\"",
        "output command.q[2] Real unit=\"m\"",
        "output panel[2].sunOffset Real unit=\"rad\"",
        "output thrust.request Enumeration declaredType=\"Colour\"",
    ];
    description("Guidance", items, &outputs)
}

/// A plant whose attitude comes from this item.
fn plant(source: u32) -> String {
    let option = format!("parameter attitude.source Enumeration declaredType=\"Colour\" start=\"{source}\"");
    let inputs = [
        "input command.q[1] Real unit=\"m\" start=\"0\"",
        "input command.q[2] Real unit=\"m\" start=\"0\"",
        &option,
    ];
    description("Plant", SOURCES, &inputs)
}

fn components(folder: &std::path::Path, guidance: &str, plant: &str) -> [(String, Fmu); 2] {
    [("guidance", guidance), ("plant", plant)].map(|(name, text)| {
        let path = folder.join(format!("{name}.fmu"));
        std::fs::write(&path, fmu(text)).unwrap();
        (name.to_owned(), Fmu::open(path).unwrap())
    })
}

fn wired(components: &[(String, Fmu)], sets: &[&str]) -> Wired {
    let sets = sets.iter().map(|set| (*set).to_owned()).collect();
    wire("Loop", components, DefaultExperiment::default(), &Wiring { sets, ..Wiring::default() }).unwrap()
}

#[test]
fn connected_commands_are_followed_unless_another_source_is_given() {
    let folder = tempfile::tempdir().unwrap();
    let of = |source| components(folder.path(), &guidance(SOURCES), &plant(source));
    let guided = wired(&of(1), &[]);
    assert_eq!(guided.implied, ["plant.attitude.source=commanded"]);
    assert!(guided.unread.is_empty(), "{:?}", guided.unread);
    let set = to_parameter_set(&guided.structure.components[1].bindings[0].sets[0]);
    assert!(set.contains("name=\"attitude.source\"><ssv:Enumeration value=\"commanded\"/>"), "{set}");
    // Given on the command line, or by the FMU's own start value.
    assert!(wired(&of(1), &["plant.attitude.source=controlled"]).implied.is_empty());
    assert!(wired(&of(3), &[]).implied.is_empty());
    for (source, sets) in [(4, &[][..]), (1, &["plant.attitude.source=free"])] {
        let free = wired(&of(source), sets);
        assert!(free.implied.is_empty());
        let message: Vec<String> = free.unread.iter().map(ToString::to_string).collect();
        assert_eq!(
            message,
            [
                "plant: connected and not read: command.q: found attitude.source at free, allowed: commanded, controlled"
            ]
        );
    }
    // Without connections nothing is implied.
    assert!(wired(&of(1)[1..], &[]).implied.is_empty());
}

#[test]
fn an_opened_system_names_what_it_connects_in_vain() {
    let folder = tempfile::tempdir().unwrap();
    let panel = description(
        "Plant",
        CONTROLS,
        &[
            "input panel[2].sunOffsetCommand Real unit=\"rad\" start=\"0\"",
            "parameter panel[2].control Enumeration declaredType=\"Colour\" start=\"1\"",
        ],
    );
    let both = components(folder.path(), &guidance(SOURCES), &panel);
    let wired = wired(&both, &[]);
    assert_eq!(wired.unread[0].option, "panel[2].control");
    let path = write(folder.path(), &to_xml(&wired.structure), &both);
    let system = System::open(path).unwrap();
    assert_eq!(system.unread(&[]), wired.unread);
    let set = |number| [("plant.panel[2].control".to_owned(), Value::Integer(number))];
    assert!(system.unread(&set(2)).is_empty());
    assert_eq!(system.unread(&set(1)).len(), 1);
}

#[test]
fn thrusters_are_requested_from_the_same_sets_alone() {
    let folder = tempfile::tempdir().unwrap();
    let sets = |names: [&str; 2]| {
        let item = |(k, name): (usize, &&str)| format!("<Item name=\"{name}\" value=\"{k}\"/>");
        names.iter().enumerate().map(item).collect::<String>()
    };
    let takes = |names| {
        description(
            "Plant",
            &sets(names),
            &["input thrust.request Enumeration declaredType=\"Colour\" start=\"0\""],
        )
    };
    let same = components(folder.path(), &guidance(&sets(["none", "main"])), &takes(["none", "main"]));
    assert_eq!(wired(&same, &[]).structure.connections.len(), 1);
    let other = components(folder.path(), &guidance(&sets(["none", "lva"])), &takes(["none", "main"]));
    let refused =
        wire("Loop", &other, DefaultExperiment::default(), &Wiring::default()).unwrap_err().to_string();
    assert!(refused.contains("guidance has none (0), lva (1), plant has none (0), main (1)"), "{refused}");
    let wiring = Wiring { without_enumerations: true, ..Wiring::default() };
    assert!(
        wire("Loop", &other, DefaultExperiment::default(), &wiring).unwrap().structure.connections.is_empty()
    );
}

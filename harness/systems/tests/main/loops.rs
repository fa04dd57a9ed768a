//! A loop that is wired means what it says: options that read the connected inputs, enumerations with equal items.

use fmi::{Fmu, Value};
use model_description::DefaultExperiment;
use systems::{System, Wired, Wiring, to_parameter_set, to_xml, wire};

use crate::support::{description, fmu, write};

const SOURCES: &str = r#"<Item name="guided" value="1"/><Item name="commanded" value="2"/><Item name="controlled" value="3"/><Item name="free" value="4"/>"#;
const CONTROLS: &str = r#"<Item name="angle" value="1"/><Item name="command" value="2"/>"#;

/// Gives commands and a flap's offset.
fn guidance(items: &str) -> String {
    let outputs = [
        "output wish[1] Real unit=\"m\"",
        "output wish[2] Real unit=\"m\"",
        "output flap[2].offset Real unit=\"rad\"",
        "output engine Enumeration declaredType=\"Colour\"",
    ];
    description("Guidance", items, &outputs)
}

/// A plant that reads wishes where `mode` stands at two of its items, and otherwise lets `wire` set this one.
fn plant(mode: u32, set: &str) -> String {
    let option = format!("parameter mode Enumeration declaredType=\"Colour\" start=\"{mode}\"");
    let input = |index: u32| {
        format!(
            "input wish[{index}] Real unit=\"m\" start=\"0\" | <Variable><ReadWhere option=\"mode\" items=\"commanded 3\"{set}/></Variable>"
        )
    };
    description("Plant", SOURCES, &[&input(1), &input(2), &option])
}

const SET: &str = " set=\"commanded\"";

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
    let of = |mode| components(folder.path(), &guidance(SOURCES), &plant(mode, SET));
    let guided = wired(&of(1), &[]);
    assert_eq!(guided.implied, ["plant.mode=commanded"]);
    assert!(guided.unread.is_empty(), "{:?}", guided.unread);
    let set = to_parameter_set(&guided.structure.components[1].bindings[0].sets[0]);
    assert!(set.contains("name=\"mode\"><ssv:Enumeration value=\"commanded\"/>"), "{set}");
    // Given on the command line, or by the FMU's own start value.
    assert!(wired(&of(1), &["plant.mode=controlled"]).implied.is_empty());
    assert!(wired(&of(3), &[]).implied.is_empty());
    let chosen = components(folder.path(), &guidance(SOURCES), &plant(4, ""));
    for (components, sets) in [(chosen, &[][..]), (of(1), &["plant.mode=free"])] {
        let free = wired(&components, sets);
        assert!(free.implied.is_empty());
        let message: Vec<String> = free.unread.iter().map(ToString::to_string).collect();
        assert_eq!(
            message,
            ["plant: connected and not read: wish: found mode at free, allowed: commanded, controlled"]
        );
    }
    // Without connections nothing is implied.
    assert!(wired(&of(1)[1..], &[]).implied.is_empty());
}

#[test]
fn an_opened_system_names_what_it_connects_in_vain() {
    let folder = tempfile::tempdir().unwrap();
    let flap = description(
        "Plant",
        CONTROLS,
        &[
            "input flap[2].wish Real unit=\"rad\" start=\"0\" | <Variable alsoCalled=\"flap[2].offset\">\
             <ReadWhere option=\"flap[2].control\" items=\"command\"/></Variable>",
            "parameter flap[2].control Enumeration declaredType=\"Colour\" start=\"1\"",
        ],
    );
    let both = components(folder.path(), &guidance(SOURCES), &flap);
    let wired = wired(&both, &[]);
    assert_eq!(wired.unread[0].option, "flap[2].control");
    let path = write(folder.path(), &to_xml(&wired.structure), &both);
    let system = System::open(path).unwrap();
    assert_eq!(system.unread(&[]), wired.unread);
    let set = |number| [("plant.flap[2].control".to_owned(), Value::Integer(number))];
    assert!(system.unread(&set(2)).is_empty());
    assert_eq!(system.unread(&set(1)).len(), 1);
}

#[test]
fn enumerations_join_where_their_items_agree() {
    let folder = tempfile::tempdir().unwrap();
    let sets = |names: [&str; 2]| {
        let item = |(k, name): (usize, &&str)| format!("<Item name=\"{name}\" value=\"{k}\"/>");
        names.iter().enumerate().map(item).collect::<String>()
    };
    let takes = |names| {
        description("Plant", &sets(names), &["input engine Enumeration declaredType=\"Colour\" start=\"0\""])
    };
    let same = components(folder.path(), &guidance(&sets(["none", "main"])), &takes(["none", "main"]));
    assert_eq!(wired(&same, &[]).structure.connections.len(), 1);
    let other = components(folder.path(), &guidance(&sets(["none", "lva"])), &takes(["none", "main"]));
    let open = wired(&other, &[]);
    assert!(open.structure.connections.is_empty());
    let expected = "other items: lva (1) of the output is none of none (0), main (1)";
    assert_eq!((open.left[0].input.as_str(), open.left[0].why.as_str()), ("engine", expected));
    let wiring = Wiring { without_enumerations: true, ..Wiring::default() };
    let open = wire("Loop", &same, DefaultExperiment::default(), &wiring).unwrap();
    assert!(open.structure.connections.is_empty());
}

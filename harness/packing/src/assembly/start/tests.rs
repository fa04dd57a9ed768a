//! What is written wins, and the rest of the file stays.

use model_description::{Annotation, RealAttributes, VariableRole};

use super::*;

fn description() -> Description {
    let variables = ["ship.mass", "arm[1]", "arm[2]"].map(|name| {
        format!(
            "<ScalarVariable name=\"{name}\" valueReference=\"0\" causality=\"parameter\" variability=\"tunable\">\
             <Real start=\"0\" max=\"9\"/></ScalarVariable>"
        )
    });
    let xml = format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?><fmiModelDescription fmiVersion=\"2.0\" modelName=\"Ship\" guid=\"g\">\
         <ModelVariables>{}</ModelVariables><ModelStructure/></fmiModelDescription>",
        variables.concat()
    );
    model_description::parse(xml.as_bytes()).unwrap().description
}

fn epoch() -> Option<Box<Annotation>> {
    Some(Box::new(Annotation { role: Some(VariableRole::Epoch), ..Annotation::default() }))
}

fn written(text: &str, sets: &[&str]) -> String {
    with_values(text, START, "Plant", &description(), &settings(sets)).unwrap()
}

fn settings(sets: &[&str]) -> Vec<(String, String)> {
    sets.iter().map(|set| (format!("--set {set}"), (*set).to_owned())).collect()
}

#[test]
fn the_table_is_made_or_added_to() {
    let rest = "# mine\nname = \"A\" # say\n[mass]\nkg = 1\n";
    let made = written(rest, &["ship.mass=2", "arm=1,2.5"]);
    assert_eq!(made, format!("{rest}\n[start]\n\"ship.mass\" = 2.0\n\"arm[1]\" = 1.0\n\"arm[2]\" = 2.5\n"));
    let added = written("[start] # here\n\"ship.mass\" = 1 # old\n[mass]\n", &["ship.mass=2", "arm[2]=3"]);
    assert_eq!(added, "[start] # here\n\"ship.mass\" = 2.0 # old\n\"arm[2]\" = 3.0\n[mass]\n");
    assert_eq!(written("[start]\n", &["arm=3"]), "[start]\n\"arm[1]\" = 3.0\n\"arm[2]\" = 3.0\n");
    let inline = written("start = { \"ship.mass\" = 1 }\n", &["ship.mass=2"]);
    assert_eq!(inline, "start = { \"ship.mass\" = 2.0 }\n");
    assert_eq!(written("\u{feff}name = \"A\"\n", &[]), "\u{feff}name = \"A\"\n");
}

#[test]
fn an_epoch_takes_a_date() {
    let mut description = description();
    let start = &mut description.variables[0];
    start.name = "start.epoch".to_owned();
    start.annotation = epoch();
    if let VariableKind::Real { attributes, .. } = &mut start.kind {
        *attributes = RealAttributes { unit: Some("s".to_owned()), ..RealAttributes::default() };
    }
    let written = |set: &str| with_values("", START, "Plant", &description, &settings(&[set]));
    let text = written("Start.Epoch=2009-04-06 TDB").unwrap();
    assert_eq!(text, "[start]\n\"start.epoch\" = 292248000.0\n");
    let refused = written("start.epoch=2009-04-06").unwrap_err().to_string();
    assert!(refused.contains("does not end in UTC, Z, TDB, TT or TAI"), "{refused}");
}

#[test]
fn a_time_takes_a_date_that_counts_from_the_epoch_set_beside_it() {
    let mut description = description();
    for (variable, name) in description.variables.iter_mut().zip(["start.epoch", "burn.start", "arm[2]"]) {
        variable.name = name.to_owned();
        if let VariableKind::Real { attributes, .. } = &mut variable.kind {
            *attributes = RealAttributes { unit: Some("s".to_owned()), ..RealAttributes::default() };
        }
    }
    description.variables[0].annotation = epoch();
    let written = |sets: &[&str]| with_values("", START, "Plant", &description, &settings(sets));
    let text = written(&["burn.start=2009-04-06T02:00:00 TDB", "start.epoch=2009-04-06 TDB"]).unwrap();
    assert_eq!(text, "[start]\n\"burn.start\" = 7200.0\n\"start.epoch\" = 292248000.0\n");
    // Its own start value is J2000.
    assert_eq!(
        written(&["burn.start=2000-01-02T12:00:00 TDB"]).unwrap(),
        "[start]\n\"burn.start\" = 86400.0\n"
    );
    let refused = written(&["burn.start=2009-04-06"]).unwrap_err().to_string();
    assert!(refused.contains("does not end in UTC, Z, TDB, TT or TAI"), "{refused}");
    description.variables[0].annotation = None;
    let refused = with_values("", START, "Plant", &description, &settings(&["burn.start=2009-04-06 TDB"]));
    let refused = refused.unwrap_err().to_string();
    assert!(refused.contains("no epoch of the start"), "{refused}");
}

#[test]
fn dates_of_times_are_found_in_both_tables() {
    let has = |text: &str| has_dates(text);
    assert!(has("[start]\n\"burn.start\" = \"2009-04-06 TDB\""));
    assert!(has("[start.Guidance]\n\"guided.downlinkEnd\" = \"2009-04-06 TDB\""));
    assert!(has("[fixed]\n\"guided.downlinkStart\" = \"2009-04-06 TDB\""));
    assert!(!has("[start]\n\"start.epoch\" = \"2009-04-06 TDB\"\n\"burn.start\" = \"2 h\""));
}

#[test]
fn a_table_for_the_model_alone_is_the_one_that_counts() {
    let text = "[start]\n\"ship.mass\" = 1\n[start.Plant]\n\"ship.mass\" = 3\n";
    assert_eq!(
        written(text, &["ship.mass=2"]),
        "[start]\n\"ship.mass\" = 1\n[start.Plant]\n\"ship.mass\" = 2.0\n"
    );
    let other = "[start.Other]\n\"ship.mass\" = 3\n";
    let with_both = written(other, &["ship.mass=2"]);
    let read: toml::Table = with_both.parse().unwrap();
    assert_eq!(read["start"]["ship.mass"].as_float(), Some(2.0), "{with_both}");
    assert_eq!(read["start"]["Other"]["ship.mass"].as_integer(), Some(3), "{with_both}");
}

#[test]
fn what_no_variable_takes_is_refused() {
    for (set, expected) in [
        ("ship.mas=1", "near it: ship.mass"),
        ("ship.mass=10", "ship.mass: found 10, allowed: a number up to 9"),
        ("arm=1,2,3", "3 values given for its 2 elements"),
        ("ship.mass", "name=value"),
    ] {
        let refused = with_values("", START, "Plant", &description(), &settings(&[set])).unwrap_err();
        let text = refused.to_string();
        assert!(text.contains(expected) && text.contains("--set"), "{set}: {text}");
    }
}

//! Altitudes at which air counts, from elements and states, of a plant alone and within a system.

use super::*;

fn description(prefix: &str, more: &str) -> Description {
    let real = |number: u32, name: &str, start: f64| {
        format!(
            "<ScalarVariable name=\"{prefix}{name}\" valueReference=\"{number}\" causality=\"parameter\" variability=\"fixed\">\
             <Real start=\"{start}\"/></ScalarVariable>"
        )
    };
    let option = |number: u32, name: &str, declared: &str| {
        format!(
            "<ScalarVariable name=\"{prefix}{name}\" valueReference=\"{number}\" causality=\"parameter\" variability=\"fixed\">\
             <Enumeration declaredType=\"{declared}\" start=\"1\"/></ScalarVariable>"
        )
    };
    let variables = [
        option(1, "orbit.center", "Center"),
        option(2, "orbit.source", "Source"),
        real(3, "orbit.semiMajorAxis", 10_136_500.0),
        real(4, "orbit.eccentricity", 0.74),
        (1..=3).map(|k| real(4 + k, &format!("orbit.position[{k}]"), 0.0)).collect(),
        (1..=3).map(|k| real(7 + k, &format!("orbit.velocity[{k}]"), 0.0)).collect(),
    ];
    let xml = format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?><fmiModelDescription fmiVersion=\"2.0\" modelName=\"Plant\" guid=\"g\">\
         <CoSimulation modelIdentifier=\"Plant\"/><TypeDefinitions><SimpleType name=\"Center\"><Enumeration>\
         <Item name=\"mercury\" value=\"1\"/><Item name=\"earth\" value=\"4\"/></Enumeration></SimpleType>\
         <SimpleType name=\"Source\"><Enumeration><Item name=\"elements\" value=\"1\"/><Item name=\"inputs\" value=\"2\"/>\
         <Item name=\"held\" value=\"3\"/></Enumeration></SimpleType></TypeDefinitions><ModelVariables>{}{more}\
         </ModelVariables><ModelStructure/></fmiModelDescription>",
        variables.concat()
    );
    model_description::parse(xml.as_bytes()).unwrap().description
}

#[test]
fn low_orbits_of_the_earth_alone_are_reported() {
    let plant = description("", "");
    let earth = ("orbit.center".to_owned(), Value::Integer(4));
    let axis = |axis_m: f64| ("orbit.semiMajorAxis".to_owned(), Value::Real(axis_m));
    let e = |eccentricity: f64| ("orbit.eccentricity".to_owned(), Value::Real(eccentricity));
    let source = |item: i32| ("orbit.source".to_owned(), Value::Integer(item));
    let position = ("orbit.position[1]".to_owned(), Value::Real(7.0e6));
    // Faster than a circle: this is the periapsis.
    let velocity = ("orbit.velocity[2]".to_owned(), Value::Real(8000.0));
    for (sets, altitude_km) in [
        (vec![], None),
        (vec![axis(7.0e6), e(0.0)], None),
        (vec![earth.clone()], None),
        (vec![earth.clone(), axis(7.0e6), e(0.0)], Some(629)),
        (vec![earth.clone(), axis(7.0e6)], Some(629)),
        (vec![earth.clone(), axis(7.5e6), e(0.0)], None),
        (vec![earth.clone(), axis(26.6e6), e(0.74)], Some(545)),
        (vec![earth.clone(), source(3), position.clone()], Some(629)),
        (vec![earth.clone(), source(3)], None),
        (vec![earth.clone(), source(2), position, velocity], Some(629)),
    ] {
        let found = warnings(&plant, &sets);
        let expected = altitude_km
            .map(|altitude_km| format!("at {altitude_km} km above it: air and magnetism are missing"));
        assert_eq!(found.len(), usize::from(expected.is_some()), "{sets:?}: {found:?}");
        assert!(expected.is_none_or(|expected| found[0].contains(&expected)), "{sets:?}: {found:?}");
    }
}

#[test]
fn what_a_model_has_is_not_missed_and_a_part_of_a_system_is_named() {
    let switch = |name: &str| {
        format!(
            "<ScalarVariable name=\"plant.{name}\" valueReference=\"9{}\" causality=\"parameter\" variability=\"fixed\">\
             <Boolean start=\"false\"/></ScalarVariable>",
            name.len()
        )
    };
    let sets = [
        ("plant.orbit.center".to_owned(), Value::Integer(4)),
        ("plant.orbit.semiMajorAxis".to_owned(), Value::Real(7.0e6)),
    ];
    let found = |more: &str| warnings(&description("plant.", more), &sets);
    assert!(found("")[0].starts_with("plant.orbit.center: the Earth"));
    assert!(found(&switch("aerodynamics.enabled"))[0].contains("magnetism is missing"));
    let both = switch("aerodynamics.enabled") + &switch("magnetics.enabled");
    assert_eq!(found(&both), Vec::<String>::new());
}

//! What is wired, written and read again; units on the way.

use fmi::Fmu;
use model_description::DefaultExperiment;
use systems::{
    ConnectorKind, Linear, System, Wired, Wiring, component_name, read_structure, to_parameter_set, to_xml,
    wire,
};

use crate::support::{ITEMS, Ssd, description, fmu, giver, ssp, taker};

fn opened(folder: &std::path::Path, name: &str, text: &str) -> (String, Fmu) {
    let path = folder.join(format!("{name}.fmu"));
    std::fs::write(&path, fmu(text)).unwrap();
    (name.to_owned(), Fmu::open(&path).unwrap())
}

fn listed(outputs: &[&str]) -> Wiring {
    Wiring { outputs: owned(outputs), ..Wiring::default() }
}

fn owned(texts: &[&str]) -> Vec<String> {
    texts.iter().map(|it| (*it).to_owned()).collect()
}

/// Both FMUs.
fn pair(folder: &std::path::Path) -> [(String, Fmu); 2] {
    [opened(folder, "giver", &giver()), opened(folder, "taker", &taker())]
}

/// Connections, each with its start and end.
fn joined(wired: &Wired) -> Vec<String> {
    wired.structure.connections.iter().map(|it| format!("{} {}", it.start, it.end)).collect()
}

#[test]
fn enumerations_that_are_left_out_say_what_they_stand_at() {
    let folder = tempfile::tempdir().unwrap();
    let components = pair(folder.path());
    let wiring =
        |sets: &[&str]| Wiring { without_enumerations: true, sets: owned(sets), ..Wiring::default() };
    let wired =
        |sets: &[&str]| wire("Pair", &components, DefaultExperiment::default(), &wiring(sets)).unwrap();
    let why =
        |wired: &Wired| wired.left.iter().find(|it| it.input == "colour").map(|it| it.why.clone()).unwrap();
    let plain = wired(&[]);
    assert!(plain.structure.connections.iter().all(|it| it.end.connector != "colour"));
    assert!(plain.structure.enumerations.is_empty());
    assert_eq!(why(&plain), "an enumeration, left out: it stands at none");
    let set = wired(&["taker.colour=red"]);
    assert_eq!(why(&set), "an enumeration, left out: it stands at red");
}

/// A parameter set at the component, in the variables' own units, is what `run` reads back.
#[test]
fn what_is_set_stands_at_the_component_in_its_own_unit() {
    let folder = tempfile::tempdir().unwrap();
    let components = pair(folder.path());
    let wiring = |set: &str| Wiring { sets: vec![set.to_owned()], ..Wiring::default() };
    let wired =
        wire("Pair", &components, DefaultExperiment::default(), &wiring("taker.angle=3.141592653589793 rad"))
            .unwrap();
    let binding = &wired.structure.components[1].bindings[0];
    assert_eq!(binding.source.as_deref(), Some("resources/taker.ssv"));
    let text = to_parameter_set(&binding.sets[0]);
    let half_turn = format!("<ssv:Parameter name=\"angle\"><ssv:Real value=\"{}\"/>", core::f64::consts::PI);
    assert!(text.contains(&half_turn), "{text}");
    assert!(to_xml(&wired.structure).contains("<ssd:ParameterBinding source=\"resources/taker.ssv\"/>"));
    for (set, expected) in [
        ("nobody.angle=1", "allowed: component.name=value of giver, taker"),
        ("angle=1", "found no component"),
        ("taker.angel=1", "angle"),
    ] {
        let refused =
            wire("Pair", &components, DefaultExperiment::default(), &wiring(set)).unwrap_err().to_string();
        assert!(refused.contains(expected) && refused.contains(set), "{set}: {refused}");
    }
}

/// OMSimulator takes the step from its own annotation alone.
#[test]
fn the_step_is_written_for_omsimulator_too() {
    let folder = tempfile::tempdir().unwrap();
    let components = [opened(folder.path(), "giver", &giver())];
    let experiment = DefaultExperiment { step_size: Some(0.25), ..DefaultExperiment::default() };
    let wired = wire("One", &components, experiment, &Wiring::default()).unwrap();
    let text = to_xml(&wired.structure);
    let system = &text[..text.find("</ssd:System>").unwrap()];
    assert!(system.contains("<ssc:Annotation type=\"org.openmodelica\">"), "{text}");
    assert!(system.contains("<oms:FixedStepMaster description=\"oms-ma\" stepSize=\"0.25\""), "{text}");
    assert_eq!(read_structure(text.as_bytes()).unwrap().experiment.step_size, Some(0.25));
}

#[test]
fn equal_names_types_and_units_are_connected_and_the_rest_is_left_with_its_reason() {
    let folder = tempfile::tempdir().unwrap();
    let components = pair(folder.path());
    let wired = wire("Pair", &components, DefaultExperiment::default(), &listed(&["giver.angle"])).unwrap();
    assert_eq!(
        joined(&wired),
        [
            "taker.push giver.push",
            "giver.position[1] taker.position[1]",
            "giver.position[2] taker.position[2]",
            "giver.count taker.count",
            "giver.flag taker.flag",
            "giver.colour taker.colour",
        ]
    );
    let left: Vec<String> = wired.left.iter().map(|it| format!("{}: {}", it.input, it.why)).collect();
    assert_eq!(
        left,
        [
            "angle: other unit: unit \"deg\" to unit \"rad\"",
            "label: other type: String to String",
            "duration: no output of that name",
        ]
    );
    // Connectors are what is connected, and what was requested.
    let of_giver: Vec<&str> =
        wired.structure.components[0].connectors.iter().map(|it| it.name.as_str()).collect();
    assert_eq!(of_giver, ["push", "position[1]", "position[2]", "angle", "count", "flag", "colour"]);
    assert_eq!(wired.structure.experiment.step_size, Some(0.5));
    // What other tools look for: the kind of model, where it is drawn, whose annotation it is.
    let text = to_xml(&wired.structure);
    for (part, count) in [
        (" implementation=\"CoSimulation\">", 2),
        ("<ssd:ElementGeometry x1=\"0\" y1=\"0\"", 1),
        ("<ssd:ElementGeometry x1=\"100\" y1=\"0\"", 1),
        ("<ssc:Annotation type=\"io.github.heliotorque\">", 1),
    ] {
        assert_eq!(text.matches(part).count(), count, "{part}: {text}");
    }
    // What is written is read back; lines alone are new.
    let mut read = read_structure(to_xml(&wired.structure).as_bytes()).unwrap();
    read.components.iter_mut().for_each(|component| {
        component.line = 0;
        component.connectors.iter_mut().for_each(|connector| connector.line = 0);
    });
    read.connections.iter_mut().for_each(|connection| connection.line = 0);
    assert_eq!(read, wired.structure);
}

#[test]
fn inputs_take_outputs_by_the_other_names_that_their_fmu_annotates() {
    let folder = tempfile::tempdir().unwrap();
    let one = description(
        "One",
        ITEMS,
        &[
            "output buoy.place[2] Real unit=\"m\"",
            "output current.speed[1] Real unit=\"m\"",
            "output rudder[7].angle Real unit=\"rad\"",
            // Its own output is no candidate.
            "input stream[1] Real unit=\"m\" start=\"0\" | <Variable alsoCalled=\"current.speed[1]\"/>",
        ],
    );
    let two = description(
        "Two",
        ITEMS,
        &[
            "input mark[2] Real unit=\"m\" start=\"0\" | <Variable alsoCalled=\"buoy.place[2]\"/>",
            "input stream[1] Real unit=\"m\" start=\"0\" | <Variable alsoCalled=\"current.speed[1]\"/>",
            // The name of its own goes first.
            "input rudder[7].angle Real unit=\"rad\" start=\"0\" | <Variable alsoCalled=\"buoy.place[2]\"/>",
            "input mark[3] Real unit=\"m\" start=\"0\"",
        ],
    );
    let components = [opened(folder.path(), "one", &one), opened(folder.path(), "two", &two)];
    let wired = wire("Pair", &components, DefaultExperiment::default(), &Wiring::default()).unwrap();
    assert_eq!(wired.structure.connections.len(), 3);
    let left: Vec<&str> = wired.left.iter().map(|it| it.input.as_str()).collect();
    assert_eq!(left, ["stream[1]", "mark[3]"]);
    // What is written of transformations is read, too.
    let mut structure = wired.structure;
    structure.connections[0].suppress_unit_conversion = true;
    structure.connections[1].transformation = Some(Linear { factor: 0.1, offset: -3e-20 });
    let read = read_structure(to_xml(&structure).as_bytes()).unwrap();
    assert!(read.connections[0].suppress_unit_conversion && !read.connections[1].suppress_unit_conversion);
    assert_eq!(read.connections[1].transformation, structure.connections[1].transformation);
    // The same output twice is no choice of ours.
    let three = opened(folder.path(), "three", &one);
    let [one, two] = components;
    let wired =
        wire("Three", &[one.clone(), two, three], DefaultExperiment::default(), &Wiring::default()).unwrap();
    assert_eq!(
        joined(&wired),
        ["three.current.speed[1] one.stream[1]", "one.current.speed[1] three.stream[1]"]
    );
    assert!(wired.left[0].why.starts_with("two candidates: one.buoy.place[2], three."), "{:?}", wired.left);
    // Names.
    assert_eq!(component_name(std::path::Path::new("dist/MomentumPlant.fmu")), "momentumPlant");
    let twice = wire("Twice", &[one.clone(), one.clone()], DefaultExperiment::default(), &Wiring::default());
    assert!(twice.unwrap_err().to_string().contains("two components are named \"one\""));
    let dotted = wire("Dot", &[("a.b".to_owned(), one.1)], DefaultExperiment::default(), &Wiring::default());
    assert!(dotted.unwrap_err().to_string().contains("\"a.b\""));
}

#[test]
fn units_are_converted_on_the_way() {
    let folder = tempfile::tempdir().unwrap();
    let linear = |name: &str, attribute: &str, holds: &str| -> Option<Linear> {
        let ends =
            format!(r#"startElement="a" startConnector="{name}" endElement="b" endConnector="{name}""#);
        let connections = format!("<ssd:Connection {ends}{attribute}>{holds}</ssd:Connection>").leak();
        let path = ssp(folder.path(), &Ssd { connections, ..Ssd::default() }.text(), &[]);
        System::open(&path).unwrap().joints()[0].linear
    };
    assert!((linear("angle", "", "").unwrap().factor * 180.0 - core::f64::consts::PI).abs() < 1e-15);
    let suppressed = " suppressUnitConversion=\"true\"";
    assert_eq!(linear("angle", suppressed, ""), None);
    let transformed = r#"<ssc:LinearTransformation factor="2" offset="3"/>"#;
    let expected = Linear { factor: 2.0, offset: 3.0 };
    assert_eq!(linear("angle", suppressed, transformed), Some(expected));
    assert_eq!(linear("position[1]", "", ""), None);
}

#[test]
fn the_systems_own_connectors_stand_for_variables_in_their_own_units() {
    let folder = tempfile::tempdir().unwrap();
    let rest = r#"<ssd:Units><ssc:Unit name="km"><ssc:BaseUnit m="1" factor="1000"/></ssc:Unit></ssd:Units>"#;
    let bindings = r#"<ssd:Connectors><ssd:Connector name="aim" kind="input"><ssc:Real unit="km"/></ssd:Connector>
<ssd:Connector name="turn" kind="output"/><ssd:Connector name="size" kind="parameter"/>
<ssd:Connector name="idle" kind="input"/></ssd:Connectors>
<ssd:ParameterBindings><ssd:ParameterBinding><ssd:ParameterValues><ssv:ParameterSet name="own" version="1.0"><ssv:Parameters>
<ssv:Parameter name="aim"><ssv:Real value="3"/></ssv:Parameter>
<ssv:Parameter name="size"><ssv:Real value="4" unit="km"/></ssv:Parameter>
</ssv:Parameters></ssv:ParameterSet></ssd:ParameterValues></ssd:ParameterBinding></ssd:ParameterBindings>"#;
    let giver = r#"<ssd:Connector name="angle" kind="output"/><ssd:Connector name="size" kind="parameter"/>
<ssd:Connector name="push" kind="input"/>"#;
    let connections = r#"<ssd:Connection startConnector="aim" endElement="b" endConnector="position[1]"/>
<ssd:Connection startConnector="aim" endElement="a" endConnector="push"/>
<ssd:Connection startConnector="size" endElement="a" endConnector="size"/>
<ssd:Connection startElement="a" startConnector="angle" endConnector="turn"/>"#;
    let text = Ssd { giver, connections, bindings, rest, ..Ssd::default() }.text();
    let system = System::open(ssp(folder.path(), &text, &[])).unwrap();
    let description = system.description();
    let position = |name: &str| description.variables.iter().position(|it| it.name == name);
    let unit = |name: &str| {
        model_description::value::unit(description, &description.variables[position(name).unwrap()])
    };
    assert_eq!((unit("aim"), unit("turn"), unit("size")), (Some("km"), Some("deg"), Some("m")));
    assert_eq!(position("idle"), None);
    // One number to both inputs, in their unit.
    let places = system.places(position("aim").unwrap());
    assert_eq!(places.iter().map(|place| place.linear.apply(2.0)).collect::<Vec<_>>(), [2000.0, 2000.0]);
    assert_eq!(places[0].at.0, 1);
    assert_eq!(system.places(position("turn").unwrap())[0].linear, Linear::IDENTITY);
    let open = system.open_inputs();
    assert!(!open.contains(&places[0].at) && !open.contains(&places[1].at));
    // Its bindings: in the connector's unit, or in their own.
    let parameters = |number: usize| system.parts()[number].parameters.clone();
    let real = |name: &str, value: f64| (name.to_owned(), fmi::Value::Real(value));
    assert_eq!(parameters(0), [real("push", 3000.0), real("size", 4000.0)]);
    assert_eq!(parameters(1), [real("position[1]", 3000.0)]);
}

#[test]
fn exported_variables_are_connectors_of_the_system() {
    let folder = tempfile::tempdir().unwrap();
    let components = [opened(folder.path(), "one", &giver()), opened(folder.path(), "two", &taker())];
    let exported = |exports: &[&str]| {
        let wiring = Wiring { exports: owned(exports), ..Wiring::default() };
        wire("Pair", &components, DefaultExperiment::default(), &wiring)
    };
    let wired = exported(&["one.angle", "two.duration", "one.size"]).unwrap();
    let kinds: Vec<_> = wired.structure.connectors.iter().map(|it| (it.name.as_str(), it.kind)).collect();
    assert_eq!(
        kinds,
        [
            ("angle", ConnectorKind::Output),
            ("duration", ConnectorKind::Input),
            ("size", ConnectorKind::Parameter)
        ]
    );
    let joined = joined(&wired);
    assert_eq!(joined[joined.len() - 3..], ["one.angle angle", "duration two.duration", "size one.size"]);
    assert!(!wired.left.iter().any(|left| left.input == "duration"));
    let named = exported(&["one.position[2]"]).unwrap().structure.connectors;
    assert_eq!(named.last().map(|it| it.name.as_str()), Some("position_2"));
    for (exports, message) in [
        (&["two.position[1]"][..], "--export two.position[1]: it is connected already"),
        (&["one.angle", "one.angle"], "the system has a connector `angle` already"),
        (&["one.label"], "it is a String"),
    ] {
        let error = exported(exports).unwrap_err().to_string();
        assert!(error.contains(message), "{error}");
    }
}

#[test]
fn the_default_experiment_is_completed_from_the_fmus() {
    let folder = tempfile::tempdir().unwrap();
    let rest = r#"<ssd:DefaultExperiment startTime="2" stopTime="7"><ssd:Annotations>
<ssc:Annotation type="other"><x size="1"/></ssc:Annotation></ssd:Annotations></ssd:DefaultExperiment>"#;
    let system = System::open(ssp(folder.path(), &Ssd { rest, ..Ssd::default() }.text(), &[])).unwrap();
    let times = system.times(None, None, None).unwrap();
    assert_eq!((times.start_s, times.stop_s, times.step_s), (2.0, 7.0, 0.5));
    assert_eq!(times.steps(), 10);
    // All variables in one description, and the inputs that are open.
    let names: Vec<&str> = system.description().variables.iter().map(|it| it.name.as_str()).collect();
    assert!(names.contains(&"a.position[1]") && names.contains(&"b.push"));
    assert_eq!(system.open_inputs().len(), 8);
}

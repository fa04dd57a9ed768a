//! Systems that cannot be simulated are refused by the name of what is wrong.

use fmi::Value;
use systems::System;

use crate::support::{Ssd, description, fmu, ssp, taker};

/// What is reported of a system.
fn refusal(ssd: &str, files: &[(&str, &str)]) -> String {
    let folder = tempfile::tempdir().unwrap();
    let path = ssp(folder.path(), ssd, files);
    fmi::Error::chain(&System::open(&path).expect_err(ssd))
}

const fn written(connections: &'static str) -> Ssd {
    Ssd { connections, ..GOOD }
}

/// Both angles are connected, with an attribute and what the connection holds.
fn turned(attribute: &str, holds: &str) -> Ssd {
    let ends = r#"startElement="a" startConnector="angle" endElement="b" endConnector="angle""#;
    written(format!("<ssd:Connection {ends}{attribute}>{holds}</ssd:Connection>").leak())
}

/// The giver shows one connector.
fn shows(name: &str, kind: &str, holds: &str) -> Ssd {
    Ssd { giver: connector(&(name, kind, holds)).leak(), ..GOOD }
}

fn connector((name, kind, holds): &(&str, &str, &str)) -> String {
    format!(r#"<ssd:Connector name="{name}" kind="{kind}">{holds}</ssd:Connector>"#)
}

/// Connections from start to end: `element.connector`, or a connector of the system's own.
fn wired(pairs: &[(&str, &str)]) -> Ssd {
    let end = |which: &str, at: &str| match at.split_once('.') {
        Some((element, connector)) => format!(r#"{which}Element="{element}" {which}Connector="{connector}""#),
        None => format!(r#"{which}Connector="{at}""#),
    };
    let wire =
        |(from, to): &(&str, &str)| format!("<ssd:Connection {} {}/>\n", end("start", from), end("end", to));
    written(pairs.iter().map(wire).collect::<String>().leak())
}

/// The system's own connectors, with their kinds and what they hold, and connections to them.
fn own(connectors: &[(&str, &str, &str)], pairs: &[(&str, &str)]) -> Ssd {
    let connectors: String = connectors.iter().map(connector).collect();
    Ssd { bindings: format!("<ssd:Connectors>{connectors}</ssd:Connectors>").leak(), ..wired(pairs) }
}

const GOOD: Ssd = Ssd {
    giver: r#"<ssd:Connector name="position[1]" kind="output"><ssc:Real unit="m"/></ssd:Connector>
<ssd:Connector name="angle" kind="output"/><ssd:Connector name="count" kind="output"/>
<ssd:Connector name="colour" kind="output"/><ssd:Connector name="label" kind="output"/>"#,
    taker: r#"<ssd:Connector name="position[1]" kind="input"/><ssd:Connector name="angle" kind="input"/>
<ssd:Connector name="count" kind="input"/><ssd:Connector name="flag" kind="input"/>
<ssd:Connector name="label" kind="input"/><ssd:Connector name="duration" kind="input"/>"#,
    connections: r#"<ssd:Connection startElement="a" startConnector="position[1]" endElement="b" endConnector="position[1]"/>"#,
    bindings: "",
    of_giver: "",
    rest: "",
    source: "resources/giver.fmu",
};

#[test]
fn what_cannot_be_simulated_is_refused_by_name() {
    let cases: Vec<(Ssd, &[&str])> = vec![
        (
            wired(&[("c.angle", "b.angle")]),
            &["connection c.angle to b.angle", "no component \"c\"", "allowed: a, b"],
        ),
        (
            wired(&[("a.angel", "b.angle")]),
            &["connection a.angel to b.angle", "no connector \"angel\"", "near it: angle"],
        ),
        (wired(&[("b.angle", "a.angle")]), &["at its start found b.angle of kind input", "allowed: output"]),
        (wired(&[("a.count", "b.angle")]), &["found type Integer at its start and Real at its end"]),
        (
            wired(&[("a.angle", "b.duration")]),
            &["found unit \"deg\" at its start and \"s\" at its end", "one dimension"],
        ),
        (wired(&[("a.label", "b.label")]), &["found type String"]),
        (wired(&[("zero", "b.angle")]), &["the system has no connector \"zero\" of its own"]),
        (
            own(&[("zero", "output", "")], &[("zero", "b.angle")]),
            &["the system's own zero of kind output", "allowed: input, parameter"],
        ),
        (
            own(&[("zero", "input", r#"<ssc:Real unit="m"/>"#)], &[("zero", "b.angle")]),
            &["connection zero to b.angle", "found unit \"m\" at its start and \"rad\" at its end"],
        ),
        (
            own(&[("zero", "input", "<ssc:Boolean/>")], &[("zero", "b.angle")]),
            &["the system's own zero of type Boolean, allowed: Real"],
        ),
        (
            own(&[("zero", "input", "")], &[("zero", "b.angle"), ("a.angle", "b.angle")]),
            &["connection a.angle to b.angle", "connected already in line", "allowed: once"],
        ),
        (
            own(&[("all", "output", "")], &[("a.angle", "all"), ("a.position[1]", "all")]),
            &["connection a.position[1] to all", "connected already in line", "allowed: once"],
        ),
        (
            own(&[("zero", "input", ""), ("all", "output", "")], &[("zero", "all")]),
            &["the system's own connectors at both ends"],
        ),
        (
            Ssd {
                connections: r#"<ssd:Connection startConnector="b.angle" endElement="b" endConnector="angle"/>"#,
                ..own(&[("b.angle", "input", "")], &[])
            },
            &["the system's own connector b.angle", "allowed: a name of its own"],
        ),
        (
            turned(" suppressUnitConversion=\"perhaps\"", ""),
            &["suppressUnitConversion", "\"perhaps\"", "true, false"],
        ),
        (
            turned("", r#"<ssc:LinearTransformation factor="2"/>"#),
            &["LinearTransformation between different units", "suppressUnitConversion"],
        ),
        (
            turned("", "<ssc:IntegerMappingTransformation/>"),
            &["IntegerMappingTransformation", "allowed there: LinearTransformation"],
        ),
        (
            wired(&[("a.angle", "b.angle"), ("a.angle", "b.angle")]),
            &["connected already in line", "allowed: once"],
        ),
        (
            shows("postion[1]", "output", ""),
            &["connector a.postion[1]", "Giver has no variable of that name", "near it: position[1]"],
        ),
        (shows("angle", "input", ""), &["connector a.angle", "found kind input", "Output"]),
        (shows("angle", "sink", ""), &["found kind \"sink\"", "allowed: input, output"]),
        (shows("angle", "output", "<ssc:Boolean/>"), &["found type Boolean, the variable is Real"]),
        (
            shows("angle", "output", r#"<ssc:Real unit="furlong"/>"#),
            &["connector a.angle", "unit \"furlong\", which is not defined", "deg"],
        ),
        (
            shows("angle", "output", r#"<ssc:Real unit="m"/>"#),
            &["unit \"m\", which measures something else than unit \"deg\""],
        ),
        (
            shows("colour", "output", r#"<ssc:Enumeration name="Color"/>"#),
            &["Enumeration \"Color\", which is not defined"],
        ),
        (
            Ssd { source: "resources/missing.fmu", ..GOOD },
            &["component \"a\"", "\"resources/missing.fmu\" is not in the SSP", "resources/giver.fmu"],
        ),
        (
            Ssd { source: "../giver.fmu", ..GOOD },
            &["component \"a\"", "\"../giver.fmu\"", "a path in the SSP"],
        ),
        (Ssd { source: "resources/%2e%2e/%2e%2e/giver.fmu", ..GOOD }, &["a path in the SSP"]),
        (Ssd { source: "/etc/passwd", ..GOOD }, &["a path in the SSP"]),
        (Ssd { source: "http://example.org/giver.fmu", ..GOOD }, &["a path in the SSP"]),
        (Ssd { source: "resources/text.fmu", ..GOOD }, &["component \"a\"", "not a usable FMU archive"]),
        (
            Ssd { of_giver: "<ssd:Conectors/>", ..GOOD },
            &["<ssd:Conectors>", "allowed there: Connectors, ParameterBindings"],
        ),
        (
            Ssd { bindings: r#"<ssd:SignalDictionaries/>"#, ..GOOD },
            &["signal dictionaries are not simulated"],
        ),
        (
            Ssd { rest: r#"<ssd:DefaultExperiment stopTime="soon"/>"#, ..GOOD },
            &["stopTime", "\"soon\"", "number"],
        ),
    ];
    for (ssd, parts) in cases {
        let text = refusal(&ssd.text(), &[("resources/text.fmu", "no archive")]);
        for part in parts {
            assert!(text.contains(part), "{part:?} is not in: {text}");
        }
        assert!(text.contains("pair.ssp"), "{text}");
        let placed = text.contains("SystemStructure.ssd: line ");
        assert!(placed, "{text}");
    }
    let folder = tempfile::tempdir().unwrap();
    assert!(System::open(ssp(folder.path(), &GOOD.text(), &[])).is_ok());
}

#[test]
fn a_system_in_a_system_and_other_components_are_refused_by_name() {
    let text =
        refusal(&GOOD.text().replace("<ssd:Elements>", "<ssd:Elements><ssd:System name=\"inner\"/>"), &[]);
    assert!(text.contains("system \"inner\" stands in a system"), "{text}");
    let twice = GOOD.text().replace("<ssd:Component name=\"b\"", "<ssd:Component name=\"a\"");
    assert!(refusal(&twice, &[]).contains("component \"a\" stands twice"));
    let other = GOOD.text().replace("name=\"a\" source", "name=\"a\" type=\"application/x-ssp\" source");
    assert!(refusal(&other, &[]).contains("type \"application/x-ssp\" is not simulated"));
    let exchange =
        GOOD.text().replace("name=\"a\" source", "name=\"a\" implementation=\"ModelExchange\" source");
    assert!(refusal(&exchange, &[]).contains("implementation \"ModelExchange\""));
    assert!(
        refusal("<ssd:SystemStructureDescription version=\"2.0\" name=\"x\"/>", &[]).contains("allowed: 1.0")
    );
    assert!(refusal("<other/>", &[]).contains("allowed: SystemStructureDescription"));
    assert!(
        refusal("<ssd:SystemStructureDescription version=\"1.0\" name=\"x\">", &[]).contains("the file ends")
    );
}

/// A parameter of a component, in the system's own binding.
fn parameter(name: &str, value: &str) -> String {
    let set = format!(
        "<ssd:ParameterBindings><ssd:ParameterBinding><ssd:ParameterValues><ssv:ParameterSet version=\"1.0\" name=\"p\">\
         <ssv:Parameters><ssv:Parameter name=\"{name}\">{value}</ssv:Parameter></ssv:Parameters></ssv:ParameterSet>\
         </ssd:ParameterValues></ssd:ParameterBinding></ssd:ParameterBindings>"
    );
    GOOD.text().replace("<ssd:System name=\"Pair\">", &format!("<ssd:System name=\"Pair\">{set}"))
}

#[test]
fn parameters_that_do_not_fit_are_refused_by_name() {
    for (name, value, parts) in [
        ("c.size", r#"<ssv:Real value="1"/>"#, ["\"c.size\"", "found no component"]),
        ("a.sise", r#"<ssv:Real value="1"/>"#, ["no variable \"sise\"", "size"]),
        ("a.size", r#"<ssv:Integer value="1"/>"#, ["found type Integer", "Real"]),
        ("a.size", r#"<ssv:Real value="1" unit="s"/>"#, ["unit \"s\"", "something else"]),
        ("a.size", r#"<ssv:Real value="1" unit="ell"/>"#, ["unit \"ell\"", "not defined"]),
        ("a.size", r#"<ssv:Real value="1e9"/>"#, ["found 1000000000", "5000"]),
        ("a.size", r#"<ssv:Real value="nan"/>"#, ["NaN", "finite"]),
        ("a.paint", r#"<ssv:Enumeration value="blue"/>"#, ["item \"blue\"", "red"]),
        ("a.angle", r#"<ssv:Real value="1"/>"#, ["angle", "cannot be set"]),
        ("a.size", "", ["has no value", "Real, Integer"]),
    ] {
        let found = refusal(&parameter(name, value), &[]);
        for part in parts {
            assert!(found.contains(part), "{part:?} is not in: {found}");
        }
    }
}

#[test]
fn parameters_reach_their_components_in_their_units() {
    let ssv = |value: &str| {
        format!(
            "<ssv:ParameterSet xmlns:ssv=\"x\" xmlns:ssc=\"y\" version=\"1.0\" name=\"p\"><ssv:Parameters>\
             <ssv:Parameter name=\"size\"><ssv:Real value=\"{value}\" unit=\"yd\"/></ssv:Parameter>\
             <ssv:Parameter name=\"paint\"><ssv:Enumeration value=\"red\"/></ssv:Parameter></ssv:Parameters>\
             <ssv:Units><ssc:Unit name=\"yd\"><ssc:BaseUnit m=\"1\" factor=\"0.9144\"/></ssc:Unit></ssv:Units>\
             </ssv:ParameterSet>"
        )
    };
    let folder = tempfile::tempdir().unwrap();
    // The component's own from a file; the system's, in a display unit, wins.
    let own =
        "<ssd:ParameterBindings><ssd:ParameterBinding source=\"resources/own.ssv\"/></ssd:ParameterBindings>";
    let with_own = Ssd { of_giver: own, ..GOOD }.text();
    let path = ssp(folder.path(), &with_own, &[("resources/own.ssv", &ssv("100"))]);
    let system = System::open(&path).unwrap();
    let [size, paint] = ["size", "paint"].map(str::to_owned);
    let found = |system: &System| -> Vec<(String, Value)> { system.parts()[0].parameters.clone() };
    assert_eq!(found(&system), [(size.clone(), Value::Real(91.44)), (paint.clone(), Value::Integer(1))]);
    let both = parameter("a.size", r#"<ssv:Real value="2" unit="km"/>"#).replace(
        "</ssd:Connectors></ssd:Component>\n<ssd:Component name=\"b\"",
        &format!("</ssd:Connectors>{own}</ssd:Component>\n<ssd:Component name=\"b\""),
    );
    let path = ssp(folder.path(), &both, &[("resources/own.ssv", &ssv("100"))]);
    let system = System::open(&path).unwrap();
    // The one that yields is gone.
    assert_eq!(found(&system), [(paint, Value::Integer(1)), (size, Value::Real(2000.0))]);
    // A name with a dot wins over the one that it begins with.
    let dotted = parameter("a.b.duration", r#"<ssv:Real value="2"/>"#)
        .replace("<ssd:Component name=\"b\"", "<ssd:Component name=\"a.b\"")
        .replace("endElement=\"b\"", "endElement=\"a.b\"");
    let system = System::open(ssp(folder.path(), &dotted, &[])).unwrap();
    assert_eq!(system.parts()[1].parameters, [("duration".to_owned(), Value::Real(2.0))]);
    let missing = refusal(&with_own, &[]);
    assert!(
        missing.contains("resources/own.ssv") && missing.contains("no such file in the SSP"),
        "{missing}"
    );
    let broken = refusal(&with_own, &[("resources/own.ssv", "<ssv:ParameterSet")]);
    assert!(broken.contains("resources/own.ssv: line 1"), "{broken}");
}

#[test]
fn archives_that_are_no_systems_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("bad.ssp");
    let refusal = |bytes: &[u8]| {
        std::fs::write(&path, bytes).unwrap();
        System::open(&path).expect_err("bad").to_string()
    };
    let whole = std::fs::read(ssp(folder.path(), &GOOD.text(), &[])).unwrap();
    assert!(refusal(&whole[..whole.len() / 2]).contains("bad.ssp: not a usable SSP archive"));
    assert!(refusal(b"").contains("it is an empty file"));
    assert!(refusal(&fmu(&taker())).contains("it holds no SystemStructure.ssd"));
    let mut entries = files::Entries::default();
    entries.add("../outside.txt", b"x".to_vec()).unwrap();
    let text = refusal(&entries.to_zip().unwrap());
    assert!(text.contains("\"../outside.txt\" leaves the folder"), "{text}");
    assert!(!folder.path().parent().unwrap().join("outside.txt").exists());
    assert!(System::open(folder.path().join("none.ssp")).is_err());
}

#[test]
fn an_enumeration_with_foreign_items_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let ssd = wired(&[("a.colour", "b.colour")]);
    let taker = r#"<ssd:Connector name="colour" kind="input"/>"#;
    let text = Ssd { taker, ..ssd }.text();
    assert!(System::open(ssp(folder.path(), &text, &[])).is_ok());
    // The same number under another name.
    let items = r#"<Item name="none" value="0"/><Item name="blue" value="1"/>"#;
    let other = description("Other", items, &["output colour Enumeration declaredType=\"Colour\""]);
    let mut entries = files::Entries::default();
    let text = text.replace("position[1]\" kind=\"output\"", "colour\" kind=\"output\"");
    let text = text.replace(
        &text[text.find("<ssd:Connector name=\"angle\"").unwrap()..text.find("</ssd:Connectors>").unwrap()],
        "",
    );
    let text = text.replace("<ssc:Real unit=\"m\"/>", "");
    entries.add("SystemStructure.ssd", text.into_bytes()).unwrap();
    entries.add("resources/giver.fmu", fmu(&other)).unwrap();
    entries.add("resources/taker.fmu", fmu(&crate::support::taker())).unwrap();
    let path = folder.path().join("other.ssp");
    std::fs::write(&path, entries.to_zip().unwrap()).unwrap();
    let text = System::open(&path).expect_err("foreign item").to_string();
    assert!(text.contains("item 1 blue") && text.contains("1 red"), "{text}");
}

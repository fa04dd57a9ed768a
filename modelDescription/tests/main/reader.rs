//! The reader gives back what was written, keeps absent and empty apart, and answers any input in bounded time.

use std::{sync::mpsc, thread, time::Duration};

use model_description::*;
use proptest::prelude::*;

use crate::arbitrary;
use crate::samples::rich;

/// A small valid file with markers for the tests to replace.
const SMALL: &str = r#"<?xml version="1.0" encoding="UTF-8"?>
<fmiModelDescription fmiVersion="2.0" modelName="m" guid="g">
  <CoSimulation modelIdentifier="m"/>
  <ModelVariables>
    <ScalarVariable name="x" valueReference="0" causality="output">
      <Real/>
    </ScalarVariable>
  </ModelVariables>
  <ModelStructure>
    <Outputs><Unknown index="1"/></Outputs>
    <InitialUnknowns><Unknown index="1" dependencies=""/></InitialUnknowns>
  </ModelStructure>
</fmiModelDescription>
"#;

fn edited(from: &str, to: &str) -> String {
    assert_eq!(SMALL.matches(from).count(), 1, "{from}");
    SMALL.replace(from, to)
}

fn error(xml: &str) -> ReadError {
    parse(xml.as_bytes()).expect_err(xml)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, ..ProptestConfig::default() })]

    #[test]
    fn what_was_written_is_read(description in arbitrary::description()) {
        let xml = to_xml(&description);
        let parsed = parse(xml.as_bytes()).map_err(|error| TestCaseError::fail(format!("{error}\n{xml}")))?;
        prop_assert_eq!(&parsed.description, &description, "{}", xml);
        prop_assert_eq!(parsed.findings(), Vec::new(), "{}", xml);
        let rows: Vec<&str> = xml.lines().collect();
        prop_assert_eq!(parsed.lines.variables.len(), description.variables.len());
        for line in parsed.lines.variables {
            prop_assert!(rows[line as usize - 1].contains("<ScalarVariable "));
        }
    }

    #[test]
    fn damaged_files_get_an_answer(
        edits in proptest::collection::vec((any::<prop::sample::Index>(), any::<u8>(), 0..3u8), 1..6)
    ) {
        let mut bytes = to_xml(&rich()).into_bytes();
        for (at, byte, how) in edits {
            let at = at.index(bytes.len());
            match how {
                0 => bytes[at] = byte,
                1 => bytes.insert(at, byte),
                _ => bytes.truncate(at.max(1)),
            }
        }
        if let Ok(parsed) = parse(&bytes) {
            let _ = parsed.findings();
        }
    }
}

#[test]
fn special_doubles_are_read() {
    for (word, value) in [("INF", f64::INFINITY), ("-INF", f64::NEG_INFINITY), (" +1.5E-3 ", 1.5e-3)] {
        let xml = edited("<Real/>", &format!("<Real max=\"{word}\"/>"));
        let parsed = parse(xml.as_bytes()).unwrap();
        let VariableKind::Real { attributes, .. } = &parsed.description.variables[0].kind else { panic!() };
        assert_eq!(attributes.max, Some(value));
    }
    for word in ["inf", "infinity", "nan", "+INF", "1_000", "0x10", "", "1,5"] {
        let problem = error(&edited("<Real/>", &format!("<Real max=\"{word}\"/>")));
        assert_eq!(
            (problem.code, problem.line, problem.element.as_str()),
            (Code::BadValue, 6, "Real"),
            "{word}"
        );
    }
}

#[test]
fn absent_and_empty_dependencies_differ() {
    let structure = parse(SMALL.as_bytes()).unwrap().description.structure;
    assert_eq!(structure.outputs[0].dependencies, None);
    assert_eq!(structure.initial_unknowns[0].dependencies, Some(Vec::new()));
}

#[test]
fn unknown_xml_is_named_and_ignored() {
    let xml = edited(
        "<CoSimulation modelIdentifier=\"m\"/>",
        "<CoSimulation modelIdentifier=\"m\" shiny=\"1\" xsi:x=\"\" xmlns:a=\"b\"><Deep><Deeper/></Deep></CoSimulation>\
         \n<Extension>text<Inside/></Extension>",
    );
    let parsed = parse(xml.as_bytes()).unwrap();
    assert_eq!(parsed.description, parse(SMALL.as_bytes()).unwrap().description);
    let found: Vec<_> = parsed.warnings.iter().map(|w| (w.code, w.line, w.subject.as_str())).collect();
    assert_eq!(
        found,
        [
            (Code::UnknownAttribute, Some(3), "<CoSimulation>"),
            (Code::UnknownElement, Some(3), "<Deep>"),
            (Code::UnknownElement, Some(4), "<Extension>"),
        ]
    );
}

#[test]
fn annotations_and_both_interfaces_are_read() {
    let xml = edited(
        "<CoSimulation modelIdentifier=\"m\"/>",
        "<!-- c --><CoSimulation modelIdentifier=\"m\"/><?pi x?><ModelExchange modelIdentifier=\"m\"/>\
         <VendorAnnotations><Tool name=\"t\"><a><b/>text</a></Tool></VendorAnnotations>",
    )
    .replace("<Real/>", "<Real/><Annotations><Tool name=\"t\"/></Annotations>");
    let parsed = parse(xml.as_bytes()).unwrap();
    assert_eq!(parsed.findings(), Vec::new());
    assert!(parsed.description.co_simulation.is_some() && parsed.description.model_exchange.is_some());
}

#[test]
fn annotations_of_other_tools_are_passed_over_and_unreadable_ones_named() {
    let annotated = |tools: &str| {
        let xml = SMALL
            .replace("causality=\"output\"", "causality=\"input\"")
            .replace("<Real/>", &format!("<Real start=\"1\"/><Annotations>{tools}</Annotations>"));
        parse(xml.as_bytes()).unwrap()
    };
    let own = |inner: &str| annotated(&format!("<Tool name=\"{}\">{inner}</Tool>", annotation::TOOL));
    let other = "<Tool name=\"t\"><Variable role=\"?\"><ReadWhere/></Variable></Tool>";
    let both =
        annotated(&format!("{other}<Tool name=\"{}\"><Variable alsoCalled=\"y\"/></Tool>", annotation::TOOL));
    assert_eq!(both.warnings, Vec::new());
    let expected = Annotation { also_called: Some("y".to_owned()), ..Annotation::default() };
    assert_eq!(both.description.variables[0].annotation.as_deref(), Some(&expected));
    assert_eq!(annotated(other).description.annotation_tool, None);

    for (inner, subject, expected) in [
        (
            "<Variable role=\"era\"/>",
            "<Variable>",
            "attribute `role` is `era`; allowed is one of epoch, litFraction, nextEvent",
        ),
        ("<Variable limit=\"a\"/>", "<Variable>", "attribute `limit` is not known"),
        (
            "<Variable><ReadWhere items=\"a\"/></Variable>",
            "<ReadWhere>",
            "attribute `option` is missing; it is required",
        ),
        ("<Variable><Read/></Variable>", "<Read>", "allowed is <ReadWhere>"),
        ("<Input/>", "<Input>", "allowed is <Variable>"),
    ] {
        let warnings = own(inner).warnings;
        let [warning] = warnings.as_slice() else { panic!("{warnings:?}") };
        let found = (warning.code, warning.line, warning.subject.as_str(), warning.message.as_str());
        let message = format!("annotation of `x`: {expected}; it is ignored");
        assert_eq!(found, (Code::Annotation, Some(6), subject, message.as_str()));
    }
    for (inner, expected) in [
        ("<Variable limitedBy=\"y\"/>", "limitedBy `y`; allowed is a Real of this FMU"),
        ("<Variable rate=\"y\"/>", "rate `y`; allowed is a Real of this FMU, or a vector of them"),
        (
            "<Variable><ReadWhere option=\"y\" items=\"a\"/></Variable>",
            "ReadWhere option `y`; allowed is an Enumeration of this FMU",
        ),
    ] {
        let findings = own(inner).findings();
        let found = findings.iter().find(|it| it.code == Code::Annotation).unwrap();
        assert_eq!(found.message, format!("its annotation has {expected}"));
    }
}

/// A model-exchange FMU of the common kind: attributes on lines of their own, states that are outputs, events.
const OSCILLATOR: &str = r#"<?xml version='1.0' encoding='utf-8' standalone="yes"?>
<!-- attributes may be quoted either way -->
<fmiModelDescription
  xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance"
  fmiVersion="2.0"
  modelName="Damped oscillator"
  guid='{"quoted"}'
  numberOfEventIndicators="2">
  <ModelExchange modelIdentifier="oscillator" completedIntegratorStepNotNeeded="1"
    canGetAndSetFMUstate="true" canSerializeFMUstate="0"/>
  <UnitDefinitions><Unit name="m"/><Unit name="degC"><BaseUnit K="1" offset="273.15"/></Unit></UnitDefinitions>
  <DefaultExperiment stopTime=" 2E1 "/>
  <ModelVariables>
    <ScalarVariable name="x" valueReference="10" causality="output" initial="exact">
      <Real unit="m" start="2" reinit="true"/>
    </ScalarVariable>
    <ScalarVariable name="v" valueReference="11" initial="exact"><Real start="-.5" reinit="false"/></ScalarVariable>
    <ScalarVariable name="der(x)" valueReference="11"><Real derivative="1"/></ScalarVariable>
    <ScalarVariable name="der(v)" valueReference="13"><Real derivative="2"/></ScalarVariable>
    <ScalarVariable name="push" valueReference="14" causality="input" canHandleMultipleSetPerTimeInstant="false">
      <Real start="0"/>
    </ScalarVariable>
  </ModelVariables>
  <ModelStructure>
    <Outputs><Unknown index="1" dependencies="1" dependenciesKind="constant"/></Outputs>
    <Derivatives>
      <Unknown index="3" dependencies="2" dependenciesKind="constant"/>
      <Unknown index="4" dependencies=" 1  2\n5 "/>
    </Derivatives>
    <InitialUnknowns><Unknown index="3"/><Unknown index="4" dependencies=""/></InitialUnknowns>
  </ModelStructure>
</fmiModelDescription>"#;

#[test]
fn model_exchange_files_are_read() {
    let parsed = parse(OSCILLATOR.replace("\\n", "\n").as_bytes()).unwrap();
    assert_eq!(parsed.findings(), Vec::new());
    let Description { guid, model_exchange, co_simulation, structure, units, default_experiment, .. } =
        parsed.description;
    assert_eq!(guid, "{\"quoted\"}");
    assert_eq!(co_simulation, None);
    let flags = model_exchange.unwrap();
    assert!(flags.completed_integrator_step_not_needed && flags.can_get_and_set_fmu_state);
    assert!(!flags.can_serialize_fmu_state);
    assert_eq!(units[1].base.unwrap().offset, 273.15);
    assert_eq!(units[0].base, None);
    assert_eq!(default_experiment.unwrap().stop_time, Some(20.0));
    assert_eq!(structure.derivatives[1].dependencies, Some(vec![1, 2, 5]));
    assert_eq!(structure.initial_unknowns[1].dependencies, Some(Vec::new()));
    assert_eq!(parsed.lines.variables, [14, 17, 18, 19, 20]);
}

#[test]
fn encodings_other_than_utf8_are_named() {
    let with_bom = [b"\xEF\xBB\xBF".as_slice(), SMALL.as_bytes()].concat();
    assert!(parse(&with_bom).unwrap().warnings.is_empty());

    let utf16: Vec<u8> = SMALL.encode_utf16().flat_map(u16::to_le_bytes).collect();
    let with_mark = [b"\xFF\xFE".as_slice(), &utf16].concat();
    for bytes in [&utf16, &with_mark] {
        let problem = parse(bytes).unwrap_err();
        assert_eq!(problem.code, Code::Encoding);
        assert!(problem.message.contains("UTF-16"), "{problem}");
    }
    let mut latin: Vec<u8> =
        edited("modelName=\"m\"", "modelName=\"m?\"").replace("UTF-8", "ISO-8859-1").into();
    assert_eq!(parse(&latin).unwrap().warnings[0].code, Code::Encoding);
    let at = latin.iter().rposition(|b| *b == b'?').unwrap();
    latin[at] = 0xE4;
    let problem = parse(&latin).unwrap_err();
    assert_eq!((problem.code, problem.line), (Code::Encoding, 2));
    assert!(problem.message.contains("0xE4"), "{problem}");
    let declared = edited("modelName=\"m\"", "modelName=\"m\u{e4}\"").replace("UTF-8", "ISO-8859-1");
    assert!(error(&declared).message.contains("ISO-8859-1"));
}

#[test]
fn errors_name_line_and_element() {
    const ROOT: &str = "fmiModelDescription";
    const VARIABLE: &str = "ScalarVariable";
    use Code::{BadValue, DuplicateElement, Malformed, MissingAttribute, MissingElement, Version};
    let cases: &[(&str, &str, Code, u32, &str, &str)] = &[
        ("<Real/>", "<Real", Malformed, 6, "Real", ""),
        ("</ScalarVariable>", "</Scalar>", Malformed, 7, VARIABLE, ""),
        ("</fmiModelDescription>", "", Malformed, 14, ROOT, "ends inside"),
        ("</fmiModelDescription>", "</fmiModelDescription><a/>", Malformed, 13, "", "follows the end"),
        ("guid=\"g\"", "guid=\"g\" guid=\"h\"", Malformed, 2, ROOT, "`guid` stands twice"),
        ("guid=\"g\"", "guid=\"<\"", Malformed, 2, ROOT, "`&lt;`"),
        ("guid=\"g\"", "guid=\"&bomb;\"", Malformed, 2, ROOT, "`guid`"),
        ("guid=\"g\"", "", MissingAttribute, 2, ROOT, "`guid` is missing"),
        ("fmiVersion=\"2.0\"", "fmiVersion=\"3.0\"", Version, 2, ROOT, "allowed is `2.0`"),
        (
            "causality=\"output\"",
            "causality=\"exit\"",
            BadValue,
            5,
            VARIABLE,
            "`exit`; allowed is one of parameter, ",
        ),
        ("valueReference=\"0\"", "valueReference=\"-1\"", BadValue, 5, VARIABLE, "0 to 4294967295"),
        ("<Real/>", "", MissingElement, 5, VARIABLE, "<Real, Integer"),
        ("<Real/>", "<Real/><Integer/>", DuplicateElement, 6, "Integer", "second time"),
        ("<Real/>", "<Enumeration/>", MissingAttribute, 6, "Enumeration", "`declaredType`"),
        ("dependencies=\"\"", "dependencies=\"1 x\"", BadValue, 11, "Unknown", "`1 x`"),
        ("<CoSimulation", "\u{1}<CoSimulation", Malformed, 3, "", "U+0001"),
    ];
    for (from, to, code, line, element, part) in cases {
        let problem = error(&edited(from, to));
        assert_eq!(
            (problem.code, problem.line, problem.element.as_str()),
            (*code, *line, *element),
            "{to}: {problem}"
        );
        assert!(problem.message.contains(part), "{to}: {problem}");
    }
    for text in ["", "  ", "no xml", "<?xml version=\"1.0\"?>", "<!-- only -->"] {
        assert_eq!(error(text).code, Code::Malformed, "{text}");
    }
    assert_eq!(error("<html></html>").code, Code::Root);
}

/// Does what must take time in proportion to its input. The inputs are so large that it takes a second or two on any
/// machine, however busy, and hours where each element is compared with all the others: the bound lies far from both.
fn in_proportion<T: Send + 'static>(work: impl FnOnce() -> T + Send + 'static) -> T {
    let (sender, receiver) = mpsc::channel();
    thread::spawn(move || sender.send(work()));
    receiver
        .recv_timeout(Duration::from_secs(600))
        .expect("it takes more than time in proportion to its input")
}

/// Runs the reader on a hostile file; how it ended.
fn hostile(xml: &str) -> Option<Code> {
    let xml = xml.to_owned();
    in_proportion(move || parse(xml.as_bytes()).err().map(|problem| problem.code))
}

#[test]
fn hostile_files_are_refused_quickly() {
    let many = 3_000_000;
    let nested = |open: &str| edited("<Real/>", &format!("{}<Real/>", open.repeat(many)));
    assert_eq!(hostile(&nested("<a>")), Some(Code::TooLarge));
    assert_eq!(hostile(&nested("<Real>")), Some(Code::TooLarge));
    assert_eq!(hostile(&"<a>".repeat(many)), Some(Code::Root));
    let attributes: String = (0..many).map(|i| format!(" a{i}=\"\"")).collect();
    assert_eq!(hostile(&edited("<Real/>", &format!("<Real{attributes}/>"))), Some(Code::TooLarge));
    let laughs = edited(
        "<fmiModelDescription fmiVersion",
        "<!DOCTYPE l [<!ENTITY a \"ha\"><!ENTITY b \"&a;&a;&a;&a;\"><!ENTITY c \"&b;&b;&b;&b;\">]>\
         <fmiModelDescription author=\"&c;\" fmiVersion",
    );
    assert_eq!(hostile(&laughs), Some(Code::Malformed));
    assert_eq!(hostile(&edited("<Real/>", &"<Real/><b/>".repeat(2))), Some(Code::DuplicateElement));
    let strangers = edited("<Real/>", &format!("<Real/>{}", "<b c=\"d\"/>".repeat(many)));
    assert_eq!(hostile(&strangers), None);
    assert_eq!(parse(strangers.as_bytes()).unwrap().warnings.len(), 1000);
    let open = edited("<CoSimulation", &"<".repeat(many));
    assert_eq!(hostile(&open), Some(Code::Malformed));
}

#[test]
fn a_large_file_is_read_in_time() {
    let variable = "<ScalarVariable name=\"x#\" valueReference=\"0\"><Real/></ScalarVariable>\n";
    let variables: String = (0..1_000_000)
        .map(|i| variable.replace('#', &i.to_string()).replace("\"0\"", &format!("\"{}\"", i + 1)))
        .collect();
    let xml = edited("  </ModelVariables>", &format!("{variables}</ModelVariables>"));
    let (findings, variables) = in_proportion(move || {
        let parsed = parse(xml.as_bytes()).unwrap();
        (parsed.findings(), parsed.description.variables.len())
    });
    assert_eq!(findings, Vec::new());
    assert_eq!(variables, 1_000_001);
}

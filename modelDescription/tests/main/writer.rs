//! The writer gives the schema's element order, escapes every text and writes doubles that read back to the bit.

use model_description::*;
use proptest::prelude::*;

use crate::samples::{real, rich, variable};

#[test]
fn elements_stand_in_schema_order() {
    let xml = to_xml(&rich());
    let order = [
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>",
        "<fmiModelDescription fmiVersion=\"2.0\" modelName=\"Rich\"",
        "<CoSimulation",
        "<SourceFiles>",
        "<UnitDefinitions>",
        "<TypeDefinitions>",
        "<LogCategories>",
        "<DefaultExperiment",
        "<ModelVariables>",
        "<ModelStructure>",
        "<Outputs>",
        "<InitialUnknowns>",
        "</ModelStructure>",
        "</fmiModelDescription>",
    ];
    let mut from = 0;
    for part in order {
        from += xml[from..].find(part).unwrap_or_else(|| panic!("{part} missing or out of order:\n{xml}"));
    }
}

#[test]
fn defaults_are_left_out_and_the_rest_is_written() {
    let mut description = rich();
    description.variables.truncate(0);
    description.variables.push(variable("x", 4, Causality::Local, Variability::Continuous, real(None, None)));
    let xml = to_xml(&description);
    assert!(xml.contains(
        "    <ScalarVariable name=\"x\" valueReference=\"4\">\n      <Real/>\n    </ScalarVariable>\n"
    ));
    assert!(!xml.contains("=\"false\""), "{xml}");
    assert!(xml.contains("<Unit name=\"rad\">\n      <BaseUnit rad=\"1\"/>\n"), "{xml}");
}

#[test]
fn texts_are_escaped_and_unrepresentable_characters_replaced() {
    assert_eq!(escape("a<b>&\"c\"'\t\n\r"), "a&lt;b&gt;&amp;&quot;c&quot;'&#9;&#10;&#13;");
    assert_eq!(escape("\u{0}\u{1f}\u{fffe}\u{1f600}"), "\u{fffd}\u{fffd}\u{fffd}\u{1f600}");
}

#[test]
fn empty_dependencies_are_not_absent_ones() {
    let xml = to_xml(&rich());
    assert!(xml.contains("<Unknown index=\"6\" dependencies=\"\"/>"), "{xml}");
    assert!(
        xml.contains("<Unknown index=\"3\" dependencies=\"1 2\" dependenciesKind=\"dependent tunable\"/>")
    );
}

fn written_start(value: f64) -> String {
    let description = Description {
        variables: vec![variable("x", 0, Causality::Input, Variability::Continuous, real(Some(value), None))],
        ..Description::default()
    };
    let xml = to_xml(&description);
    let (_, rest) = xml.split_once("start=\"").unwrap();
    rest.split_once('"').unwrap().0.to_owned()
}

#[test]
fn special_doubles_follow_xml_schema() {
    assert_eq!(written_start(f64::INFINITY), "INF");
    assert_eq!(written_start(f64::NEG_INFINITY), "-INF");
    assert_eq!(written_start(f64::NAN), "NaN");
    assert_eq!(written_start(60.0), "60");
    assert_eq!(written_start(-0.0), "-0");
    assert_eq!(written_start(0.1), "0.1");
    assert_eq!(written_start(f64::MAX), "1.7976931348623157e308");
    assert_eq!(written_start(5e-324), "5e-324");
}

proptest! {
    #[test]
    fn every_finite_double_reads_back_to_the_bit(bits in any::<u64>()) {
        let value = f64::from_bits(bits);
        prop_assume!(value.is_finite());
        let text = written_start(value);
        prop_assert_eq!(text.parse::<f64>().unwrap().to_bits(), bits, "{}", text);
        prop_assert!(text.bytes().all(|b| b"0123456789+-.e".contains(&b)), "{}", text);
    }
}

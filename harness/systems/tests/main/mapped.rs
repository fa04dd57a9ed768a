//! Parameter mappings: names, units, transformations as SSP 1.0 has them, what does not fit; steps in annotations.

use fmi::Value;
use systems::System;

use crate::support::{Ssd, ssp};

const SET: &str = r#"<ssv:ParameterSet version="1.0" name="p"><ssv:Parameters>
<ssv:Parameter name="length"><ssv:Real value="100" unit="yd"/></ssv:Parameter>
<ssv:Parameter name="inches"><ssv:Real value="2"/></ssv:Parameter>
<ssv:Parameter name="mode"><ssv:Integer value="7"/></ssv:Parameter>
<ssv:Parameter name="hue"><ssv:Enumeration value="rot"/></ssv:Parameter>
<ssv:Parameter name="dark"><ssv:Boolean value="true"/></ssv:Parameter>
<ssv:Parameter name="many"><ssv:Integer value="5"/></ssv:Parameter>
<ssv:Parameter name="of_others"><ssv:Real value="1"/></ssv:Parameter></ssv:Parameters>
<ssv:Units><ssc:Unit name="yd"><ssc:BaseUnit m="1" factor="0.9144"/></ssc:Unit></ssv:Units></ssv:ParameterSet>"#;

fn entry(source: &str, target: &str, holds: &str) -> String {
    format!(r#"<ssm:MappingEntry source="{source}" target="{target}">{holds}</ssm:MappingEntry>"#)
}

fn mapping(entries: &str) -> String {
    format!(
        r#"<ssm:ParameterMapping xmlns:ssm="m" xmlns:ssc="c" version="1.0">{entries}</ssm:ParameterMapping>"#
    )
}

/// The system with the set in component `a`, or with a prefix in the system, mapped inline or by a file.
fn system(entries: &str, (prefix, is_inline): (&str, bool)) -> Result<System, String> {
    let mapping = mapping(entries);
    let (source, inline) =
        if is_inline { ("", mapping.as_str()) } else { (r#" source="resources/m.ssm""#, "") };
    let prefixed = if prefix.is_empty() { String::new() } else { format!(r#" prefix="{prefix}""#) };
    let binding: &str = format!(
        "<ssd:ParameterBindings><ssd:ParameterBinding{prefixed}><ssd:ParameterValues>{SET}</ssd:ParameterValues>\
         <ssd:ParameterMapping{source}>{inline}</ssd:ParameterMapping></ssd:ParameterBinding></ssd:ParameterBindings>"
    )
    .leak();
    let [bindings, of_giver] = if prefix.is_empty() { ["", binding] } else { [binding, ""] };
    let ssd = Ssd { bindings, of_giver, ..Ssd::default() }.text().replace(
        "<ssd:SystemStructureDescription ",
        "<ssd:SystemStructureDescription xmlns:ssm=\"m\" xmlns:osp=\"o\" xmlns:oms=\"i\" ",
    );
    let folder = tempfile::tempdir().unwrap();
    let path = ssp(folder.path(), &ssd, &[("resources/m.ssm", &mapping)]);
    System::open(path).map_err(|error| error.to_string())
}

/// A parameter of the giver.
fn parameter(system: &System, name: &str) -> Option<Value> {
    let parameters = &system.parts()[0].parameters;
    parameters.iter().find(|(known, _)| known == name).map(|(_, value)| value.clone())
}

#[test]
fn mapped_parameters_are_converted_and_transformed() {
    let table = |kind: &str, pairs: &[(&str, &str)]| {
        let entry = |(source, target): &(&str, &str)| {
            format!(r#"<ssc:MapEntry source="{source}" target="{target}"/>"#)
        };
        let entries: String = pairs.iter().map(entry).collect();
        format!("<ssc:{kind}MappingTransformation>{entries}</ssc:{kind}MappingTransformation>")
    };
    let linear = r#"<ssc:LinearTransformation factor="2" offset="1"/>"#;
    for (entries, name, expected) in [
        (entry("length", "size", ""), "size", Value::Real(91.44)),
        // In the target's unit, behind the conversion.
        (entry("length", "size", linear), "size", Value::Real(2.0 * 91.44 + 1.0)),
        (
            entry("inches", "size", r#"<ssc:LinearTransformation factor="0.0254"/>"#),
            "size",
            Value::Real(0.0508),
        ),
        (
            entry("length", "size", "").replace("\">", "\" suppressUnitConversion=\"true\">"),
            "size",
            Value::Real(100.0),
        ),
        (
            entry("length", "size", linear).replacen("\">", "\" suppressUnitConversion=\"true\">", 1),
            "size",
            Value::Real(201.0),
        ),
        (entry("mode", "many", &table("Integer", &[("1", "4"), ("7", "2")])), "many", Value::Integer(2)),
        (entry("mode", "paint", &table("Integer", &[("7", "1")])), "paint", Value::Integer(1)),
        (entry("hue", "paint", &table("Enumeration", &[("rot", "red")])), "paint", Value::Integer(1)),
        (entry("dark", "lit", &table("Boolean", &[("1", "false")])), "lit", Value::Boolean(false)),
        // Without an entry a parameter keeps its name.
        (entry("length", "size", ""), "many", Value::Integer(5)),
    ] {
        let found = parameter(&system(&entries, ("", true)).unwrap(), name);
        assert_eq!(found, Some(expected), "{entries}");
    }
    // One source for two targets, from a file, and in the system by names with a prefix. A template's entries have no source.
    let both = entry("length", "size", "") + &entry("length", "push", "") + &entry("", "many", "");
    let prefixed = both.replace("source=\"length", "source=\"x.length").replace("target=\"", "target=\"a.");
    for (entries, place) in [(&both, ("", false)), (&prefixed, ("x.", true)), (&prefixed, ("x.", false))] {
        let system = system(entries, place).unwrap();
        let found = ["size", "push"].map(|name| parameter(&system, name));
        assert_eq!(found, [Some(Value::Real(91.44)), Some(Value::Real(91.44))], "{entries}");
    }
}

#[test]
fn mappings_that_do_not_fit_are_named_by_file_and_line() {
    let table = |kind: &str, pair: &str| format!("<ssc:{kind}><ssc:MapEntry {pair}/></ssc:{kind}>");
    let linear = r#"<ssc:LinearTransformation factor="2"/>"#;
    for (entries, parts) in [
        (entry("lenght", "size", ""), ["found no parameter \"lenght\"", "near it: length"]),
        (entry("length", "siez", ""), ["no variable \"siez\"", "near it: size"]),
        (entry("mode", "many", linear), ["found LinearTransformation of type Integer", "allowed: Real"]),
        (
            entry("mode", "many", &table("IntegerMappingTransformation", r#"source="1" target="2""#)),
            ["found 7, which no MapEntry takes", "allowed: 1"],
        ),
        (
            entry("mode", "many", &table("IntegerMappingTransformation", r#"source="1""#)),
            ["`target` is missing", ""],
        ),
        (entry("length", "size", "<ssc:Linear/>"), ["<ssc:Linear>", "allowed there: LinearTransformation"]),
        (entry("mode", "size", ""), ["found type Integer", "allowed: Real"]),
    ] {
        let text = system(&entries, ("", false)).err().unwrap();
        for part in parts.iter().chain(&["resources/m.ssm: line 1"]) {
            assert!(text.contains(part), "{part:?} is not in: {text}");
        }
    }
}

#[test]
fn annotated_steps_are_the_default_step() {
    const OURS: &str =
        r#"<ssc:Annotation type="io.github.heliotorque"><h:Step xmlns:h="h" size="0.5"/></ssc:Annotation>"#;
    let of = |kind: &str, holds: &str| format!(r#"<ssc:Annotation type="{kind}">{holds}</ssc:Annotation>"#);
    let osp = of(
        "com.opensimulationplatform",
        r#"<osp:Algorithm><osp:FixedStepAlgorithm baseStepSize="1e-2"/></osp:Algorithm>"#,
    );
    let old = of(
        "org.open-simulation-platform",
        r#"<osp:SimulationInformation><osp:FixedStepMaster description="x" stepSize="0.05"/></osp:SimulationInformation>"#,
    );
    let oms = of(
        "org.openmodelica",
        r#"<oms:Annotations><oms:SimulationInformation><oms:FixedStepMaster stepSize="0.125"/></oms:SimulationInformation></oms:Annotations>"#,
    );
    let other = of("com.example", r#"<x:FixedStepMaster xmlns:x="x" stepSize="0.75"/>"#);
    let ours = OURS.replace("io.github.heliotorque", files::ANNOTATION);
    let step_s = |in_system: &str, in_experiment: &str| {
        let bindings: &str = format!("<ssd:Annotations>{in_system}</ssd:Annotations>").leak();
        let rest: &str = format!(
            "<ssd:DefaultExperiment><ssd:Annotations>{in_experiment}</ssd:Annotations></ssd:DefaultExperiment>"
        )
        .leak();
        let ssd = Ssd { bindings, rest, ..Ssd::default() }.text().replace(
            "<ssd:SystemStructureDescription ",
            "<ssd:SystemStructureDescription xmlns:osp=\"o\" xmlns:oms=\"i\" ",
        );
        let read = systems::read_structure(ssd.as_bytes()).map_err(|error| error.to_string());
        read.map(|structure| structure.experiment.step_size)
    };
    for (in_system, in_experiment, expected) in [
        ("", osp.as_str(), Some(0.01)),
        (&old, "", Some(0.05)),
        (&oms, "", Some(0.125)),
        ("", &other, None),
        // The narrower description wins: ours, OSP's, OMSimulator's.
        (&oms, &osp, Some(0.01)),
        (&oms, &(osp.clone() + &ours), Some(0.5)),
        (&(oms.clone() + &old), "", Some(0.05)),
    ] {
        assert_eq!(step_s(in_system, in_experiment), Ok(expected), "{in_system} {in_experiment}");
    }
    let refused = step_s("", &osp.replace("1e-2", "0")).unwrap_err();
    assert!(
        refused.contains("`baseStepSize`: found \"0\", allowed: a number of seconds above 0"),
        "{refused}"
    );
}

//! A system's parameters through a parameter mapping act as the same values set by hand.

use std::fs;

use files::Entries;

use crate::{library, packed_from, run, shown};

const NAMES: &str = r#"xmlns:ssd="http://ssp-standard.org/SSP1/SystemStructureDescription" xmlns:ssc="http://ssp-standard.org/SSP1/SystemStructureCommon" xmlns:ssv="http://ssp-standard.org/SSP1/SystemStructureParameterValues" xmlns:ssm="http://ssp-standard.org/SSP1/SystemStructureParameterMapping" xmlns:osp="http://opensimulationplatform.com/SSP/OSPAnnotations""#;
const STRUCTURE: &str = r#"<ssd:System name="Root"><ssd:Elements>
<ssd:Component name="Torque 1" type="application/x-fmu-sharedlibrary" source="resources/DT.fmu"><ssd:ParameterBindings>
<ssd:ParameterBinding source="resources/cg.ssv"><ssd:ParameterMapping source="resources/cg.ssm"/></ssd:ParameterBinding>
</ssd:ParameterBindings></ssd:Component></ssd:Elements></ssd:System>
<ssd:DefaultExperiment startTime="0" stopTime="60"><ssd:Annotations><ssc:Annotation type="com.opensimulationplatform">
<osp:Algorithm><osp:FixedStepAlgorithm baseStepSize="20"/></osp:Algorithm></ssc:Annotation></ssd:Annotations></ssd:DefaultExperiment>"#;
const VALUES: &str = r#"<ssv:Parameters><ssv:Parameter name="z"><ssv:Real value="-25.4" unit="mm"/></ssv:Parameter>
<ssv:Parameter name="x_in"><ssv:Real value="2.0"/></ssv:Parameter></ssv:Parameters>
<ssv:Units><ssc:Unit name="mm"><ssc:BaseUnit m="1" factor="0.001"/></ssc:Unit></ssv:Units>"#;
const MAPPING: &str = r#"<ssm:MappingEntry source="z" target="spacecraft.centerOfMass[3]"/>
<ssm:MappingEntry source="x_in" target="spacecraft.centerOfMass[1]"><ssc:LinearTransformation factor="0.0254" offset="0"/></ssm:MappingEntry>"#;

#[test]
fn a_mapped_parameter_set_moves_the_centre_of_mass_and_the_annotated_step_is_taken() {
    let Some((scratch, fmu)) = library().and_then(|it| packed_from(&it, "DisturbanceTorque", "DT.fmu", &[]))
    else {
        return;
    };
    let mut entries = Entries::default();
    entries.add("resources/DT.fmu", fs::read(&fmu).unwrap()).unwrap();
    for (path, element, content) in [
        ("SystemStructure.ssd", "ssd:SystemStructureDescription", STRUCTURE),
        ("resources/cg.ssv", "ssv:ParameterSet", VALUES),
        ("resources/cg.ssm", "ssm:ParameterMapping", MAPPING),
    ] {
        let text = format!("<{element} {NAMES} version=\"1.0\" name=\"cg\">{content}</{element}>");
        entries.add(path, text.into_bytes()).unwrap();
    }
    let (system, output) = (scratch.path().join("mapped.ssp"), scratch.path().join("out.csv"));
    fs::write(&system, entries.to_zip().unwrap()).unwrap();
    let recorded = |subject: &str, more: &[&str]| {
        let record = ["--record", "*torque.solar*", "--quiet", "--output", shown(&output)];
        run(&[&["run", subject], &record[..], more].concat(), 0);
        let text = fs::read_to_string(&output).unwrap();
        let row = |line: &str| line.split(',').map(|cell| cell.parse().unwrap()).collect::<Vec<f64>>();
        text.lines().skip(1).map(row).collect::<Vec<_>>()
    };
    let mapped = recorded(shown(&system), &[]);
    let set = ["--set", "spacecraft.centerOfMass[1]=5.08cm", "--set", "spacecraft.centerOfMass[3]=-2.54cm"];
    let alone = recorded(shown(&fmu), &[&set[..], &["--stop", "60", "--step", "20"]].concat());
    // OSP's step of 20 s.
    assert_eq!(mapped.iter().map(|row| row[0]).collect::<Vec<_>>(), [0.0, 20.0, 40.0, 60.0]);
    assert_eq!(mapped, alone);
    let expected = [-9.528_71e-6, 0.000_137e-6, -19.073e-6];
    let last = &mapped.last().unwrap()[1..];
    assert!(last.iter().zip(expected).all(|(found, expected)| (found - expected).abs() < 2e-9), "{last:?}");
}

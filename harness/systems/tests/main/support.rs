//! FMUs that are descriptions alone, and SSPs of them.

use std::path::{Path, PathBuf};

use files::Entries;
use model_description::annotation::TOOL;

const UNITS: &str = r#"<UnitDefinitions>
<Unit name="m"><BaseUnit m="1"/><DisplayUnit name="km" factor="0.001"/></Unit>
<Unit name="s"><BaseUnit s="1"/></Unit>
<Unit name="deg"><BaseUnit rad="1" factor="0.017453292519943295"/></Unit>
<Unit name="rad"><BaseUnit rad="1"/></Unit>
</UnitDefinitions>"#;

/// A description of variables, each `causality name type attributes`, where ` | ` stands before an annotation of ours.
pub(crate) fn description(model: &str, items: &str, variables: &[&str]) -> String {
    let mut text = format!(
        "<fmiModelDescription fmiVersion=\"2.0\" modelName=\"{model}\" guid=\"{{{model}}}\">\
         <CoSimulation modelIdentifier=\"{model}\" canHandleVariableCommunicationStepSize=\"true\"/>{UNITS}\
         <TypeDefinitions><SimpleType name=\"Colour\"><Enumeration>{items}</Enumeration></SimpleType>\
         </TypeDefinitions><DefaultExperiment stopTime=\"10\" stepSize=\"0.5\"/><ModelVariables>"
    );
    for (reference, line) in variables.iter().enumerate() {
        let [causality, name, kind, attributes] = *line.splitn(4, ' ').collect::<Vec<_>>() else {
            panic!("{line}")
        };
        let variability = match (causality, kind) {
            ("parameter", _) => " variability=\"fixed\"",
            (_, "Real") => "",
            _ => " variability=\"discrete\"",
        };
        let (attributes, annotation) = attributes.split_once(" | ").unwrap_or((attributes, ""));
        let annotations = match annotation {
            "" => String::new(),
            given => format!("<Annotations><Tool name=\"{TOOL}\">{given}</Tool></Annotations>"),
        };
        text.push_str(&format!(
            "<ScalarVariable name=\"{name}\" valueReference=\"{reference}\" causality=\"{causality}\"{variability}>\
             <{kind} {attributes}/>{annotations}</ScalarVariable>"
        ));
    }
    text.push_str("</ModelVariables><ModelStructure/></fmiModelDescription>");
    text
}

pub(crate) const ITEMS: &str = r#"<Item name="none" value="0"/><Item name="red" value="1"/>"#;

/// Gives positions, an angle and options.
pub(crate) fn giver() -> String {
    description(
        "Giver",
        ITEMS,
        &[
            "output position[1] Real unit=\"m\"",
            "output position[2] Real unit=\"m\"",
            "output angle Real unit=\"deg\"",
            "output count Integer ",
            "output flag Boolean ",
            "output colour Enumeration declaredType=\"Colour\"",
            "output label String ",
            "parameter size Real unit=\"m\" start=\"1\" max=\"5000\"",
            "parameter paint Enumeration declaredType=\"Colour\" start=\"0\"",
            "parameter many Integer start=\"3\"",
            "parameter lit Boolean start=\"true\"",
            "input push Real unit=\"m\" start=\"0\"",
        ],
    )
}

/// Takes them.
pub(crate) fn taker() -> String {
    description(
        "Taker",
        ITEMS,
        &[
            "input position[1] Real unit=\"m\" start=\"0\"",
            "input position[2] Real unit=\"m\" start=\"0\"",
            "input angle Real unit=\"rad\" start=\"0\"",
            "input count Integer start=\"0\"",
            "input flag Boolean start=\"false\"",
            "input colour Enumeration declaredType=\"Colour\" start=\"0\"",
            "input label String start=\"\"",
            "input duration Real unit=\"s\" start=\"0\"",
            "output push Real unit=\"m\"",
        ],
    )
}

/// An FMU's archive.
pub(crate) fn fmu(description: &str) -> Vec<u8> {
    let mut entries = Entries::default();
    entries.add("modelDescription.xml", description.as_bytes().to_vec()).unwrap();
    entries.to_zip().unwrap()
}

/// The SSD around connectors, connections, further elements.
pub(crate) struct Ssd {
    pub giver: &'static str,
    pub taker: &'static str,
    pub connections: &'static str,
    pub bindings: &'static str,
    pub of_giver: &'static str,
    pub rest: &'static str,
    pub source: &'static str,
}

impl Default for Ssd {
    fn default() -> Self {
        Self {
            giver: r#"<ssd:Connector name="position[1]" kind="output"><ssc:Real unit="m"/></ssd:Connector>
                <ssd:Connector name="angle" kind="output"><ssc:Real unit="deg"/></ssd:Connector>
                <ssd:Connector name="count" kind="output"><ssc:Integer/></ssd:Connector>
                <ssd:Connector name="colour" kind="output"/>
                <ssd:Connector name="label" kind="output"/>"#,
            taker: r#"<ssd:Connector name="position[1]" kind="input"><ssc:Real unit="m"/></ssd:Connector>
                <ssd:Connector name="angle" kind="input"><ssc:Real unit="rad"/></ssd:Connector>
                <ssd:Connector name="count" kind="input"><ssc:Integer/></ssd:Connector>
                <ssd:Connector name="flag" kind="input"/>
                <ssd:Connector name="colour" kind="input"/>
                <ssd:Connector name="label" kind="input"/>
                <ssd:Connector name="duration" kind="input"/>"#,
            connections: r#"<ssd:Connection startElement="a" startConnector="position[1]" endElement="b" endConnector="position[1]"/>"#,
            bindings: "",
            of_giver: "",
            rest: "",
            source: "resources/giver.fmu",
        }
    }
}

impl Ssd {
    pub(crate) fn text(&self) -> String {
        format!(
            r#"<?xml version="1.0" encoding="UTF-8"?>
<ssd:SystemStructureDescription xmlns:ssc="http://ssp-standard.org/SSP1/SystemStructureCommon"
 xmlns:ssd="http://ssp-standard.org/SSP1/SystemStructureDescription"
 xmlns:ssv="http://ssp-standard.org/SSP1/SystemStructureParameterValues" name="Pair" version="1.0">
<ssd:System name="Pair">{}
<ssd:Elements>
<ssd:Component name="a" source="{}"><ssd:Connectors>{}</ssd:Connectors>{}</ssd:Component>
<ssd:Component name="b" source="resources/taker.fmu"><ssd:Connectors>{}</ssd:Connectors></ssd:Component>
</ssd:Elements>
<ssd:Connections>{}</ssd:Connections></ssd:System>{}
</ssd:SystemStructureDescription>"#,
            self.bindings, self.source, self.giver, self.of_giver, self.taker, self.connections, self.rest
        )
    }
}

/// Writes an SSP with both FMUs and further files.
pub(crate) fn ssp(folder: &Path, ssd: &str, files: &[(&str, &str)]) -> PathBuf {
    let mut entries = Entries::default();
    entries.add("SystemStructure.ssd", ssd.as_bytes().to_vec()).unwrap();
    entries.add("resources/giver.fmu", fmu(&giver())).unwrap();
    entries.add("resources/taker.fmu", fmu(&taker())).unwrap();
    for (path, text) in files {
        entries.add(path, text.as_bytes().to_vec()).unwrap();
    }
    let path = folder.join("pair.ssp");
    std::fs::write(&path, entries.to_zip().unwrap()).unwrap();
    path
}

/// Writes an SSP of these components.
pub(crate) fn write(folder: &Path, ssd: &str, components: &[(String, fmi::Fmu)]) -> PathBuf {
    let mut entries = Entries::default();
    entries.add("SystemStructure.ssd", ssd.as_bytes().to_vec()).unwrap();
    for (name, fmu) in components {
        entries.add(&format!("resources/{name}.fmu"), std::fs::read(fmu.source()).unwrap()).unwrap();
    }
    let path = folder.join("loop.ssp");
    std::fs::write(&path, entries.to_zip().unwrap()).unwrap();
    path
}

//! Writes `SystemStructure.ssd` (SSP 1.0): UTF-8, in the schema's order, the same bytes for the same structure.

use std::fmt::Write;

use files::ANNOTATION;
use model_description::{Unit, escape};

use crate::structure::{Component, Connection, Connector, ParameterSet, Signal, Structure, Written};

const HEAD: &str = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<ssd:SystemStructureDescription \
                    xmlns:ssc=\"http://ssp-standard.org/SSP1/SystemStructureCommon\" \
                    xmlns:ssd=\"http://ssp-standard.org/SSP1/SystemStructureDescription\" version=\"1.0\"";

/// Components are drawn in a row, in the order in which a master calls them.
const WIDTH_MM: usize = 60;
const HEIGHT_MM: usize = 40;
const PITCH_MM: usize = 100;

/// How OMSimulator's program is reported of the step, without which it imports no system: its own annotation of the system, in its own
/// name space.
const OMSIMULATOR: [&str; 2] =
    ["org.openmodelica", "https://raw.githubusercontent.com/OpenModelica/OMSimulator/master/schema/oms.xsd"];
/// Tolerance of its master; a master of a fixed step does not use it.
const OMSIMULATOR_TOLERANCE: f64 = 1e-4;

/// The file of a parameter set (`.ssv`).
pub fn to_parameter_set(set: &ParameterSet) -> String {
    let mut text = format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<ssv:ParameterSet \
         xmlns:ssv=\"http://ssp-standard.org/SSP1/SystemStructureParameterValues\" version=\"1.0\" name=\"{}\">\n  \
         <ssv:Parameters>\n",
        escape(&set.name)
    );
    for parameter in &set.parameters {
        let value = match &parameter.value {
            Written::Real { value, unit: Some(unit) } => format!("{value}\" unit=\"{}", escape(unit)),
            Written::Real { value, unit: None } => value.to_string(),
            Written::Integer(value) => value.to_string(),
            Written::Boolean(value) => value.to_string(),
            Written::Text(text) | Written::Enumeration(text) => escape(text),
        };
        let word = parameter.value.word();
        let name = escape(&parameter.name);
        text.push_str(&format!(
            "    <ssv:Parameter name=\"{name}\"><ssv:{word} value=\"{value}\"/></ssv:Parameter>\n"
        ));
    }
    text.push_str("  </ssv:Parameters>\n</ssv:ParameterSet>\n");
    text
}

/// The file of a structure. Of parameter bindings those with a file are written.
pub fn to_xml(structure: &Structure) -> String {
    let mut text = String::from(HEAD);
    // Writing to a String cannot fail.
    let _ = write_structure(&mut text, structure);
    text
}

fn write_structure(to: &mut String, structure: &Structure) -> std::fmt::Result {
    let name = escape(&structure.name);
    let tool = concat!("heliotorque ", env!("CARGO_PKG_VERSION"));
    writeln!(to, " name=\"{name}\" generationTool=\"{tool}\">")?;
    writeln!(to, "  <ssd:System name=\"{name}\">")?;
    write_connectors(to, &structure.connectors, "    ")?;
    writeln!(to, "    <ssd:Elements>")?;
    for (place, component) in structure.components.iter().enumerate() {
        write_component(to, component, place)?;
    }
    writeln!(to, "    </ssd:Elements>")?;
    if !structure.connections.is_empty() {
        writeln!(to, "    <ssd:Connections>")?;
        for connection in &structure.connections {
            write_connection(to, connection)?;
        }
        writeln!(to, "    </ssd:Connections>")?;
    }
    if let Some(step_s) = structure.experiment.step_size {
        let [tool, schema] = OMSIMULATOR;
        let tolerance = OMSIMULATOR_TOLERANCE;
        writeln!(
            to,
            "    <ssd:Annotations>\n      <ssc:Annotation type=\"{tool}\">\n        <oms:Annotations \
             xmlns:oms=\"{schema}\">\n          <oms:SimulationInformation>\n            <oms:FixedStepMaster \
             description=\"oms-ma\" stepSize=\"{step_s}\" absoluteTolerance=\"{tolerance}\" \
             relativeTolerance=\"{tolerance}\"/>\n          </oms:SimulationInformation>\n        \
             </oms:Annotations>\n      </ssc:Annotation>\n    </ssd:Annotations>"
        )?;
    }
    writeln!(to, "  </ssd:System>")?;
    if !structure.enumerations.is_empty() {
        writeln!(to, "  <ssd:Enumerations>")?;
        for enumeration in &structure.enumerations {
            writeln!(to, "    <ssc:Enumeration name=\"{}\">", escape(&enumeration.name))?;
            for item in &enumeration.items {
                writeln!(to, "      <ssc:Item name=\"{}\" value=\"{}\"/>", escape(&item.name), item.value)?;
            }
            writeln!(to, "    </ssc:Enumeration>")?;
        }
        writeln!(to, "  </ssd:Enumerations>")?;
    }
    if !structure.units.is_empty() {
        writeln!(to, "  <ssd:Units>")?;
        structure.units.iter().try_for_each(|unit| write_unit(to, unit))?;
        writeln!(to, "  </ssd:Units>")?;
    }
    let experiment = structure.experiment;
    write!(to, "  <ssd:DefaultExperiment")?;
    for (name, value) in [("startTime", experiment.start_time), ("stopTime", experiment.stop_time)] {
        if let Some(value) = value {
            write!(to, " {name}=\"{value}\"")?;
        }
    }
    match experiment.step_size {
        Some(step_s) => writeln!(
            to,
            ">\n    <ssd:Annotations>\n      <ssc:Annotation type=\"{ANNOTATION}\">\
             <heliotorque:Step xmlns:heliotorque=\"https://heliotorque/ssp\" size=\"{step_s}\"/>\
             </ssc:Annotation>\n    </ssd:Annotations>\n  </ssd:DefaultExperiment>"
        )?,
        None => writeln!(to, "/>")?,
    }
    writeln!(to, "</ssd:SystemStructureDescription>")
}

/// A component, drawn at its place in the row of all.
fn write_component(to: &mut String, component: &Component, place: usize) -> std::fmt::Result {
    writeln!(
        to,
        "      <ssd:Component name=\"{}\" type=\"application/x-fmu-sharedlibrary\" source=\"{}\" \
         implementation=\"CoSimulation\">",
        escape(&component.name),
        escape(&component.source)
    )?;
    write_connectors(to, &component.connectors, "        ")?;
    let left_mm = place * PITCH_MM;
    writeln!(
        to,
        "        <ssd:ElementGeometry x1=\"{left_mm}\" y1=\"0\" x2=\"{}\" y2=\"{HEIGHT_MM}\"/>",
        left_mm + WIDTH_MM
    )?;
    let files = component.bindings.iter().filter_map(|binding| binding.source.as_ref());
    let files: Vec<_> = files.collect();
    if !files.is_empty() {
        writeln!(to, "        <ssd:ParameterBindings>")?;
        for file in files {
            writeln!(to, "          <ssd:ParameterBinding source=\"{}\"/>", escape(file))?;
        }
        writeln!(to, "        </ssd:ParameterBindings>")?;
    }
    writeln!(to, "      </ssd:Component>")
}

fn write_connectors(to: &mut String, connectors: &[Connector], indent: &str) -> std::fmt::Result {
    if connectors.is_empty() {
        return Ok(());
    }
    writeln!(to, "{indent}<ssd:Connectors>")?;
    for connector in connectors {
        let (name, kind) = (escape(&connector.name), connector.kind.word());
        write!(to, "{indent}  <ssd:Connector name=\"{name}\" kind=\"{kind}\"")?;
        match &connector.signal {
            None => writeln!(to, "/>")?,
            Some(signal) => {
                let attribute = match signal {
                    Signal::Real { unit: Some(unit) } => format!(" unit=\"{}\"", escape(unit)),
                    Signal::Enumeration { name } => format!(" name=\"{}\"", escape(name)),
                    _ => String::new(),
                };
                writeln!(to, "><ssc:{}{attribute}/></ssd:Connector>", signal.word())?;
            }
        }
    }
    writeln!(to, "{indent}</ssd:Connectors>")
}

fn write_connection(to: &mut String, connection: &Connection) -> std::fmt::Result {
    write!(to, "      <ssd:Connection")?;
    for (end, element, connector) in [
        (&connection.start, "startElement", "startConnector"),
        (&connection.end, "endElement", "endConnector"),
    ] {
        if let Some(component) = &end.component {
            write!(to, " {element}=\"{}\"", escape(component))?;
        }
        write!(to, " {connector}=\"{}\"", escape(&end.connector))?;
    }
    if connection.suppress_unit_conversion {
        write!(to, " suppressUnitConversion=\"true\"")?;
    }
    match connection.transformation {
        None => writeln!(to, "/>"),
        Some(linear) => writeln!(
            to,
            "><ssc:LinearTransformation factor=\"{}\" offset=\"{}\"/></ssd:Connection>",
            linear.factor, linear.offset
        ),
    }
}

fn write_unit(to: &mut String, unit: &Unit) -> std::fmt::Result {
    write!(to, "    <ssc:Unit name=\"{}\"><ssc:BaseUnit", escape(&unit.name))?;
    let base = unit.base.unwrap_or_default();
    for (name, exponent) in base.exponents() {
        if exponent != 0 {
            write!(to, " {name}=\"{exponent}\"")?;
        }
    }
    for (name, number, default) in [("factor", base.factor, 1.0), ("offset", base.offset, 0.0)] {
        if number != default {
            write!(to, " {name}=\"{number}\"")?;
        }
    }
    writeln!(to, "/></ssc:Unit>")
}

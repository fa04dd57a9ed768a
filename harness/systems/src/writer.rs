//! Writes `SystemStructure.ssd` (SSP 1.0): UTF-8, in the schema's order, the same bytes for the same structure.

use files::ANNOTATION;
use model_description::{Unit, Writer};

use crate::structure::{Component, Connection, Connector, ParameterSet, Signal, Structure, Written};

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
    let mut out = Writer::new();
    out.element("ssv:ParameterSet", |out| {
        out.shown("xmlns:ssv", "http://ssp-standard.org/SSP1/SystemStructureParameterValues");
        out.shown("version", "1.0");
        out.shown("name", &set.name);
        out.list("ssv:Parameters", &set.parameters, |out, parameter| {
            out.inline("ssv:Parameter", |out| {
                out.shown("name", &parameter.name);
                out.element(format!("ssv:{}", parameter.value.word()), |out| value(out, &parameter.value));
            });
        });
    });
    out.finish()
}

fn value(out: &mut Writer, written: &Written) {
    match written {
        Written::Real { value, unit } => {
            out.shown("value", value);
            unit.iter().for_each(|unit| out.shown("unit", unit));
        }
        Written::Integer(value) => out.shown("value", value),
        Written::Boolean(value) => out.shown("value", value),
        Written::Text(text) | Written::Enumeration(text) => out.shown("value", text),
    }
}

/// The file of a structure. Of parameter bindings those with a file are written.
pub fn to_xml(structure: &Structure) -> String {
    let mut out = Writer::new();
    out.element("ssd:SystemStructureDescription", |out| {
        out.shown("xmlns:ssc", "http://ssp-standard.org/SSP1/SystemStructureCommon");
        out.shown("xmlns:ssd", "http://ssp-standard.org/SSP1/SystemStructureDescription");
        out.shown("version", "1.0");
        out.shown("name", &structure.name);
        out.shown("generationTool", concat!("heliotorque ", env!("CARGO_PKG_VERSION")));
        out.element("ssd:System", |out| system(out, structure));
        out.list("ssd:Enumerations", &structure.enumerations, |out, enumeration| {
            out.element("ssc:Enumeration", |out| {
                out.shown("name", &enumeration.name);
                for item in &enumeration.items {
                    out.element("ssc:Item", |out| {
                        out.shown("name", &item.name);
                        out.shown("value", item.value);
                    });
                }
            });
        });
        out.list("ssd:Units", &structure.units, unit);
        out.element("ssd:DefaultExperiment", |out| experiment(out, structure));
    });
    out.finish()
}

fn system(out: &mut Writer, structure: &Structure) {
    out.shown("name", &structure.name);
    out.list("ssd:Connectors", &structure.connectors, connector);
    out.element("ssd:Elements", |out| {
        for (place, it) in structure.components.iter().enumerate() {
            out.element("ssd:Component", |out| component(out, it, place));
        }
    });
    out.list("ssd:Connections", &structure.connections, connection);
    let Some(step_s) = structure.experiment.step_size else { return };
    let [tool, schema] = OMSIMULATOR;
    let master = |out: &mut Writer| {
        out.shown("description", "oms-ma");
        out.shown("stepSize", step_s);
        out.shown("absoluteTolerance", OMSIMULATOR_TOLERANCE);
        out.shown("relativeTolerance", OMSIMULATOR_TOLERANCE);
    };
    out.element("ssd:Annotations", |out| {
        out.element("ssc:Annotation", |out| {
            out.shown("type", tool);
            out.element("oms:Annotations", |out| {
                out.shown("xmlns:oms", schema);
                out.element("oms:SimulationInformation", |out| out.element("oms:FixedStepMaster", master));
            });
        });
    });
}

/// A component, drawn at its place in the row of all.
fn component(out: &mut Writer, component: &Component, place: usize) {
    out.shown("name", &component.name);
    out.shown("type", "application/x-fmu-sharedlibrary");
    out.shown("source", &component.source);
    out.shown("implementation", "CoSimulation");
    out.list("ssd:Connectors", &component.connectors, connector);
    out.element("ssd:ElementGeometry", |out| {
        let left_mm = place * PITCH_MM;
        for (corner, at_mm) in [("x1", left_mm), ("y1", 0), ("x2", left_mm + WIDTH_MM), ("y2", HEIGHT_MM)] {
            out.shown(corner, at_mm);
        }
    });
    let files = component.bindings.iter().filter_map(|binding| binding.source.as_ref());
    out.list("ssd:ParameterBindings", &files.collect::<Vec<_>>(), |out, file| {
        out.element("ssd:ParameterBinding", |out| out.shown("source", file));
    });
}

fn connector(out: &mut Writer, connector: &Connector) {
    out.inline("ssd:Connector", |out| {
        out.shown("name", &connector.name);
        out.shown("kind", connector.kind.word());
        let Some(signal) = &connector.signal else { return };
        out.element(format!("ssc:{}", signal.word()), |out| match signal {
            Signal::Real { unit: Some(unit) } => out.shown("unit", unit),
            Signal::Enumeration { name } => out.shown("name", name),
            _ => {}
        });
    });
}

fn connection(out: &mut Writer, connection: &Connection) {
    out.inline("ssd:Connection", |out| {
        for (end, element, connector) in [
            (&connection.start, "startElement", "startConnector"),
            (&connection.end, "endElement", "endConnector"),
        ] {
            end.component.iter().for_each(|component| out.shown(element, component));
            out.shown(connector, &end.connector);
        }
        if connection.suppress_unit_conversion {
            out.shown("suppressUnitConversion", true);
        }
        if let Some(linear) = connection.transformation {
            out.element("ssc:LinearTransformation", |out| {
                out.shown("factor", linear.factor);
                out.shown("offset", linear.offset);
            });
        }
    });
}

fn unit(out: &mut Writer, unit: &Unit) {
    out.inline("ssc:Unit", |out| {
        out.shown("name", &unit.name);
        out.element("ssc:BaseUnit", |out| {
            let base = unit.base.unwrap_or_default();
            for (name, exponent) in base.exponents().into_iter().filter(|(_, exponent)| *exponent != 0) {
                out.shown(name, exponent);
            }
            for (name, number, default) in [("factor", base.factor, 1.0), ("offset", base.offset, 0.0)] {
                if number != default {
                    out.shown(name, number);
                }
            }
        });
    });
}

fn experiment(out: &mut Writer, structure: &Structure) {
    let experiment = structure.experiment;
    for (name, value) in [("startTime", experiment.start_time), ("stopTime", experiment.stop_time)] {
        value.iter().for_each(|value| out.shown(name, value));
    }
    let Some(step_s) = experiment.step_size else { return };
    out.element("ssd:Annotations", |out| {
        out.inline("ssc:Annotation", |out| {
            out.shown("type", ANNOTATION);
            out.element("heliotorque:Step", |out| {
                out.shown("xmlns:heliotorque", "https://heliotorque/ssp");
                out.shown("size", step_s);
            });
        });
    });
}

//! Reads `SystemStructure.ssd` (SSP 1.0, section 5). What cannot be simulated here is refused by its name.

use model_description::{DefaultExperiment, ReadError, Start, Xml};

use crate::{
    annotations::AnnotatedStep,
    elements::{boolean, enumerations, file, linear, list, number, refuse, required, units, unknown},
    parameter_mapping, parameter_set,
    structure::{Binding, Component, Connection, Connector, ConnectorKind, End, Mapping, Signal, Structure},
};

/// Most components of a system: each is an instance of its FMU.
pub const MAX_COMPONENTS: usize = 1000;
/// The only type of component that is simulated.
const FMU_TYPE: &str = "application/x-fmu-sharedlibrary";
/// The only types of parameters and of mappings that are read.
const SSV_TYPE: &str = "application/x-ssp-parameter-set";
const SSM_TYPE: &str = "application/x-ssp-parameter-mapping";
const CONNECTOR_TYPES: &str = "Real, Integer, Boolean, String, Enumeration, Binary";

/// Reads the bytes of a `SystemStructure.ssd`.
///
/// # Errors
/// XML that is not well-formed, and what cannot be simulated here.
pub fn read(bytes: &[u8]) -> Result<Structure, ReadError> {
    file(bytes, "SystemStructureDescription", structure)
}

fn structure(xml: &mut Xml<'_>, root: &Start) -> Result<Structure, ReadError> {
    let version = required(root, "version")?;
    if !version.starts_with("1.") {
        return Err(refuse(root, format!("attribute `version`: found {version:?}, allowed: 1.0")));
    }
    let mut structure = Structure { name: required(root, "name")?, ..Structure::default() };
    let mut has_system = false;
    let mut step = AnnotatedStep::default();
    while let Some(child) = xml.child(root)? {
        match child.local() {
            "System" => {
                has_system = true;
                system(xml, &child, &mut structure, &mut step)?;
            }
            "Enumerations" => structure.enumerations = enumerations(xml, &child)?,
            "Units" => structure.units = units(xml, &child)?,
            "DefaultExperiment" => structure.experiment = experiment(xml, &child, &mut step)?,
            "Annotations" => xml.skip(&child)?,
            _ => {
                let allowed = "System, Enumerations, Units, DefaultExperiment, Annotations";
                return Err(unknown(&child, root, allowed));
            }
        }
    }
    if !has_system {
        return Err(refuse(root, "has no System".to_owned()));
    }
    structure.experiment.step_size = step.step_s();
    Ok(structure)
}

fn system(
    xml: &mut Xml<'_>,
    start: &Start,
    structure: &mut Structure,
    step: &mut AnnotatedStep,
) -> Result<(), ReadError> {
    while let Some(child) = xml.child(start)? {
        match child.local() {
            "Elements" => elements(xml, &child, structure)?,
            "Connections" => structure.connections.extend(list(xml, &child, "Connection", connection)?),
            "ParameterBindings" => structure.bindings = list(xml, &child, "ParameterBinding", binding)?,
            "Connectors" => structure.connectors = list(xml, &child, "Connector", connector)?,
            "SignalDictionaries" => {
                return Err(refuse(&child, "signal dictionaries are not simulated here".to_owned()));
            }
            "Annotations" => step.read(xml, &child)?,
            "ElementGeometry" | "SystemGeometry" | "GraphicalElements" => xml.skip(&child)?,
            _ => {
                let allowed = "Connectors, ParameterBindings, Elements, Connections, geometry, Annotations";
                return Err(unknown(&child, start, allowed));
            }
        }
    }
    Ok(())
}

fn elements(xml: &mut Xml<'_>, start: &Start, structure: &mut Structure) -> Result<(), ReadError> {
    while let Some(child) = xml.child(start)? {
        match child.local() {
            "Component" if structure.components.len() == MAX_COMPONENTS => {
                let message = format!("one more component, allowed: at most {MAX_COMPONENTS}");
                return Err(refuse(&child, message));
            }
            "Component" => structure.components.push(component(xml, &child)?),
            "System" => {
                let name = child.attribute("name").unwrap_or_default();
                let message = format!("system {name:?} stands in a system, allowed: components alone");
                return Err(refuse(&child, message));
            }
            _ => return Err(unknown(&child, start, "Component")),
        }
    }
    Ok(())
}

fn component(xml: &mut Xml<'_>, start: &Start) -> Result<Component, ReadError> {
    let name = required(start, "name")?;
    for (key, allowed) in [("type", &[FMU_TYPE][..]), ("implementation", &["any", "CoSimulation"])] {
        if let Some(found) = start.attribute(key).filter(|found| !allowed.contains(found)) {
            let allowed = allowed.join(", ");
            let message = format!("component {name:?}: {key} {found:?} is not simulated, allowed: {allowed}");
            return Err(refuse(start, message));
        }
    }
    let source = required(start, "source")?;
    let mut component = Component { name, source, line: start.line, ..Component::default() };
    while let Some(child) = xml.child(start)? {
        match child.local() {
            "Connectors" => component.connectors = list(xml, &child, "Connector", connector)?,
            "ParameterBindings" => component.bindings = list(xml, &child, "ParameterBinding", binding)?,
            "ElementGeometry" | "Annotations" => xml.skip(&child)?,
            _ => {
                let allowed = "Connectors, ParameterBindings, ElementGeometry, Annotations";
                return Err(unknown(&child, start, allowed));
            }
        }
    }
    Ok(component)
}

fn connector(xml: &mut Xml<'_>, start: &Start) -> Result<Connector, ReadError> {
    let name = required(start, "name")?;
    let word = required(start, "kind")?;
    let Some((kind, _)) = ConnectorKind::WORDS.into_iter().find(|(_, known)| *known == word) else {
        let allowed = ConnectorKind::WORDS.map(|(_, word)| word).join(", ");
        let message = format!("connector {name:?}: found kind {word:?}, allowed: {allowed}");
        return Err(refuse(start, message));
    };
    let mut signal = None;
    while let Some(child) = xml.child(start)? {
        match child.local() {
            "Real" => {
                signal = Some(Signal::Real { unit: child.attribute("unit").map(str::to_owned) });
            }
            "Integer" => signal = Some(Signal::Integer),
            "Boolean" => signal = Some(Signal::Boolean),
            "String" => signal = Some(Signal::Text),
            "Binary" => signal = Some(Signal::Binary),
            "Enumeration" => signal = Some(Signal::Enumeration { name: required(&child, "name")? }),
            "ConnectorGeometry" | "Annotations" => {}
            _ => return Err(unknown(&child, start, CONNECTOR_TYPES)),
        }
        xml.skip(&child)?;
    }
    Ok(Connector { name, kind, signal, line: start.line })
}

fn connection(xml: &mut Xml<'_>, start: &Start) -> Result<Connection, ReadError> {
    let end = |element: &str, connector: &str| {
        Ok::<_, ReadError>(End {
            component: start.attribute(element).map(str::to_owned),
            connector: required(start, connector)?,
        })
    };
    let mut connection = Connection {
        start: end("startElement", "startConnector")?,
        end: end("endElement", "endConnector")?,
        transformation: None,
        suppress_unit_conversion: boolean(start, "suppressUnitConversion")?.unwrap_or(false),
        line: start.line,
    };
    while let Some(child) = xml.child(start)? {
        match child.local() {
            "LinearTransformation" => {
                connection.transformation = Some(linear(&child)?);
            }
            "ConnectionGeometry" | "Annotations" => {}
            _ => return Err(unknown(&child, start, "LinearTransformation")),
        }
        xml.skip(&child)?;
    }
    Ok(connection)
}

fn binding(xml: &mut Xml<'_>, start: &Start) -> Result<Binding, ReadError> {
    check_source(start, SSV_TYPE)?;
    let mut binding = Binding {
        source: start.attribute("source").map(str::to_owned),
        prefix: start.attribute("prefix").unwrap_or_default().to_owned(),
        sets: Vec::new(),
        mapping: None,
        line: start.line,
    };
    while let Some(child) = xml.child(start)? {
        match child.local() {
            "ParameterValues" => {
                binding.sets.extend(list(xml, &child, "ParameterSet", parameter_set::element)?);
            }
            "ParameterMapping" => {
                check_source(&child, SSM_TYPE)?;
                let inline = list(xml, &child, "ParameterMapping", parameter_mapping::element)?;
                let source = child.attribute("source").map(str::to_owned);
                binding.mapping = Some(Mapping { source, entries: inline.into_iter().flatten().collect() });
            }
            "Annotations" => xml.skip(&child)?,
            _ => return Err(unknown(&child, start, "ParameterValues, ParameterMapping, Annotations")),
        }
    }
    Ok(binding)
}

/// Refuses a source of another type than this, and one that stands in a component.
fn check_source(start: &Start, media_type: &str) -> Result<(), ReadError> {
    for (key, allowed) in [("type", media_type), ("sourceBase", "SSD")] {
        if let Some(found) = start.attribute(key).filter(|found| *found != allowed) {
            return Err(refuse(start, format!("{key} {found:?} is not read, allowed: {allowed}")));
        }
    }
    Ok(())
}

fn experiment(
    xml: &mut Xml<'_>,
    start: &Start,
    step: &mut AnnotatedStep,
) -> Result<DefaultExperiment, ReadError> {
    let (start_time, stop_time) = (number(start, "startTime")?, number(start, "stopTime")?);
    list(xml, start, "Annotations", |xml, annotations| step.read(xml, annotations))?;
    Ok(DefaultExperiment { start_time, stop_time, ..DefaultExperiment::default() })
}

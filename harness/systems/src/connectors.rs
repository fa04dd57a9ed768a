//! Connectors of components, with the units and enumerations that their types need, and the connections between them.

use fmi::Fmu;
use model_description::{Description, EnumerationItem, ScalarVariable, Unit, VariableKind, value};

use crate::{
    joint::is_same_item,
    structure::{Connection, Connector, ConnectorKind, End, Enumeration, Signal, Structure},
};

/// With nothing on the way.
pub(crate) fn connection(start: End, end: End) -> Connection {
    Connection { start, end, transformation: None, suppress_unit_conversion: false, line: 0 }
}

/// Lists a variable as a connector, with what its type needs, once.
pub(crate) fn add_connector(
    structure: &mut Structure,
    components: &[(String, Fmu)],
    (number, variable): (usize, &ScalarVariable),
    kind: ConnectorKind,
) {
    let connectors = &structure.components[number].connectors;
    if connectors.iter().any(|it| it.name == variable.name) {
        return;
    }
    let (component, fmu) = &components[number];
    let description = fmu.description();
    let signal = match &variable.kind {
        VariableKind::Real { .. } => {
            // The two names of no dimension stay as the FMU has them.
            let unit = value::unit(description, variable).map(str::to_owned);
            let definition = description.units.iter().find(|it| Some(&it.name) == unit.as_ref());
            let definition = definition.filter(|it| it.base.is_some());
            if let Some(definition) = definition
                && !structure.units.iter().any(|it| it.name == definition.name)
            {
                structure.units.push(Unit { display_units: Vec::new(), ..definition.clone() });
            }
            Signal::Real { unit: unit.filter(|_| definition.is_some()) }
        }
        VariableKind::Integer { .. } => Signal::Integer,
        VariableKind::Boolean { .. } => Signal::Boolean,
        VariableKind::String { .. } => Signal::Text,
        VariableKind::Enumeration { declared_type, .. } => {
            let name = enumeration(structure, component, (description, variable), declared_type);
            Signal::Enumeration { name }
        }
    };
    let connector = Connector { name: variable.name.clone(), kind, signal: Some(signal), line: 0 };
    structure.components[number].connectors.push(connector);
}

/// The system's name of an Enumeration; one of other items under a known name takes its component's before it.
fn enumeration(
    structure: &mut Structure,
    component: &str,
    (description, variable): (&Description, &ScalarVariable),
    declared_type: &str,
) -> String {
    let items = value::items(description, variable).to_vec();
    let is_same = |known: &Enumeration| {
        let same = |(one, other): (&EnumerationItem, &EnumerationItem)| is_same_item(one, other);
        known.items.len() == items.len() && known.items.iter().zip(&items).all(same)
    };
    let mut name = declared_type.to_owned();
    if structure.enumerations.iter().any(|known| known.name == name && !is_same(known)) {
        name = format!("{component}.{declared_type}");
    }
    if !structure.enumerations.iter().any(|known| known.name == name) {
        structure.enumerations.push(Enumeration { name: name.clone(), items });
    }
    name
}

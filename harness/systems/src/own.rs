//! The system's own connectors (SSP 1.0, section 5.3): variables of components that a user of the system sets and reads by the
//! connectors' names, in the connectors' units.

use fmi::{Fmu, Value};
use model_description::VariableKind;

use crate::{
    joint::ConnectedVariable,
    merged::{Merged, add_unit},
    structure::{Connector, Linear, Signal, Structure},
};

/// A connector of the system and the variables that it is connected to: of an output one.
#[derive(Clone, Debug, PartialEq)]
pub struct Own {
    /// The connector.
    pub connector: Connector,
    /// The variables.
    pub places: Vec<ConnectedVariable>,
    /// Line of the last connection.
    line: u32,
}

impl Own {
    /// Not connected yet.
    pub fn new(connector: &Connector) -> Self {
        Self { connector: connector.clone(), places: Vec::new(), line: 0 }
    }

    /// Connects it; of an output that is connected already the line where.
    pub fn join(&mut self, place: ConnectedVariable, line: u32) -> Option<u32> {
        let taken = !self.gives() && !self.places.is_empty();
        self.places.push(place);
        let before = std::mem::replace(&mut self.line, line);
        taken.then_some(before)
    }

    /// Whether it gives values to components.
    pub fn gives(&self) -> bool {
        self.connector.kind != crate::structure::ConnectorKind::Output
    }

    /// Whether it gives values to this variable.
    pub fn has(&self, number: usize, position: usize) -> bool {
        self.gives() && self.places.iter().any(|place| place.at == (number, position))
    }
}

impl ConnectedVariable {
    /// A value on its way to the variable, or from it.
    pub fn convert(self, value: &Value) -> Value {
        match value {
            Value::Real(value) if self.linear != Linear::IDENTITY => Value::Real(self.linear.apply(*value)),
            value => value.clone(),
        }
    }
}

/// Adds a connector to the description: the variable it is connected to first, in the connector's unit.
pub(crate) fn describe(
    merged: &mut Merged,
    structure: &Structure,
    fmus: &[Fmu],
    own: &Own,
) -> Result<(), String> {
    let Connector { name, signal, .. } = &own.connector;
    let Some((number, position)) = own.places.first().map(|place| place.at) else { return Ok(()) };
    if merged.description.variables.iter().any(|it| it.name == *name) {
        return Err(
            "found the name of a variable or of another connector, allowed: a name of its own".to_owned()
        );
    }
    let inner = &fmus[number].description().variables[position];
    let prefix = &structure.components[number].name;
    let mut variable = merged
        .description
        .variables
        .iter()
        .find(|it| it.name == format!("{prefix}.{}", inner.name))
        .cloned()
        .unwrap_or_else(|| inner.clone());
    name.clone_into(&mut variable.name);
    if let VariableKind::Real { attributes, declared_type, start, .. } = &mut variable.kind
        && let Some(Signal::Real { unit: Some(unit) }) = signal
        && own.places[0].linear != Linear::IDENTITY
    {
        // Limits and start value are those of the variable, in its unit.
        (*declared_type, *start) = (None, None);
        *attributes = model_description::RealAttributes { unit: Some(unit.clone()), ..Default::default() };
        structure
            .units
            .iter()
            .filter(|it| it.name == *unit)
            .for_each(|it| add_unit(&mut merged.description.units, it));
    }
    merged.description.variables.push(variable);
    Ok(())
}

//! All variables of a system in one description, named `component.variable`, as runs and tables read them.

use fmi::Fmu;
use model_description::{
    DefaultExperiment, Description, NamingConvention, ScalarVariable, SimpleType, Unit, VariableKind,
};

/// The variables of all components, and of each its component and position there.
pub(crate) struct Merged {
    /// The description; value references are those of the FMUs and therefore not unique.
    pub description: Description,
    /// Component and position in its `ModelVariables` of every variable.
    pub origins: Vec<(usize, usize)>,
}

/// Merges the descriptions of named components.
pub(crate) fn merge<'a>(
    name: &str,
    experiment: DefaultExperiment,
    components: impl Iterator<Item = (&'a str, &'a Fmu)>,
) -> Merged {
    let mut description = Description {
        model_name: name.to_owned(),
        variable_naming: NamingConvention::Structured,
        default_experiment: Some(experiment),
        ..Description::default()
    };
    let mut origins = Vec::new();
    for (number, (component, fmu)) in components.enumerate() {
        let own = fmu.description();
        own.units.iter().for_each(|unit| add_unit(&mut description.units, unit));
        let prefixed = |name: &str| format!("{component}.{name}");
        description
            .types
            .extend(own.types.iter().map(|it| SimpleType { name: prefixed(&it.name), ..it.clone() }));
        for (position, variable) in own.variables.iter().enumerate() {
            let mut kind = variable.kind.clone();
            match &mut kind {
                VariableKind::Real { declared_type, .. }
                | VariableKind::Integer { declared_type, .. }
                | VariableKind::Boolean { declared_type, .. }
                | VariableKind::String { declared_type, .. } => {
                    *declared_type = declared_type.as_deref().map(prefixed);
                }
                VariableKind::Enumeration { declared_type, .. } => *declared_type = prefixed(declared_type),
            }
            let mut annotation = variable.annotation.clone();
            let names = annotation.iter_mut().flat_map(|it| it.own_names_mut());
            names.for_each(|name| *name = prefixed(name));
            description.variables.push(ScalarVariable {
                name: prefixed(&variable.name),
                kind,
                annotation,
                ..variable.clone()
            });
            origins.push((number, position));
        }
    }
    Merged { description, origins }
}

/// Adds a unit. One that means something else in two FMUs loses its definition: its numbers are shown as they are.
pub(crate) fn add_unit(units: &mut Vec<Unit>, unit: &Unit) {
    let Some(known) = units.iter_mut().find(|known| known.name == unit.name) else {
        units.push(unit.clone());
        return;
    };
    if known.base != unit.base {
        known.base = None;
        known.display_units.clear();
        return;
    }
    for display in &unit.display_units {
        if !known.display_units.iter().any(|it| it.name == display.name) {
            known.display_units.push(display.clone());
        }
    }
}

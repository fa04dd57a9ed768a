//! A variable as the search knows it: its index in the tables, its limits, and a change of it that matters.

use std::collections::BTreeMap;

use fmi_export::model_description::{Causality, Description, Initial, SimpleTypeKind, VariableKind, rules};

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Base {
    Real,
    Integer,
    Boolean,
    Text,
}

pub(super) struct Variable {
    pub name: String,
    pub base: Base,
    /// Place in the table of its base type.
    pub slot: usize,
    pub input: bool,
    /// An input, or a parameter with `initial="exact"`.
    pub exact: bool,
    pub unit: String,
    pub nominal: f64,
    pub min: f64,
    pub max: f64,
    /// Items of an enumeration.
    pub items: Vec<i32>,
    /// All elements of its vector or matrix.
    pub group: Vec<usize>,
}

/// A change of a Real that matters, by its unit.
pub(super) fn natural(unit: &str) -> f64 {
    match unit {
        "rad" => 0.7,
        "rad/s" => 1e-3,
        "s" => 1e4,
        "m" => 0.3,
        "m/s" => 2500.0,
        "kg" | "K" => 30.0,
        "kg.m" => 1e-4,
        "kg.m2" => 5.0,
        "N" | "N.m" => 1e-3,
        "N.m.s" => 3.0,
        _ => 0.1,
    }
}

pub(super) fn variables(description: &Description) -> Vec<Variable> {
    let mut counts = [0; 4];
    let mut groups: BTreeMap<String, Vec<usize>> = BTreeMap::new();
    let group_of = |name: &str| match name.strip_suffix(']').and_then(|name| name.rsplit_once('[')) {
        Some((vector, _)) => vector.to_owned(),
        None => name.to_owned(),
    };
    for (at, variable) in description.variables.iter().enumerate() {
        groups.entry(group_of(&variable.name)).or_default().push(at);
    }
    let mut found = Vec::new();
    for variable in &description.variables {
        let (base, unit, nominal, min, max) = match &variable.kind {
            VariableKind::Real { attributes, .. } => (
                Base::Real,
                attributes.unit.clone().unwrap_or_default(),
                attributes.nominal.unwrap_or(1.0),
                attributes.min,
                attributes.max,
            ),
            VariableKind::Integer { min, max, .. } => {
                (Base::Integer, String::new(), 1.0, min.map(f64::from), max.map(f64::from))
            }
            VariableKind::Enumeration { .. } => (Base::Integer, String::new(), 1.0, None, None),
            VariableKind::Boolean { .. } => (Base::Boolean, String::new(), 1.0, None, None),
            VariableKind::String { .. } => (Base::Text, String::new(), 1.0, None, None),
        };
        let items = match &variable.kind {
            VariableKind::Enumeration { declared_type, .. } => items_of(description, declared_type),
            _ => Vec::new(),
        };
        let count = &mut counts[base as usize];
        found.push(Variable {
            base,
            slot: *count,
            input: variable.causality == Causality::Input,
            exact: variable.causality == Causality::Input
                || variable.causality == Causality::Parameter
                    && rules::effective_initial(variable) == Some(Initial::Exact),
            unit,
            nominal,
            min: min.unwrap_or(f64::NEG_INFINITY),
            max: max.unwrap_or(f64::INFINITY),
            items,
            group: groups[&group_of(&variable.name)].clone(),
            name: variable.name.clone(),
        });
        *count += 1;
    }
    found
}

fn items_of(description: &Description, name: &str) -> Vec<i32> {
    let found = description.types.iter().find(|known| known.name == name);
    match found.map(|known| &known.kind) {
        Some(SimpleTypeKind::Enumeration { items, .. }) => items.iter().map(|item| item.value).collect(),
        _ => Vec::new(),
    }
}

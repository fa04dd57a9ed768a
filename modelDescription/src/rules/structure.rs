//! Variables that `ModelStructure` must list (2.2.8).

use std::collections::BTreeSet;

use crate::{Causality, Initial, ModelStructure, ScalarVariable, Unknown, VariableKind};

use super::effective_initial;

/// The structure of a co-simulation FMU that exposes no derivatives: exactly the outputs, and exactly the
/// unknowns of initialization in ascending order, each depending on everything (`dependencies` absent).
pub fn structure(variables: &[ScalarVariable]) -> ModelStructure {
    let unknowns = |indices: Vec<u32>| {
        indices.into_iter().map(|index| Unknown { index, ..Unknown::default() }).collect()
    };
    ModelStructure {
        outputs: unknowns(outputs(variables)),
        derivatives: Vec::new(),
        initial_unknowns: unknowns(initial_unknowns(variables, &[])),
    }
}

/// 1-based indices of the variables with causality output, ascending.
pub fn outputs(variables: &[ScalarVariable]) -> Vec<u32> {
    indexed(variables).filter(|(_, v)| v.causality == Causality::Output).map(|(index, _)| index).collect()
}

/// 1-based indices that `InitialUnknowns` must list, ascending: outputs with initial approx or calculated,
/// calculated parameters, and, for every entry of `derivatives`, the derivative and its state where their
/// initial is approx or calculated. Entries that name no variable are skipped.
pub fn initial_unknowns(variables: &[ScalarVariable], derivatives: &[Unknown]) -> Vec<u32> {
    let computed =
        |v: &ScalarVariable| matches!(effective_initial(v), Some(Initial::Approx | Initial::Calculated));
    let at = |index: u32| index.checked_sub(1).and_then(|i| variables.get(i as usize));
    let mut found: BTreeSet<u32> = indexed(variables)
        .filter(|(_, v)| match v.causality {
            Causality::Output => computed(v),
            Causality::CalculatedParameter => true,
            _ => false,
        })
        .map(|(index, _)| index)
        .collect();
    for unknown in derivatives {
        let Some(derivative) = at(unknown.index) else { continue };
        if computed(derivative) {
            found.insert(unknown.index);
        }
        if let VariableKind::Real { derivative: Some(state), .. } = &derivative.kind
            && at(*state).is_some_and(computed)
        {
            found.insert(*state);
        }
    }
    found.into_iter().collect()
}

fn indexed(variables: &[ScalarVariable]) -> impl Iterator<Item = (u32, &ScalarVariable)> {
    (1..).zip(variables)
}

//! From a model's dependencies to `ModelStructure` (FMI 2.0.5, 2.2.8).

use std::collections::BTreeMap;

use model_description::{Causality, Initial, ModelStructure, ScalarVariable, Unknown, Variability, rules};

use super::references;
use crate::dependencies::{Dependencies, Knowns};
use crate::variables::Element;

/// The structure of a co-simulation FMU with these variables.
///
/// Of each set counts what the standard admits. The error names an unknown without a row, or a handle that is no variable's.
pub(crate) fn structure(
    dependencies: &Dependencies,
    variables: &[ScalarVariable],
) -> Result<ModelStructure, String> {
    let keys: Vec<Option<Element>> =
        variables.iter().map(|variable| references::element(variable.value_reference)).collect();
    let mut index_of: [Vec<Option<u32>>; Element::TABLES] = Default::default();
    for (key, index) in keys.iter().zip(1..).filter_map(|(key, index)| Some(((*key)?, index))) {
        let (indices, place) = (&mut index_of[key.table()], key.place as usize);
        indices.resize(indices.len().max(place + 1), None);
        indices[place] = Some(index);
    }
    let is_input: Vec<bool> = variables.iter().map(|it| it.causality == Causality::Input).collect();
    let is_exact_parameter = |it: &ScalarVariable| {
        it.causality == Causality::Parameter && rules::effective_initial(it) == Some(Initial::Exact)
    };
    let is_exact_parameter = variables.iter().map(is_exact_parameter).collect();
    let lists = Lists { variables, keys: &keys, index_of: &index_of, is_input, is_exact_parameter };
    let (mut inputs_of_last, mut parameters_of_last) = (LastList::default(), LastList::default());
    let mut structure = rules::structure(variables);
    for unknown in &mut structure.outputs {
        let inputs = lists.row(unknown, &dependencies.at_steps)?;
        unknown.dependencies = Some(lists.indices(inputs, &lists.is_input, &mut inputs_of_last)?);
    }
    for unknown in &mut structure.initial_unknowns {
        let parameters = lists.row(unknown, &dependencies.at_start)?;
        let mut indices = lists.indices(parameters, &lists.is_exact_parameter, &mut parameters_of_last)?;
        if variables[unknown.index as usize - 1].causality == Causality::Output {
            let at_once = lists.row(unknown, &dependencies.at_steps)?;
            let inputs = match lists.keys[unknown.index as usize - 1] {
                Some(key) => dependencies.inputs_at_start.get(&key).map(|more| more.clone().and(at_once)),
                None => None,
            };
            let inputs = inputs.as_ref().unwrap_or(at_once);
            indices.extend(lists.indices(inputs, &lists.is_input, &mut inputs_of_last)?);
            // The stable sort merges two ascending runs.
            indices.sort();
        }
        unknown.dependencies = Some(indices);
    }
    Ok(structure)
}

/// The variables, to write lists of their indices.
struct Lists<'a> {
    variables: &'a [ScalarVariable],
    keys: &'a [Option<Element>],
    /// By table and place.
    index_of: &'a [Vec<Option<u32>>; Element::TABLES],
    is_input: Vec<bool>,
    is_exact_parameter: Vec<bool>,
}

const NOTHING: &Knowns = &Knowns::NONE;

/// The last set and its indices; most consecutive unknowns share a set.
type LastList = Option<(Knowns, Vec<u32>)>;

impl Lists<'_> {
    /// The row of an unknown, nothing for a constant.
    fn row<'r>(&self, unknown: &Unknown, rows: &'r BTreeMap<Element, Knowns>) -> Result<&'r Knowns, String> {
        let at = unknown.index as usize - 1;
        let variable = &self.variables[at];
        let row = self.keys[at].and_then(|key| rows.get(&key));
        let row = row.or_else(|| (variable.variability == Variability::Constant).then_some(NOTHING));
        row.ok_or_else(|| format!("`{}` has no row in the model's dependencies", variable.name))
    }

    /// The indices of what of a set is admitted, ascending. `dependenciesKind` stays absent, which stands for `dependent`.
    fn indices(
        &self,
        knowns: &Knowns,
        is_admitted: &[bool],
        last: &mut LastList,
    ) -> Result<Vec<u32>, String> {
        if let Some((set, indices)) = last
            && set == knowns
        {
            return Ok(indices.clone());
        }
        let mut indices = Vec::with_capacity(knowns.len());
        for known in knowns.elements() {
            let index = self.index(known)?;
            if is_admitted[index as usize - 1] {
                indices.push(index);
            }
        }
        // Ascending within each table already, which the stable sort makes use of.
        indices.sort();
        *last = Some((knowns.clone(), indices.clone()));
        Ok(indices)
    }

    fn index(&self, element: Element) -> Result<u32, String> {
        let index = self.index_of[element.table()].get(element.place as usize).copied().flatten();
        index.ok_or_else(|| {
            let Element { base, place } = element;
            format!("the model's dependencies name {base}({place}), which is no element of a variable")
        })
    }
}

#[cfg(test)]
mod tests;

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
        let (indices, place) = (&mut index_of[key.table()], key.place() as usize);
        indices.resize(indices.len().max(place + 1), None);
        indices[place] = Some(index);
    }
    let is_input: Vec<bool> = variables.iter().map(|it| it.causality == Causality::Input).collect();
    let is_exact_parameter = |it: &ScalarVariable| {
        it.causality == Causality::Parameter && rules::effective_initial(it) == Some(Initial::Exact)
    };
    let is_exact_parameter = variables.iter().map(is_exact_parameter).collect();
    let lists = Lists { variables, keys: &keys, index_of: &index_of, is_input, is_exact_parameter };
    let mut structure = rules::structure(variables);
    for unknown in &mut structure.outputs {
        let inputs = lists.row(unknown, dependencies.at_steps())?;
        unknown.dependencies = Some(lists.indices(inputs, &lists.is_input)?);
    }
    for unknown in &mut structure.initial_unknowns {
        let parameters = lists.row(unknown, dependencies.at_start())?;
        let mut indices = lists.indices(parameters, &lists.is_exact_parameter)?;
        if variables[unknown.index as usize - 1].causality == Causality::Output {
            let inputs = lists.row(unknown, dependencies.at_steps())?;
            indices.extend(lists.indices(inputs, &lists.is_input)?);
            indices.sort_unstable();
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
    fn indices(&self, knowns: &Knowns, is_admitted: &[bool]) -> Result<Vec<u32>, String> {
        let mut indices = Vec::with_capacity(knowns.len());
        for known in knowns.elements() {
            let index = self.index(known)?;
            if is_admitted[index as usize - 1] {
                indices.push(index);
            }
        }
        // Ascending within each table already, which the stable sort makes use of.
        indices.sort();
        Ok(indices)
    }

    fn index(&self, element: Element) -> Result<u32, String> {
        let index = self.index_of[element.table()].get(element.place() as usize).copied().flatten();
        index.ok_or_else(|| {
            format!("the model's dependencies name {element:?}, which is no element of a variable")
        })
    }
}

#[cfg(test)]
mod tests {
    use model_description::{Causality, Initial, ScalarVariable, Variability};

    use super::structure;
    use crate::fmi2::description::scalar_variables;
    use crate::variables::{Boolean, Declare, Integer, Real, RealSpec, RealVector, Role, ScalarSpec, Text};
    use crate::{Dependencies, knowns};

    struct Handles {
        parameter: Text,
        flag: Boolean,
        force: RealVector<3>,
        count: Integer,
        size: Real,
        exact: Integer,
    }

    const PARAMETER: Role =
        Role { causality: Causality::Parameter, variability: Variability::Fixed, initial: None };
    const INPUT: Role =
        Role { causality: Causality::Input, variability: Variability::Discrete, initial: None };
    const OUTPUT: Role =
        Role { causality: Causality::Output, variability: Variability::Discrete, initial: None };

    /// A String parameter, a Boolean input, a vector input, a constant, an Integer and a Real output, an exact output.
    fn declared() -> (Vec<ScalarVariable>, Handles) {
        let mut declare = Declare::new();
        let scalar = |name, role| ScalarSpec { name, description: "For the test.", role };
        let real = |name, role| RealSpec {
            name,
            description: "For the test.",
            role,
            unit: "N",
            display_unit: None,
            min: None,
            max: None,
            nominal: None,
        };
        let constant = Role { variability: Variability::Constant, ..OUTPUT };
        let exact = Role { initial: Some(Initial::Exact), ..OUTPUT };
        let handles = Handles {
            parameter: declare.text(&scalar("label", PARAMETER), Some("x")).unwrap(),
            flag: declare.boolean(&scalar("flag", INPUT), Some(false)).unwrap(),
            force: declare.real_vector(&real("force", INPUT), Some([0.0; 3])).unwrap(),
            count: {
                declare.real(&real("one", constant), Some(1.0)).unwrap();
                declare.integer(&scalar("count", OUTPUT), None, None, None).unwrap()
            },
            size: declare.real(&real("size", OUTPUT), None).unwrap(),
            exact: declare.integer(&scalar("exact", exact), Some(7), None, None).unwrap(),
        };
        (scalar_variables(&declare.finish()), handles)
    }

    fn table(v: &Handles) -> Dependencies {
        let mut table = Dependencies::new();
        let force = &knowns![v.force];
        table.output(v.count, v.flag, knowns![v.force.element(1), v.parameter]);
        table.output(
            v.size,
            force,
            knowns![force, knowns![v.flag].only_if(true), knowns![v.count].only_if(false), v.parameter],
        );
        table.output(v.exact, v.flag, knowns![]);
        table
    }

    fn refusal(change: impl FnOnce(&mut Dependencies, &Handles)) -> String {
        let (variables, handles) = declared();
        let mut table = table(&handles);
        change(&mut table, &handles);
        structure(&table, &variables).unwrap_err()
    }

    #[test]
    fn rows_of_every_base_type_become_ascending_indices() {
        let (variables, handles) = declared();
        let structure = structure(&table(&handles), &variables).unwrap();
        let lists = |unknowns: &[model_description::Unknown]| -> Vec<(u32, Vec<u32>)> {
            unknowns.iter().map(|it| (it.index, it.dependencies.clone().unwrap())).collect()
        };
        // label 1, flag 2, force 3 to 5, one 6, count 7, size 8, exact 9
        let outputs = [(6, vec![]), (7, vec![2]), (8, vec![3, 4, 5]), (9, vec![2])];
        assert_eq!(lists(&structure.outputs), outputs);
        assert_eq!(lists(&structure.initial_unknowns), [(7, vec![1, 2]), (8, vec![1, 3, 4, 5])]);
    }

    #[test]
    fn rows_add_up() {
        let (variables, handles) = declared();
        let mut table = table(&handles);
        table.output(handles.count, handles.force.element(2), knowns![]);
        let structure = structure(&table, &variables).unwrap();
        assert_eq!(structure.outputs[1].dependencies, Some(vec![2, 5]));
    }

    #[test]
    fn an_unknown_without_a_row_is_named() {
        let (variables, _) = declared();
        let error = structure(&Dependencies::new(), &variables).unwrap_err();
        assert_eq!(error, "`count` has no row in the model's dependencies");
    }

    /// Sections hold variables of every causality.
    #[test]
    fn what_a_list_does_not_admit_is_passed_over() {
        let (variables, handles) = declared();
        let plain = structure(&table(&handles), &variables).unwrap();
        let mut table = table(&handles);
        table.output(handles.size, handles.parameter, handles.count);
        table.output(handles.flag, handles.force, knowns![]);
        table.calculated(handles.exact, handles.force);
        assert_eq!(structure(&table, &variables).unwrap(), plain);
    }

    #[test]
    fn what_acts_in_steps_acts_at_the_start() {
        let (variables, handles) = declared();
        let mut table = Dependencies::new();
        table.output(knowns![handles.count, handles.size, handles.exact], handles.force, handles.parameter);
        let structure = structure(&table, &variables).unwrap();
        assert_eq!(structure.initial_unknowns[0].dependencies, Some(vec![1, 3, 4, 5]));
    }

    #[test]
    fn a_handle_of_no_variable_is_named() {
        let found = refusal(|table, v| table.output(v.size, Real(77), v.force));
        assert_eq!(found, "the model's dependencies name Real(77), which is no element of a variable");
    }
}

//! From a model's dependencies to `ModelStructure` (FMI 2.0.5, 2.2.8).

use std::collections::{BTreeMap, BTreeSet};

use model_description::{Causality, Initial, ModelStructure, ScalarVariable, Unknown, Variability, rules};

use super::references;
use crate::dependencies::{Dependencies, Knowns};
use crate::variables::Element;

/// The structure of a co-simulation FMU with these variables.
///
/// The error names an unknown without a row, a row without an unknown, or a known that the standard does not admit.
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
    let lists = Lists { variables, keys: &keys, index_of: &index_of };
    let mut structure = rules::structure(variables);
    let input = |v: &ScalarVariable| v.causality == Causality::Input;
    let exact = |v: &ScalarVariable| {
        input(v) || v.causality == Causality::Parameter && rules::effective_initial(v) == Some(Initial::Exact)
    };
    lists.fill(&mut structure.outputs, dependencies.at_steps(), &input, "an input")?;
    lists.fill(
        &mut structure.initial_unknowns,
        dependencies.at_start(),
        &exact,
        "an input or a parameter with initial exact",
    )?;
    Ok(structure)
}

/// The variables, to write lists of their indices.
struct Lists<'a> {
    variables: &'a [ScalarVariable],
    keys: &'a [Option<Element>],
    /// By table and place.
    index_of: &'a [Vec<Option<u32>>; Element::TABLES],
}

impl Lists<'_> {
    /// Gives every unknown its `dependencies`; `dependenciesKind` stays absent, which stands for `dependent`.
    fn fill(
        &self,
        unknowns: &mut [Unknown],
        rows: &BTreeMap<Element, Knowns>,
        admitted: &dyn Fn(&ScalarVariable) -> bool,
        rule: &str,
    ) -> Result<(), String> {
        let mut left: BTreeSet<&Element> = rows.keys().collect();
        let is_admitted: Vec<bool> = self.variables.iter().map(admitted).collect();
        let nothing = Knowns::default();
        // Elements of one array often depend on the same.
        let mut previous: Option<(&Knowns, Vec<u32>)> = None;
        for unknown in unknowns {
            let at = unknown.index as usize - 1;
            let (variable, key) = (&self.variables[at], self.keys[at].as_ref());
            let row = key.and_then(|key| rows.get(key));
            if let Some(key) = key {
                left.remove(key);
            }
            let knowns = match row {
                Some(knowns) => knowns,
                None if variable.variability == Variability::Constant => &nothing,
                None => {
                    return Err(format!("`{}` has no row in the model's dependencies", variable.name));
                }
            };
            let indices = match previous.take() {
                Some((same, indices)) if same == knowns => indices,
                _ => self.indices(variable, knowns, &is_admitted, rule)?,
            };
            unknown.dependencies = Some(indices.clone());
            previous = Some((knowns, indices));
        }
        // An exact output is no unknown of initialization; its row says so by an empty list.
        left.retain(|key| rows.get(key).is_some_and(|knowns| knowns.len() > 0));
        let Some(extra) = left.first() else { return Ok(()) };
        let name = &self.variables[self.index(**extra)? as usize - 1].name;
        Err(format!("the model's dependencies have a row for `{name}`, which is no unknown there"))
    }

    /// The indices of what an unknown depends on, ascending.
    fn indices(
        &self,
        unknown: &ScalarVariable,
        knowns: &Knowns,
        is_admitted: &[bool],
        rule: &str,
    ) -> Result<Vec<u32>, String> {
        let mut indices = Vec::with_capacity(knowns.len());
        for known in knowns.elements() {
            let index = self.index(known)?;
            let at = index as usize - 1;
            if !is_admitted[at] {
                let (unknown, known) = (&unknown.name, &self.variables[at].name);
                return Err(format!("`{unknown}` depends on `{known}`, allowed: {rule}"));
            }
            indices.push(index);
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
        assert_eq!(lists(&structure.initial_unknowns), [(7, vec![1, 4]), (8, vec![1, 2, 3, 4, 5])]);
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

    #[test]
    fn what_no_list_admits_is_named() {
        let found = refusal(|table, v| table.output(v.size, v.parameter, knowns![]));
        assert_eq!(found, "`size` depends on `label`, allowed: an input");
        let found = refusal(|table, v| table.output(v.size, knowns![], v.count));
        assert_eq!(found, "`size` depends on `count`, allowed: an input or a parameter with initial exact");
        let found = refusal(|table, v| table.output(v.flag, v.force, knowns![]));
        assert_eq!(found, "the model's dependencies have a row for `flag`, which is no unknown there");
        let found = refusal(|table, v| table.calculated(v.exact, v.force));
        assert_eq!(found, "the model's dependencies have a row for `exact`, which is no unknown there");
        let found = refusal(|table, v| table.output(v.size, Real(77), v.force));
        assert_eq!(found, "the model's dependencies name Real(77), which is no element of a variable");
    }
}

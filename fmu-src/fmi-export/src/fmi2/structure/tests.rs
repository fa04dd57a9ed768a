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
const INPUT: Role = Role { causality: Causality::Input, variability: Variability::Discrete, initial: None };
const OUTPUT: Role = Role { causality: Causality::Output, variability: Variability::Discrete, initial: None };

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
fn what_acts_at_the_start_alone_is_not_listed_for_steps() {
    let (variables, handles) = declared();
    let mut table = table(&handles);
    table.begins(handles.count, handles.force.element(2));
    let structure = structure(&table, &variables).unwrap();
    assert_eq!(structure.outputs[1].dependencies, Some(vec![2]));
    assert_eq!(structure.initial_unknowns[0].dependencies, Some(vec![1, 2, 5]));
}

#[test]
fn a_handle_of_no_variable_is_named() {
    let found = refusal(|table, v| table.output(v.size, Real(77), v.force));
    assert_eq!(found, "the model's dependencies name Real(77), which is no element of a variable");
}

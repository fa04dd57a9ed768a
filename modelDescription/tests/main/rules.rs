//! The rule tables agree with the standard's reasons for them, and the structure lists what 2.2.8 demands.

use model_description::call_table::Condition;
use model_description::rules::{self, StartRule};
use model_description::*;

use crate::samples::{real, rich, variable};

/// The standard's explanations below its tables, as a predicate on pairs.
fn forbidden(causality: Causality, variability: Variability) -> bool {
    use Causality::*;
    use Variability::*;
    match causality {
        // a parameter is neither a constant nor does it change by itself
        Parameter | CalculatedParameter => matches!(variability, Constant | Discrete | Continuous),
        // a fixed or tunable input is a parameter, a constant one is no input
        Input => matches!(variability, Constant | Fixed | Tunable),
        // a fixed or tunable output is a calculated parameter
        Output => matches!(variability, Fixed | Tunable),
        Local => false,
        // time is continuous
        Independent => variability != Continuous,
    }
}

#[test]
fn exactly_the_forbidden_pairs_are_missing_and_no_pair_stands_twice() {
    for causality in Causality::ALL {
        for variability in Variability::ALL {
            let rows = rules::INITIAL_TABLE
                .iter()
                .filter(|row| row.causality == causality && row.variability == variability)
                .count();
            assert_eq!(rows, usize::from(!forbidden(causality, variability)), "{causality} {variability}");
        }
    }
}

#[test]
fn initial_follows_from_who_computes_the_value() {
    for row in rules::INITIAL_TABLE {
        let place = format!("{} {}", row.causality, row.variability);
        let allowed = row.rule.allowed;
        match row.rule.default {
            Some(default) => assert!(allowed.contains(&default), "{place}"),
            None => assert!(allowed.is_empty(), "{place}"),
        }
        let set_from_outside =
            row.causality == Causality::Parameter || row.variability == Variability::Constant;
        let never_initialised = matches!(row.causality, Causality::Input | Causality::Independent);
        assert_eq!(allowed == [Initial::Exact], set_from_outside, "{place}");
        assert_eq!(allowed.is_empty(), never_initialised, "{place}");
        if !set_from_outside && !never_initialised {
            assert_eq!(row.rule.default, Some(Initial::Calculated), "{place}");
            let changes_in_time = matches!(row.variability, Variability::Discrete | Variability::Continuous);
            assert_eq!(allowed.contains(&Initial::Exact), changes_in_time, "{place}");
        }
    }
}

#[test]
fn start_is_required_or_forbidden_never_open() {
    use StartRule::{Forbidden, Required};
    assert_eq!(rules::start(Causality::Input, None), Required);
    assert_eq!(rules::start(Causality::Independent, None), Forbidden);
    assert_eq!(rules::start(Causality::Output, Some(Initial::Exact)), Required);
    assert_eq!(rules::start(Causality::Output, Some(Initial::Approx)), Required);
    assert_eq!(rules::start(Causality::Output, Some(Initial::Calculated)), Forbidden);
    for variable in &rich().variables {
        assert_eq!(rules::start_required(variable), rules::has_start(variable), "{}", variable.name);
    }
}

/// Names of what meets a condition.
fn admitted(condition: Condition) -> Vec<String> {
    let mut variables = rich().variables;
    let mut state = variable("state", 3, Causality::Local, Variability::Continuous, real(Some(1.0), None));
    state.initial = Some(Initial::Exact);
    variables.push(state);
    variables.push(variable("c", 4, Causality::Local, Variability::Constant, real(Some(1.0), None)));
    variables.into_iter().filter(|v| condition.admits(v, false)).map(|v| v.name).collect()
}

#[test]
fn each_condition_admits_its_own_variables() {
    use Condition::*;
    assert_eq!(admitted(SettableBeforeInitialization), ["limit", "source", "file", "guess", "state"]);
    assert_eq!(admitted(SettableInInitialization), ["angle", "limit", "source", "file", "state"]);
    assert_eq!(admitted(InputOrTunable), ["angle", "limit"]);
    let rich = rich();
    let [input, output, listed] = [1, 2, 7].map(|index| &rich.variables[index]);
    assert!(OutputOrInitialUnknown.admits(output, false));
    assert!(!OutputOrInitialUnknown.admits(input, false));
    assert!(OutputOrInitialUnknown.admits(listed, true));
    assert!(Debugging.admits(input, false));
}

fn indices(unknowns: &[Unknown]) -> Vec<u32> {
    unknowns.iter().map(|unknown| unknown.index).collect()
}

#[test]
fn structure_lists_outputs_and_computed_unknowns_only() {
    let mut variables = rich().variables;
    let mut exact = variable("held", 5, Causality::Output, Variability::Discrete, real(Some(1.0), None));
    exact.initial = Some(Initial::Exact);
    variables.push(exact);
    let structure = rules::structure(&variables);
    assert_eq!(indices(&structure.outputs), [3, 6, 9]);
    assert_eq!(indices(&structure.initial_unknowns), [3, 6, 8]);
    assert!(structure.derivatives.is_empty());
    assert!(structure.outputs.iter().all(|u| u.dependencies.is_none() && u.dependencies_kind.is_none()));
}

#[test]
fn exposed_derivatives_bring_their_computed_states() {
    let mut variables = vec![
        variable("x", 0, Causality::Local, Variability::Continuous, real(None, None)),
        variable("der(x)", 1, Causality::Local, Variability::Continuous, real(None, None)),
    ];
    if let VariableKind::Real { derivative, .. } = &mut variables[1].kind {
        *derivative = Some(1);
    }
    let listed = [Unknown { index: 2, ..Unknown::default() }, Unknown { index: 77, ..Unknown::default() }];
    assert_eq!(rules::initial_unknowns(&variables, &listed), [1, 2]);
    assert!(rules::initial_unknowns(&variables, &[]).is_empty());
}

//! When a variable may be set and read in co-simulation (4.2.4, figure 11, notes 1, 2, 3 and 6).

use crate::{Causality, Initial, ScalarVariable, Variability};

use super::effective_initial;

/// The states of a co-simulation slave in which `fmi2SetXXX` or a restricted `fmi2GetXXX` is legal.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Phase {
    /// After `fmi2Instantiate`.
    Instantiated,
    /// Between `fmi2EnterInitializationMode` and `fmi2ExitInitializationMode`.
    InitializationMode,
    /// Between steps.
    StepComplete,
}

/// Whether `fmi2SetXXX` may set the variable in this phase.
///
/// Instantiated: not constant, and initial exact or approx (so inputs are not settable here). Initialization
/// mode: not constant, and initial exact or an input. Between steps: inputs and tunable parameters.
pub fn settable(variable: &ScalarVariable, phase: Phase) -> bool {
    let constant = variable.variability == Variability::Constant;
    let initial = effective_initial(variable);
    match phase {
        Phase::Instantiated => !constant && matches!(initial, Some(Initial::Exact | Initial::Approx)),
        Phase::InitializationMode => {
            !constant && (initial == Some(Initial::Exact) || variable.causality == Causality::Input)
        }
        Phase::StepComplete => match variable.causality {
            Causality::Input => true,
            Causality::Parameter => variable.variability == Variability::Tunable,
            _ => false,
        },
    }
}

/// Whether `fmi2GetXXX` may read the variable in this phase.
///
/// Nothing is readable when instantiated; initialization mode reads outputs and what the model structure
/// lists under `InitialUnknowns` (`initial_unknown`); everything is readable between steps.
pub fn gettable(variable: &ScalarVariable, initial_unknown: bool, phase: Phase) -> bool {
    match phase {
        Phase::Instantiated => false,
        Phase::InitializationMode => initial_unknown || variable.causality == Causality::Output,
        Phase::StepComplete => true,
    }
}

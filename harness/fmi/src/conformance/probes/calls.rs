//! Every function in every state, held against the call table.

use crate::{Error, Fmu, Instance, State as Saved, Status};
use model_description::call_table::{Access, Condition, Function, State, allowed, leniency};
use model_description::{BaseType, Causality, ScalarVariable, value::start};

use crate::conformance::{
    Finding, experiment,
    findings::{Findings, Outcome},
};

/// The states an FMU can be brought to by lawful calls, and the error state.
const STATES: [State; 5] =
    [State::Instantiated, State::InitializationMode, State::StepComplete, State::Terminated, State::Error];

/// Calls each function in each state, every time in a fresh instance.
pub(crate) fn probe(findings: &mut Findings<'_>) -> Outcome {
    let fmu = findings.fmu;
    let (mut as_reported, mut skipped) = (0, 0);
    for state in STATES {
        for &function in Function::ALL {
            for case in cases(fmu, function, state) {
                match call(fmu, &case)? {
                    None => skipped += 1,
                    Some(status) => match compare(&case, status) {
                        None => as_reported += 1,
                        Some(finding) => findings.push(finding),
                    },
                }
            }
        }
    }
    findings.good(format!(
        "{as_reported} calls answered as the table requires, {skipped} not possible with this FMU"
    ));
    Ok(())
}

/// One call to make.
struct CallCase<'a> {
    function: Function,
    state: State,
    variable: Option<&'a ScalarVariable>,
    expected: Expected,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Expected {
    /// The call is legal.
    Done,
    /// The call is illegal.
    Refused,
    /// The call is illegal, but our own FMUs and others accept it.
    Either,
}

/// The calls of one function in one state: for conditional access one with a variable that meets the condition
/// and one with a variable that does not.
fn cases(fmu: &Fmu, function: Function, state: State) -> Vec<CallCase<'_>> {
    let case = |variable, expected| CallCase { function, state, variable, expected };
    let Some((base, sets)) = variable_function(function) else {
        return match allowed(function, state) {
            Access::Forbidden => vec![case(None, Expected::Refused)],
            Access::Allowed | Access::Conditional(_) => vec![case(None, Expected::Done)],
        };
    };
    let of_kind = || {
        fmu.description()
            .variables
            .iter()
            .filter(move |it| it.kind.base_type() == base && (!sets || start(it).is_some()))
    };
    let done = |variable| case(Some(variable), Expected::Done);
    let refused = |variable| case(Some(variable), lenient(function, state, variable));
    match allowed(function, state) {
        Access::Forbidden => of_kind().next().map(refused).into_iter().collect(),
        Access::Allowed => of_kind().next().map(done).into_iter().collect(),
        Access::Conditional(condition) => {
            let meets = |it: &&ScalarVariable| meets(fmu, condition, it);
            let other = of_kind().find(|it| !meets(it));
            of_kind().find(meets).map(done).into_iter().chain(other.map(refused)).collect()
        }
    }
}

/// Returns the base type of the functions that take variables, and whether they set them.
fn variable_function(function: Function) -> Option<(BaseType, bool)> {
    match function {
        Function::GetReal => Some((BaseType::Real, false)),
        Function::GetInteger => Some((BaseType::Integer, false)),
        Function::GetBoolean => Some((BaseType::Boolean, false)),
        Function::GetString => Some((BaseType::String, false)),
        Function::SetReal => Some((BaseType::Real, true)),
        Function::SetInteger => Some((BaseType::Integer, true)),
        Function::SetBoolean => Some((BaseType::Boolean, true)),
        Function::SetString => Some((BaseType::String, true)),
        _ => None,
    }
}

fn meets(fmu: &Fmu, condition: Condition, variable: &ScalarVariable) -> bool {
    let position = fmu.position(&variable.name).and_then(|it| u32::try_from(it + 1).ok());
    let unknowns = &fmu.description().structure.initial_unknowns;
    condition.admits(variable, unknowns.iter().any(|unknown| Some(unknown.index) == position))
}

/// Returns the answers beyond the table that are common.
fn lenient(function: Function, state: State, variable: &ScalarVariable) -> Expected {
    let sets = matches!(variable_function(function), Some((_, true)));
    let admits = match state {
        State::Instantiated if sets => variable.causality == Causality::Input,
        State::Instantiated => start(variable).is_some(),
        _ => true,
    };
    if admits && leniency(function, state).is_some() { Expected::Either } else { Expected::Refused }
}

fn compare(case: &CallCase<'_>, status: Status) -> Option<Finding> {
    let subject = case.variable.map_or_else(String::new, |variable| format!(" of {}", variable.name));
    let call = format!("{}{subject} in state {}", case.function.symbol(), case.state.name());
    let wants_status = case.function.symbol().ends_with("Status");
    match (case.expected, status) {
        (_, Status::Fatal) => Some(Finding::bad(format!("{call} condemns all instances by fmi2Fatal"))),
        (_, Status::Pending) => Some(Finding::bad(format!("{call} answers {status}"))),
        (Expected::Either, _) => None,
        (Expected::Done, Status::Ok | Status::Warning) | (Expected::Refused, Status::Error) => None,
        // "A status that cannot be given" is fmi2Discard.
        (Expected::Done, Status::Discard) if wants_status => None,
        (Expected::Done, _) => Some(Finding::bad(format!("{call} is allowed and answers {status}"))),
        (Expected::Refused, _) => Some(Finding::note(format!("{call} is forbidden and answers {status}"))),
    }
}

/// Makes the call in a fresh instance; none where it cannot be made with this FMU.
fn call(fmu: &Fmu, case: &CallCase<'_>) -> Result<Option<Status>, Error> {
    let flags = fmu.co_simulation()?;
    let mut instance = Instance::new(fmu, "probe", &experiment::unchecked())?;
    let needs_saved = matches!(
        case.function,
        Function::SetFmuState
            | Function::FreeFmuState
            | Function::SerializedFmuStateSize
            | Function::SerializeFmuState
            | Function::DeSerializeFmuState
    );
    let mut saved = None;
    if needs_saved {
        if !flags.can_get_and_set_fmu_state {
            return Ok(None);
        }
        saved = Some(instance.save_state()?);
    }
    let mut bytes = Vec::new();
    if case.function == Function::DeSerializeFmuState
        && let Some(saved) = saved
    {
        if !flags.can_serialize_fmu_state {
            return Ok(None);
        }
        bytes = instance.serialize_state(saved)?;
    }
    if !experiment::advance(&mut instance, case.state)? {
        return Ok(None);
    }
    let Some(outcome) = make(&mut instance, case, saved, &bytes)? else { return Ok(None) };
    match outcome {
        Ok(()) => Ok(Some(Status::Ok)),
        Err(error) => match error.status() {
            Some(status) => Ok(Some(status)),
            None if error.has_unknown_status() => Err(error),
            None => Ok(None),
        },
    }
}

type Made = Result<Option<Result<(), Error>>, Error>;

fn make(instance: &mut Instance, case: &CallCase<'_>, saved: Option<Saved>, bytes: &[u8]) -> Made {
    let fmu = instance.fmu().clone();
    let flags = fmu.co_simulation()?;
    let times = experiment::times(&fmu)?;
    let continuous = |causality| experiment::continuous(&fmu, causality).first().copied();
    if let Some(variable) = case.variable {
        return Ok(match variable_function(case.function) {
            Some((_, true)) => start(variable).map(|value| instance.set_variable(variable, &value)),
            _ => Some(instance.get_variable(variable).map(|_| ())),
        });
    }
    Ok(match (case.function, saved) {
        (Function::SetDebugLogging, _) => Some(instance.set_debug_logging(true, &[])),
        (Function::SetupExperiment, _) => {
            Some(instance.setup_experiment(None, times.start_s, Some(times.stop_s)))
        }
        (Function::EnterInitializationMode, _) => {
            if case.state == State::Instantiated {
                instance.setup_experiment(None, times.start_s, Some(times.stop_s))?;
            }
            Some(instance.enter_initialization_mode())
        }
        (Function::ExitInitializationMode, _) => Some(instance.exit_initialization_mode()),
        (Function::Terminate, _) => Some(instance.terminate()),
        (Function::Reset, _) => Some(instance.reset()),
        (Function::GetFmuState, _) if flags.can_get_and_set_fmu_state => {
            Some(instance.save_state().map(|_| ()))
        }
        (Function::SetFmuState, Some(saved)) => Some(instance.restore_state(saved)),
        (Function::FreeFmuState, Some(saved)) => Some(instance.free_state(saved)),
        (Function::SerializeFmuState, Some(saved)) if flags.can_serialize_fmu_state => {
            Some(instance.serialize_state(saved).map(|_| ()))
        }
        (Function::DeSerializeFmuState, _) => Some(instance.deserialize_state(bytes).map(|_| ())),
        (Function::GetDirectionalDerivative, _) if flags.provides_directional_derivative => {
            let pair = continuous(Causality::Output).zip(continuous(Causality::Input));
            pair.map(|(output, input)| {
                instance.directional_derivative(&[output], &[input], &[1.0], &mut [0.0])
            })
        }
        (Function::SetRealInputDerivatives, _) if flags.can_interpolate_inputs => {
            continuous(Causality::Input).map(|input| instance.set_input_derivatives(&[input], &[1], &[0.0]))
        }
        (Function::GetRealOutputDerivatives, _) if flags.max_output_derivative_order > 0 => {
            continuous(Causality::Output)
                .map(|output| instance.get_output_derivatives(&[output], &[1], &mut [0.0]))
        }
        (Function::DoStep, _) => Some(instance.do_step(times.start_s, times.step_s, false)),
        (Function::CancelStep, _) => Some(instance.cancel_step()),
        (Function::GetRealStatus, _) => Some(instance.last_successful_time().map(|_| ())),
        (Function::GetBooleanStatus, _) => Some(instance.terminated().map(|_| ())),
        (function @ (Function::GetStatus | Function::GetIntegerStatus | Function::GetStringStatus), _) => {
            Some(instance.probe_status(function, 0))
        }
        // Freed when dropped; the rest needs no instance, or is part of another call.
        _ => None,
    })
}

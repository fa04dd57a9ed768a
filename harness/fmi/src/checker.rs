//! Refuses calls that the standard forbids before they reach the FMU.

use std::cell::Cell;

use model_description::BaseType;
use model_description::call_table::{Access, Function, Next, State, after, allowed};

use crate::{Fmu, Status, abi::StateKey, access::bit};

/// Whether forbidden calls are refused by the harness.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Checking {
    /// Every call is held against the standard's call table, without leniencies.
    #[default]
    Strict,
    /// Every call goes through, to see what the FMU makes of it.
    Off,
}

/// Follows one instance through the standard's state machine.
pub(crate) struct Checker {
    fmu: Fmu,
    checking: Checking,
    // None after a state came from bytes: those alone know which state it was saved in.
    state: Cell<Option<State>>,
    experiment_set_up: Cell<bool>,
    saved: Vec<(StateKey, Option<State>)>,
}

impl Checker {
    pub(crate) fn new(fmu: Fmu, checking: Checking) -> Self {
        Self {
            fmu,
            checking,
            state: Cell::new(Some(State::Instantiated)),
            experiment_set_up: Cell::new(false),
            saved: Vec::new(),
        }
    }

    /// Whether `function` may be called now; otherwise why not.
    pub(crate) fn allow(&self, function: Function) -> Result<(), String> {
        self.access(function).map(|_| ())
    }

    /// As [`Checker::allow`], and every variable meets the condition of the state.
    pub(crate) fn allow_variables(
        &self,
        function: Function,
        references: &[u32],
        base: BaseType,
    ) -> Result<(), String> {
        let Access::Conditional(condition) = self.access(function)? else { return Ok(()) };
        let needed = bit(condition);
        for &reference in references {
            let Some(met) = self.fmu.access().met(base, reference) else {
                return Err(format!(
                    "the description has no {} with value reference {reference}",
                    base.name()
                ));
            };
            if met & needed != needed {
                return Err(format!(
                    "in state {} it takes only {}, and {} is none",
                    self.state.get().map_or("unknown", State::name),
                    condition.text(),
                    self.fmu.name_of(base, reference)
                ));
            }
        }
        Ok(())
    }

    fn access(&self, function: Function) -> Result<Access, String> {
        let (Checking::Strict, Some(state)) = (self.checking, self.state.get()) else {
            return Ok(Access::Allowed);
        };
        let access = allowed(function, state);
        if access == Access::Forbidden {
            return Err(format!("FMI 2.0 does not allow it in state {}", state.name()));
        }
        if function == Function::EnterInitializationMode && !self.experiment_set_up.get() {
            return Err("fmi2SetupExperiment comes first".to_owned());
        }
        Ok(access)
    }

    /// Follows the answer of a call that was made.
    pub(crate) fn answered(&self, function: Function, status: Status) {
        if matches!(status, Status::Ok | Status::Warning) {
            match function {
                Function::SetupExperiment => self.experiment_set_up.set(true),
                Function::Reset => self.experiment_set_up.set(false),
                _ => {}
            }
        }
        // From an unknown state, the next calls are checked as if the steps were complete.
        let known = self.state.get();
        let next = after(function, known.unwrap_or(State::StepComplete), status);
        match (next, known, function) {
            (Next::State(_), None, function) if !tells_state(function, status) => {}
            (Next::State(state), _, _) => self.state.set(Some(state)),
            (Next::Stored | Next::Freed, _, _) => {}
        }
    }

    /// Remembers in which state a state was saved.
    pub(crate) fn saved(&mut self, key: StateKey) {
        self.forget(key);
        self.saved.push((key, self.state.get()));
    }

    /// Forgets a freed state.
    pub(crate) fn forget(&mut self, key: StateKey) {
        self.saved.retain(|(saved, _)| *saved != key);
    }

    /// Goes to where a state was saved.
    pub(crate) fn restored(&self, key: StateKey) {
        let state = self.saved.iter().find(|(saved, _)| *saved == key).and_then(|(_, state)| *state);
        self.state.set(state);
        // Beyond instantiation the experiment was set up; before, setting it up again is the safe side.
        self.experiment_set_up.set(state.is_none_or(|state| state != State::Instantiated));
    }
}

/// Whether the call's answer fixes the state whatever it was before.
fn tells_state(function: Function, status: model_description::Status) -> bool {
    use model_description::Status::{Discard, Error, Fatal, Ok, Warning};
    match status {
        Error | Fatal => true,
        Ok | Warning | Discard => matches!(
            function,
            Function::EnterInitializationMode
                | Function::ExitInitializationMode
                | Function::DoStep
                | Function::Terminate
                | Function::Reset
        ),
        _ => false,
    }
}

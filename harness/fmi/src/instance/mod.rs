//! One instance of an FMU, safe to drive: every call checked, every failure with its reason.

mod states;
mod values;

use std::sync::Arc;

use model_description::BaseType;
use model_description::call_table::Function;

use crate::{
    CallError, Callbacks, Checking, Error, Fmu, LogMessage, Status,
    abi::{Answer, Component, Start, StateKey},
    checker::Checker,
    error::{MESSAGES_SHOWN, Outcome},
    uri::file_uri,
};

/// Location of the instance's resources.
#[derive(Clone, Debug, PartialEq, Eq, Default)]
pub enum Resources {
    /// The URI of the unpacked `resources` folder.
    #[default]
    Folder,
    /// NULL.
    Absent,
    /// This text.
    Uri(String),
}

/// How to instantiate; the default suits any FMU.
#[derive(Clone, Debug, PartialEq, Eq, Default)]
pub struct InstanceOptions {
    /// Turns on the FMU's whole log; otherwise only the categories that give the reason of a failed call.
    pub logging: bool,
    /// Categories of the whole log; empty means all.
    pub categories: Vec<String>,
    /// The resource location.
    pub resources: Resources,
    /// How the callbacks are handed over.
    pub callbacks: Callbacks,
    /// Whether calls the standard forbids are refused before they reach the FMU.
    pub checking: Checking,
    /// A GUID instead of the description's.
    pub guid: Option<String>,
}

/// A saved state of one instance; see [`Instance::save_state`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct State(StateKey);

/// One instance of a co-simulation FMU.
///
/// The order of calls is the standard's: [`setup_experiment`](Self::setup_experiment),
/// [`enter_initialization_mode`](Self::enter_initialization_mode),
/// [`exit_initialization_mode`](Self::exit_initialization_mode), then [`do_step`](Self::do_step) with sets and gets
/// between. `fmi2OK` and `fmi2Warning` count as success; anything else is an [`Error::Call`]. Dropping the
/// instance frees its saved states and itself.
pub struct Instance {
    component: Component,
    fmu: Fmu,
    name: String,
    checker: Checker,
}

impl std::fmt::Debug for Instance {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Instance").field("name", &self.name).finish_non_exhaustive()
    }
}

impl Instance {
    /// Instantiates the FMU; its library is loaded if it is not yet.
    pub fn new(fmu: &Fmu, name: &str, options: &InstanceOptions) -> Result<Self, Error> {
        let binary = fmu.binary()?;
        let resources = match &options.resources {
            Resources::Folder => Some(file_uri(&fmu.folder().join("resources"))),
            Resources::Absent => None,
            Resources::Uri(uri) => Some(uri.clone()),
        };
        let guid = options.guid.as_deref().unwrap_or(&fmu.description().guid);
        let start = Start {
            name,
            guid,
            resources: resources.as_deref(),
            logging: options.logging,
            callbacks: options.callbacks,
        };
        let component =
            Component::instantiate(Arc::clone(&binary), &start).map_err(|(outcome, messages)| {
                Box::new(CallError {
                    fmu: fmu.name().to_owned(),
                    instance: name.to_owned(),
                    call: "fmi2Instantiate".to_owned(),
                    outcome,
                    messages: last(messages),
                })
            })?;
        let mut instance = Self {
            component,
            fmu: fmu.clone(),
            name: name.to_owned(),
            checker: Checker::new(fmu.clone(), options.checking),
        };
        if options.logging && !options.categories.is_empty() {
            let categories: Vec<&str> = options.categories.iter().map(String::as_str).collect();
            instance.set_debug_logging(true, &categories)?;
        }
        if !options.logging {
            instance.listen_to_reasons();
        }
        Ok(instance)
    }

    /// Turns on the messages that give the reason of a failed call, for its error.
    fn listen_to_reasons(&mut self) {
        let declared = self.fmu.description().log_categories.iter().map(|category| category.name.clone());
        let expected: Vec<String> = declared.filter(|name| REASONS.contains(&name.as_str())).collect();
        if !expected.is_empty() {
            let expected: Vec<&str> = expected.iter().map(String::as_str).collect();
            // An FMU that does not do it only stays silent.
            let _ = self.component.set_debug_logging(true, &expected);
        }
    }

    /// The FMU it came from.
    pub fn fmu(&self) -> &Fmu {
        &self.fmu
    }

    /// Its name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// All kept messages, oldest first (the last thousand).
    pub fn messages(&self) -> Vec<LogMessage> {
        self.component.messages()
    }

    /// Takes the messages out of the instance.
    pub fn take_messages(&self) -> Vec<LogMessage> {
        self.component.take_messages()
    }

    /// `fmi2SetDebugLogging`; no categories means all.
    pub fn set_debug_logging(&mut self, on: bool, categories: &[&str]) -> Result<(), Error> {
        let answer = |it: &mut Component| it.set_debug_logging(on, categories);
        self.call(Function::SetDebugLogging, answer, |_| format!("(loggingOn={on}, {categories:?})"))
    }

    /// `fmi2SetupExperiment`; times in s.
    pub fn setup_experiment(
        &mut self,
        tolerance: Option<f64>,
        start_s: f64,
        stop_s: Option<f64>,
    ) -> Result<(), Error> {
        let answer = |it: &mut Component| it.setup_experiment(tolerance, start_s, stop_s);
        self.call(Function::SetupExperiment, answer, |_| {
            let stop = stop_s.map_or_else(|| "undefined".to_owned(), |stop| stop.to_string());
            format!("(startTime={start_s}, stopTime={stop})")
        })
    }

    /// `fmi2EnterInitializationMode`.
    pub fn enter_initialization_mode(&mut self) -> Result<(), Error> {
        self.call_plain(Function::EnterInitializationMode, Component::enter_initialization_mode)
    }

    /// `fmi2ExitInitializationMode`.
    pub fn exit_initialization_mode(&mut self) -> Result<(), Error> {
        self.call_plain(Function::ExitInitializationMode, Component::exit_initialization_mode)
    }

    /// `fmi2Terminate`.
    pub fn terminate(&mut self) -> Result<(), Error> {
        self.call_plain(Function::Terminate, Component::terminate)
    }

    /// `fmi2Reset`: as freshly instantiated.
    pub fn reset(&mut self) -> Result<(), Error> {
        self.call_plain(Function::Reset, Component::reset)
    }

    /// `fmi2DoStep` from `time_s` over `step_s`, both in s, promising never to set an earlier state again if
    /// `no_set_state_prior`.
    pub fn do_step(&mut self, time_s: f64, step_s: f64, no_set_state_prior: bool) -> Result<(), Error> {
        let answer = |it: &mut Component| it.do_step(time_s, step_s, no_set_state_prior);
        self.call(Function::DoStep, answer, |_| {
            format!("(currentCommunicationPoint={time_s}, communicationStepSize={step_s})")
        })
    }

    /// `fmi2CancelStep`.
    pub fn cancel_step(&mut self) -> Result<(), Error> {
        self.call_plain(Function::CancelStep, Component::cancel_step)
    }

    /// `fmi2SetRealInputDerivatives` at the current communication point; orders from 1.
    pub fn set_input_derivatives(
        &mut self,
        references: &[u32],
        orders: &[i32],
        values: &[f64],
    ) -> Result<(), Error> {
        let answer = |it: &mut Component| it.set_real_input_derivatives(references, orders, values);
        self.call(Function::SetRealInputDerivatives, answer, |it| it.named(references, BaseType::Real))
    }

    /// `fmi2GetRealOutputDerivatives` at the current communication point; orders from 1.
    pub fn get_output_derivatives(
        &mut self,
        references: &[u32],
        orders: &[i32],
        values: &mut [f64],
    ) -> Result<(), Error> {
        let answer = |it: &mut Component| it.get_real_output_derivatives(references, orders, values);
        self.call(Function::GetRealOutputDerivatives, answer, |it| it.named(references, BaseType::Real))
    }

    /// `fmi2GetDirectionalDerivative`: `result` = d(unknowns)/d(knowns) times `seed`.
    pub fn directional_derivative(
        &mut self,
        unknowns: &[u32],
        knowns: &[u32],
        seed: &[f64],
        result: &mut [f64],
    ) -> Result<(), Error> {
        let answer = |it: &mut Component| it.get_directional_derivative(unknowns, knowns, seed, result);
        self.call(Function::GetDirectionalDerivative, answer, |it| it.named(unknowns, BaseType::Real))
    }

    /// Whether the FMU ended by itself (`fmi2Terminated`), read after a step was discarded.
    pub fn terminated(&mut self) -> Result<bool, Error> {
        let answer = Component::terminated;
        self.call_for(Function::GetBooleanStatus, answer, |_| "(fmi2Terminated)".to_owned())
    }

    /// `fmi2LastSuccessfulTime` in s, read after a step was discarded.
    pub fn last_successful_time(&mut self) -> Result<f64, Error> {
        let answer = Component::last_successful_time;
        self.call_for(Function::GetRealStatus, answer, |_| "(fmi2LastSuccessfulTime)".to_owned())
    }

    /// Zero-length vectors as NULL, NULL states to free: the name and answer of each call. For probing.
    pub fn probe_nulls(&mut self) -> Vec<(&'static str, Result<Status, String>)> {
        self.component.free_nothing();
        let answers = self.component.probe_nulls();
        answers
            .into_iter()
            .map(|(name, answer)| (name, answer.map_err(|missing| missing.to_string())))
            .collect()
    }

    /// `fmi2FreeFMUstate` with NULL for the pointer itself. For probing: it kills the process of many an FMU.
    pub fn probe_free_no_state(&mut self) -> Result<Status, String> {
        self.component.free_no_state().map_err(|missing| missing.to_string())
    }

    /// One of `fmi2GetStatus`, `fmi2GetIntegerStatus`, `fmi2GetStringStatus` with a status kind. For probing.
    pub fn probe_status(&mut self, function: Function, kind: i32) -> Result<(), Error> {
        self.call(function, |it| it.get_other_status(function, kind), |_| format!("({kind})"))
    }

    /// Returns the error that a Real which was read at a time in s is NaN.
    pub fn not_a_number(&self, reference: u32, time_s: f64) -> Error {
        let call = Function::GetReal.symbol().to_owned() + &self.named(&[reference], BaseType::Real);
        self.failure(call, Outcome::NotANumber(time_s))
    }

    /// Makes a call that the standard allows now; `arguments` are what an error shows of them.
    fn call(
        &mut self,
        function: Function,
        answer: impl FnOnce(&mut Component) -> Answer,
        arguments: impl FnOnce(&Self) -> String,
    ) -> Result<(), Error> {
        self.call_for(function, |it| answer(it).map(|status| (status, ())), arguments)
    }

    /// A call whose arguments say nothing.
    fn call_plain(
        &mut self,
        function: Function,
        answer: impl FnOnce(&mut Component) -> Answer,
    ) -> Result<(), Error> {
        self.call(function, answer, |_| String::new())
    }

    /// A call that gives something.
    fn call_for<T>(
        &mut self,
        function: Function,
        answer: impl FnOnce(&mut Component) -> Result<(Status, T), Outcome>,
        arguments: impl FnOnce(&Self) -> String,
    ) -> Result<T, Error> {
        self.checker
            .allow(function)
            .map_err(|why| self.failure(function.symbol().to_owned(), Outcome::NotAllowed(why)))?;
        let answer = answer(&mut self.component);
        self.finish(function, answer, arguments)
    }

    /// A call that reads or sets variables, if each of them may be read or set now.
    fn access(
        &mut self,
        (function, base): (Function, BaseType),
        references: &[u32],
        answer: impl FnOnce(&mut Component) -> Answer,
        arguments: impl FnOnce(&Self) -> String,
    ) -> Result<(), Error> {
        self.checker.allow_variables(function, references, base).map_err(|why| {
            let call = function.symbol().to_owned() + &self.named(references, base);
            self.failure(call, Outcome::NotAllowed(why))
        })?;
        let answer = answer(&mut self.component).map(|status| (status, ()));
        self.finish(function, answer, arguments)
    }

    fn finish<T>(
        &self,
        function: Function,
        answer: Result<(Status, T), Outcome>,
        arguments: impl FnOnce(&Self) -> String,
    ) -> Result<T, Error> {
        let outcome = match answer {
            Ok((status, value)) => {
                self.checker.answered(function, status);
                if matches!(status, Status::Ok | Status::Warning) {
                    return Ok(value);
                }
                Outcome::Status(status)
            }
            Err(outcome) => outcome,
        };
        Err(self.failure(function.symbol().to_owned() + &arguments(self), outcome))
    }

    /// The names behind value references, for errors.
    fn named(&self, references: &[u32], base: BaseType) -> String {
        format!("({})", self.names(references, base).join(", "))
    }

    /// The same with values.
    fn assigned<T: std::fmt::Debug>(&self, references: &[u32], base: BaseType, values: &[T]) -> String {
        let names = self.names(references, base);
        let pairs = names.iter().zip(values).map(|(name, value)| format!("{name}={value:?}"));
        let pairs: Vec<String> = pairs.collect();
        let more = if values.len() > pairs.len() { ", ..." } else { "" };
        format!("({}{more})", pairs.join(", "))
    }

    fn names(&self, references: &[u32], base: BaseType) -> Vec<String> {
        const SHOWN: usize = 4;
        references.iter().take(SHOWN).map(|&reference| self.fmu.name_of(base, reference)).collect()
    }

    fn failure(&self, call: String, outcome: Outcome) -> Error {
        Error::Call(Box::new(CallError {
            fmu: self.fmu.name().to_owned(),
            instance: self.name.clone(),
            call,
            outcome,
            messages: last(self.component.messages()),
        }))
    }
}

/// The standard's log categories (2.2.4) that say why a call failed.
const REASONS: [&str; 3] = ["logStatusDiscard", "logStatusError", "logStatusFatal"];

/// The messages that an error shows.
fn last(mut messages: Vec<LogMessage>) -> Vec<LogMessage> {
    messages.split_off(messages.len().saturating_sub(MESSAGES_SHOWN))
}

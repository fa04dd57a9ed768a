//! One instance: the state machine around a model, its values, its log. No C types here.
//!
//! Every function of the standard is admitted by [`Instance::guard`], does its work in a method of its own and hands a
//! [`Problem`] or nothing to [`Instance::conclude`], which logs, moves the state and gives the status.

mod deferred;
mod derivatives;
mod lifecycle;
mod pending;
pub(crate) mod saved;
pub(crate) mod state;
pub(crate) mod stepping;
mod values;

use std::sync::Arc;

use crate::fmi2::access::{AccessTable, INPUT, SET_STEP};
use crate::fmi2::problem::Problem;
use crate::fmi2::references;
use crate::logger::Logger;
use crate::prepared::Prepared;
use crate::runtime::Runtime;
use crate::variables::{Element, Real, SetBits, Values};
use model_description::call_table::{self, Access, Function, Next};
use model_description::{BaseType, Status};
use pending::Deferred;

use state::InstanceState;
pub use state::MAX_INPUT_DERIVATIVE_ORDER;

/// Messages that are logged once per instance, as bits.
mod once {
    pub(super) const INPUT_BEFORE_INITIALIZATION: u8 = 1;
    pub(super) const READ_IN_INITIALIZATION: u8 = 1 << 1;
    pub(super) const OUTPUT_AFTER_SET: u8 = 1 << 2;
    pub(super) const EARLY_STATE: u8 = 1 << 3;
}

/// One instance of one model.
pub(crate) struct Instance {
    pub(crate) state: InstanceState,
    pub(super) runtime: Box<dyn Runtime>,
    pub(super) access: AccessTable,
    deferred: Deferred,
    /// Places of the tunable parameters.
    tunable: [SetBits; Element::TABLES],
    pub(super) start: Arc<Values>,
    pub(super) digest: uuid::Uuid,
    pub(super) logger: Logger,
    /// The messages of [`once`] that were logged.
    reported: u8,
    /// No FMU state before this time will be set, by `noSetFMUStatePriorToCurrentPoint`.
    earliest_s: f64,
    /// Spare memory for [`InstanceState::at_last_step`].
    spare: Values,
    /// Spare memory for the unknowns and seeds of directional derivatives.
    directions: (Vec<Real>, Vec<(Real, f64)>),
    /// The parameter that the experiment's tolerance stands in for.
    tolerance: Option<Real>,
    /// Highest order of an output's derivative.
    output_derivative_order: u32,
    pub(super) poisoned: bool,
}

impl Instance {
    /// A fresh instance.
    pub(crate) fn new(prepared: Prepared, logger: Logger) -> Self {
        let Prepared { description, start, runtime, digest, tolerance } = prepared;
        let access = AccessTable::new(&description);
        let mut state = InstanceState::new(&start);
        state.input_derivatives.reserve(access.real_limits.len());
        let is_tunable = |flags: &u16| flags & (SET_STEP | INPUT) == SET_STEP;
        let tunable = BaseType::ALL.map(|base| SetBits::new(access.flags(base).iter().map(is_tunable)));
        let deferred = Deferred::new(&runtime.output_groups(), &access);
        Self {
            spare: Values::clone(&start),
            directions: Default::default(),
            tolerance,
            output_derivative_order: description.co_simulation.map_or(0, |it| it.max_output_derivative_order),
            state,
            runtime,
            access,
            deferred,
            tunable,
            start,
            digest,
            logger,
            reported: 0,
            earliest_s: f64::NEG_INFINITY,
            poisoned: false,
        }
    }

    /// Refuses a call that neither the table nor a leniency admits in this state. What is conditional is checked per
    /// variable.
    #[inline]
    pub(crate) fn guard(&self, function: Function) -> Result<(), Problem> {
        match call_table::allowed(function, self.state.mode) {
            Access::Forbidden if call_table::leniency(function, self.state.mode).is_none() => {
                Err(Problem::illegal(function, self.state.mode))
            }
            Access::Forbidden => Ok(()),
            Access::Allowed | Access::Conditional(_) => Ok(()),
        }
    }

    /// The status of a call: logs a problem and moves the state machine.
    #[inline]
    pub(crate) fn conclude(&mut self, function: Function, result: Result<(), Problem>) -> Status {
        match result {
            Ok(()) => {
                self.follow(function, Status::Ok);
                Status::Ok
            }
            Err(problem) => self.refuse(function, &problem),
        }
    }

    #[cold]
    fn refuse(&mut self, function: Function, problem: &Problem) -> Status {
        let Problem { status, text } = problem;
        self.logger.log(*status, format_args!("{}: {text}", function.symbol()));
        self.follow(function, *status);
        *status
    }

    #[inline]
    fn follow(&mut self, function: Function, status: Status) {
        if let Next::State(state) = call_table::after(function, self.state.mode, status) {
            self.state.mode = state;
        }
    }

    /// Logs a message the first time only. What importers do every day is an event, `Status::Ok`.
    #[cold]
    pub(super) fn log_once(&mut self, what: u8, status: Status, message: core::fmt::Arguments<'_>) {
        if self.reported & what == 0 {
            self.reported |= what;
            self.logger.log(status, message);
        }
    }

    /// Refuses values that are no finite numbers: nothing is answered under OK that a master cannot continue with.
    pub(super) fn check_finite(&self, initially: bool) -> Result<(), Problem> {
        let values = &self.state.values;
        let found = match initially {
            true => self.access.first_not_finite(values),
            false => self.deferred.first_not_finite(&self.access, values),
        };
        found.map_or(Ok(()), |(reference, value)| Err(self.not_finite(reference, value, initially)))
    }

    #[cold]
    pub(super) fn not_finite(&self, reference: u32, value: f64, initially: bool) -> Problem {
        let name = self.access.named(BaseType::Real, reference);
        let dependencies = self.access.dependencies(reference, initially).unwrap_or_default();
        let shown = |at: &u32| {
            let (base, name) = (references::base_type(*at)?, self.access.any_name(*at)?);
            Some(format!("{name} = {}", self.state.values.shown(base, references::index(base, *at))))
        };
        let advice = match dependencies.iter().filter_map(shown).collect::<Vec<_>>().join(", ") {
            none if none.is_empty() => "look for inputs or parameters beyond what can be".to_owned(),
            listed => format!("it depends on {listed}"),
        };
        Problem::error(format_args!("{name} came out as {value:?}, which is no finite number; {advice}"))
    }

    /// The values at which derivatives are taken: those of the last step, whatever was set since.
    pub(super) fn values_at_last_step(&self) -> &Values {
        self.state.at_last_step.as_ref().unwrap_or(&self.state.values)
    }

    /// Forgets the values kept for derivatives, but not their memory.
    pub(super) fn forget_last_step(&mut self) {
        if let Some(values) = self.state.at_last_step.take() {
            self.spare = values;
        }
    }
}

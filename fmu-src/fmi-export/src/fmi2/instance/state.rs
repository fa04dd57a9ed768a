//! Everything in an instance that changes, but for the model's own state: one value, saved and restored as a whole.

use crate::fmi2::references;
use model_description::BaseType;
use serde::{Deserialize, Serialize};

use crate::fmi2::access::{AccessTable, CONTINUOUS, INPUT, SET_BY_IMPORTER};
use crate::model::{Failure, InputDerivative};
use crate::state_bytes::damaged;
use crate::variables::{Element, GREATEST_SET, SetBits, Values};
use model_description::call_table::State;

/// Highest order of an input derivative: the factorial of the next one is no longer an `f64`.
pub const MAX_INPUT_DERIVATIVE_ORDER: u32 = 170;

/// The arguments of `fmi2SetupExperiment`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Experiment {
    pub(crate) start_s: f64,
    pub(crate) stop_s: Option<f64>,
    /// A positive number.
    pub(crate) tolerance: Option<f64>,
}

impl Experiment {
    /// Whether its times are finite and in order.
    pub(crate) fn is_valid(&self) -> bool {
        self.start_s.is_finite()
            && self.stop_s.is_none_or(|stop_s| stop_s.is_finite() && stop_s >= self.start_s)
    }
}

/// The mutable part of an instance.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct InstanceState {
    #[serde(with = "mode_as_number")]
    pub(crate) mode: State,
    pub(crate) experiment: Option<Experiment>,
    /// Time at which the last step ended, in s.
    pub(crate) time_s: f64,
    /// The model ended by itself.
    pub(crate) terminated: bool,
    /// In Initialization Mode: the outputs do not belong to what was set.
    pub(crate) needs_initialization: bool,
    /// The last step had input derivatives, which ended with it.
    pub(crate) derivatives_ended: bool,
    /// Until the end of the next step.
    pub(crate) input_derivatives: Vec<InputDerivative>,
    pub(crate) values: Values,
    /// Once a different value was set between steps: the values as the last step left them. What is set next may be
    /// set back, and derivatives belong to them.
    pub(crate) at_last_step: Option<Values>,
}

impl InstanceState {
    /// A fresh instance.
    pub(crate) fn new(start: &Values) -> Self {
        let mut values = start.clone();
        values.mark_none();
        Self {
            mode: State::Instantiated,
            experiment: None,
            time_s: 0.0,
            terminated: false,
            needs_initialization: false,
            derivatives_ended: false,
            input_derivatives: Vec::new(),
            values,
            at_last_step: None,
        }
    }

    /// Becomes a copy of `other`, reusing memory.
    pub(crate) fn copy_from(&mut self, other: &Self) {
        self.input_derivatives.clone_from(&other.input_derivatives);
        self.values.clone_from(&other.values);
        self.at_last_step.clone_from(&other.at_last_step);
        // A new field that holds memory is refused here until it is listed.
        *self = Self {
            input_derivatives: core::mem::take(&mut self.input_derivatives),
            values: core::mem::take(&mut self.values),
            at_last_step: self.at_last_step.take(),
            ..*other
        };
    }

    /// Whether an input or tunable parameter differs from what the last step used. One that was set and set back does
    /// not: values agree to the bit, so the model continues as if nothing had been set.
    pub(crate) fn differs(&self) -> bool {
        self.at_last_step.as_ref().is_some_and(|before| !self.values.set_values_equal(before))
    }

    /// Whether one of these tunable parameters differs from what the last step used, or is set for the first time.
    pub(crate) fn parameters_differ(&self, tunable: &[SetBits; Element::TABLES]) -> bool {
        self.at_last_step.as_ref().is_some_and(|before| self.values.differ_among(before, tunable))
    }

    /// Whether decoded bytes make sense for a model with these variables. The error says what does not.
    pub(crate) fn check(&self, access: &AccessTable) -> Result<(), Failure> {
        self.check_clock()?;
        for values in core::iter::once(&self.values).chain(&self.at_last_step) {
            check_values(values, access)?;
            self.check_finite(values, access)?;
        }
        for &InputDerivative { input, order, value } in &self.input_derivatives {
            let reference = references::for_variable(input);
            let flags = access.flags_at(BaseType::Real, reference).unwrap_or(0);
            let fits = flags & INPUT != 0 && flags & CONTINUOUS != 0;
            let is_within = (-GREATEST_SET..=GREATEST_SET).contains(&value);
            if !fits || !(1..=MAX_INPUT_DERIVATIVE_ORDER).contains(&order) || !is_within {
                return Err(damaged(format_args!(
                    "input derivative {value:?} of order {order} for Real value reference {reference}"
                )));
            }
        }
        Ok(())
    }

    /// Refuses Reals that are not finite; an instance in the error state may hold them, for debugging.
    fn check_finite(&self, values: &Values, access: &AccessTable) -> Result<(), Failure> {
        match access.first_not_finite(values) {
            Some((reference, value)) if self.mode != State::Error => {
                let name = access.name(BaseType::Real, reference).unwrap_or_default();
                Err(damaged(format_args!("`{name}` is {value:?}")))
            }
            _ => Ok(()),
        }
    }

    fn check_clock(&self) -> Result<(), Failure> {
        if matches!(self.mode, State::StepInProgress | State::StepCanceled | State::Fatal) {
            return Err(damaged(format_args!("no instance is saved in the state {}", self.mode.name())));
        }
        let started = matches!(
            self.mode,
            State::InitializationMode | State::StepComplete | State::StepFailed | State::Terminated
        );
        match self.experiment {
            None if started => return Err(damaged("started without an experiment")),
            Some(Experiment { tolerance: Some(tolerance), .. })
                if !(tolerance > 0.0 && tolerance.is_finite()) =>
            {
                return Err(damaged(format_args!("tolerance {tolerance:?}")));
            }
            Some(experiment @ Experiment { start_s, stop_s, .. }) if !experiment.is_valid() => {
                return Err(damaged(format_args!("start {start_s:?} s and stop {stop_s:?} s")));
            }
            _ => {}
        }
        if self.time_s.is_finite() { Ok(()) } else { Err(damaged(format_args!("time {:?} s", self.time_s))) }
    }
}

fn check_values(values: &Values, access: &AccessTable) -> Result<(), Failure> {
    for ((base, length), set) in BaseType::ALL.into_iter().zip(values.lengths()).zip(&values.set) {
        let expected = access.flags(base).len();
        if length != expected {
            return Err(damaged(format_args!("{length} {} values, the model has {expected}", base.name())));
        }
        if set.len() != SetBits::words(length) {
            return Err(damaged(format_args!(
                "{} words say which of {length} {} values were set",
                set.len(),
                base.name()
            )));
        }
    }
    // Limits are for what a master sets, here as at the C functions.
    let reals = access.flags(BaseType::Real).iter().zip(&values.reals).zip(&access.real_limits);
    for (reference, ((&flags, &value), &(min, max))) in (references::first(BaseType::Real)..).zip(reals) {
        if flags & SET_BY_IMPORTER != 0 && !(value >= min && value <= max) {
            let name = access.name(BaseType::Real, reference).unwrap_or_default();
            return Err(damaged(format_args!("`{name}` is {value:?}")));
        }
    }
    for (index, &value) in values.integers.iter().enumerate() {
        if !access.admits_integer(index, value) {
            let reference = references::first(BaseType::Integer) + index as u32;
            let name = access.name(BaseType::Integer, reference).unwrap_or_default();
            return Err(damaged(format_args!("`{name}` is {value}")));
        }
    }
    Ok(())
}

/// The state of the state machine as its column in the call table.
mod mode_as_number {
    use model_description::call_table::State;
    use serde::{Deserialize, Deserializer, Serializer, de::Error};

    pub(super) fn serialize<S: Serializer>(state: &State, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_u8(*state as u8)
    }

    pub(super) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<State, D::Error> {
        let column = u8::deserialize(deserializer)?;
        let state = State::ALL.get(usize::from(column)).copied();
        state.ok_or_else(|| D::Error::custom(format_args!("no state has the number {column}")))
    }
}

//! The model inside an instance, with its type erased: setup, handles, state.

use std::any::Any;

use crate::fmi2::access::AccessTable;
use crate::fmi2::instance::content;
use crate::fmi2::problem::{Problem, StateMismatch};
use crate::model::{Context, Failure, Log, Model, Step};
use crate::variables::{Real, Values};

/// A model's state, its type erased: an `Option<M::State>`, `None` before initialization.
pub(crate) type ErasedState = Box<dyn Any + Send>;

/// One model instance; every method is one call of the [`Model`] trait.
pub(crate) trait Runtime: Send {
    fn initialize(&mut self, values: &mut Values, start_s: f64, log: &dyn Log) -> Result<(), Failure>;
    fn step(&mut self, values: &mut Values, step: &Step<'_>, log: &dyn Log) -> Result<(), Problem>;
    fn output_derivative(&self, values: &Values, output: u32, log: &dyn Log) -> Result<f64, Problem>;
    fn directional_derivative(
        &self,
        values: &Values,
        unknowns: &[u32],
        knowns: &[u32],
        seed: &[f64],
        result: &mut [f64],
        log: &dyn Log,
    ) -> Result<(), Problem>;
    /// The parameter that the experiment's tolerance stands in for.
    fn tolerance(&self) -> Option<Real>;
    /// Forgets the state.
    fn clear(&mut self);
    /// A copy of the state, in `reuse` where its type allows.
    fn save(&self, reuse: Option<ErasedState>) -> ErasedState;
    /// Takes over a saved state.
    fn restore(&mut self, saved: &ErasedState) -> Result<(), StateMismatch>;
    /// Whether a saved state holds one, that is, was taken after initialization.
    fn is_initialized(&self, saved: &ErasedState) -> bool;
    /// Bytes that [`Runtime::encode`] needs.
    fn encoded_size(&self, saved: &ErasedState) -> Result<usize, StateMismatch>;
    /// Writes a saved state into `bytes` and says how many it took.
    fn encode(&self, saved: &ErasedState, bytes: &mut [u8]) -> Result<usize, StateMismatch>;
    /// Reads what [`Runtime::encode`] wrote, all of `bytes`; total: any bytes give a state or an error.
    fn decode(&self, bytes: &[u8]) -> Result<ErasedState, StateMismatch>;
    /// Whether a decoded state belongs to a communication point.
    fn check_time(&self, decoded: &ErasedState, time_s: f64) -> Result<(), StateMismatch>;
}

/// The one [`Runtime`].
pub(crate) struct Typed<M: Model> {
    pub(crate) setup: M::Setup,
    pub(crate) variables: M::Variables,
    pub(crate) state: Option<M::State>,
}

impl<M: Model> Typed<M> {
    fn context<'a>(&'a self, log: &'a dyn Log) -> Context<'a, M> {
        Context { setup: &self.setup, variables: &self.variables, log }
    }

    fn own(saved: &ErasedState) -> Result<&Option<M::State>, StateMismatch> {
        saved.downcast_ref().ok_or(StateMismatch::Mark)
    }
}

impl<M: Model> Runtime for Typed<M> {
    fn initialize(&mut self, values: &mut Values, start_s: f64, log: &dyn Log) -> Result<(), Failure> {
        self.state = Some(M::initialize(&self.context(log), values, start_s)?);
        Ok(())
    }

    fn step(&mut self, values: &mut Values, step: &Step<'_>, log: &dyn Log) -> Result<(), Problem> {
        let context = Context { setup: &self.setup, variables: &self.variables, log };
        let state = self.state.as_mut().ok_or(Problem::NotInitialized)?;
        Ok(M::step(&context, values, state, step)?)
    }

    fn output_derivative(&self, values: &Values, output: u32, log: &dyn Log) -> Result<f64, Problem> {
        let state = self.state.as_ref().ok_or(Problem::NotInitialized)?;
        let derivative =
            M::output_derivative(&self.context(log), values, state, Real::from_reference(output));
        Ok(derivative.unwrap_or(0.0))
    }

    fn directional_derivative(
        &self,
        values: &Values,
        unknowns: &[u32],
        knowns: &[u32],
        seed: &[f64],
        result: &mut [f64],
        log: &dyn Log,
    ) -> Result<(), Problem> {
        let state = self.state.as_ref().ok_or(Problem::NotInitialized)?;
        let context = self.context(log);
        Ok(M::directional_derivative(&context, values, state, unknowns, knowns, seed, result)?)
    }

    fn tolerance(&self) -> Option<Real> {
        M::tolerance(&self.variables)
    }

    fn clear(&mut self) {
        self.state = None;
    }

    fn save(&self, reuse: Option<ErasedState>) -> ErasedState {
        match reuse.map(|old| old.downcast::<Option<M::State>>()) {
            Some(Ok(mut old)) => {
                (*old).clone_from(&self.state);
                old
            }
            _ => Box::new(self.state.clone()),
        }
    }

    fn restore(&mut self, saved: &ErasedState) -> Result<(), StateMismatch> {
        self.state.clone_from(Self::own(saved)?);
        Ok(())
    }

    fn is_initialized(&self, saved: &ErasedState) -> bool {
        Self::own(saved).is_ok_and(Option::is_some)
    }

    fn encoded_size(&self, saved: &ErasedState) -> Result<usize, StateMismatch> {
        postcard::serialize_with_flavor(Self::own(saved)?, postcard::ser_flavors::Size::default())
            .map_err(unencodable)
    }

    fn encode(&self, saved: &ErasedState, bytes: &mut [u8]) -> Result<usize, StateMismatch> {
        postcard::to_slice(Self::own(saved)?, bytes).map(|used| used.len()).map_err(unencodable)
    }

    fn decode(&self, bytes: &[u8]) -> Result<ErasedState, StateMismatch> {
        let (state, rest) = postcard::take_from_bytes::<Option<M::State>>(bytes)
            .map_err(|error| content(format!("model state: {error}")))?;
        if !rest.is_empty() {
            return Err(content(format!("{} bytes after the model state", rest.len())));
        }
        if let Some(state) = &state {
            M::check_state(&self.setup, state).map_err(|failure| content(failure.to_string()))?;
        }
        Ok(Box::new(state))
    }

    fn check_time(&self, decoded: &ErasedState, time_s: f64) -> Result<(), StateMismatch> {
        match Self::own(decoded)? {
            Some(state) => M::check_time(state, time_s).map_err(|failure| content(failure.to_string())),
            None => Ok(()),
        }
    }
}

pub(crate) fn unencodable(error: postcard::Error) -> StateMismatch {
    content(format!("cannot be encoded: {error}"))
}

/// Everything an instance is made from.
pub(crate) struct Parts {
    pub(crate) access: AccessTable,
    pub(crate) start: Values,
    pub(crate) runtime: Box<dyn Runtime>,
    pub(crate) digest: uuid::Uuid,
    pub(crate) capabilities: Capabilities,
}

/// What the model's constants say.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Capabilities {
    pub(crate) max_output_derivative_order: u32,
    pub(crate) interpolates_inputs: bool,
}

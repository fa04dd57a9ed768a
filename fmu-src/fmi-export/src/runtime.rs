//! The model inside an instance, with its type erased: setup, handles, state.

use std::any::Any;
use std::sync::Arc;

use crate::bounded::check_finite;
use crate::dependencies::Knowns;
use crate::model::{Context, Failure, Log, Model, OutputGroups, SetupError, Step, StepEnd};
use crate::variables::{Element, Real, SetBits, Values};

/// A model's state, its type erased: an `Option<M::State>`, `None` before initialization.
pub(crate) type ErasedState = Box<dyn Any + Send>;

/// Declares [`Runtime`] and implements it for every model from one text.
macro_rules! runtime {
    ($($(#[$doc:meta])* fn $name:ident $parameters:tt $(-> $result:ty)? $body:block)*) => {
        /// One model instance; every method is one call of the [`Model`] trait.
        pub(crate) trait Runtime: Send {
            $($(#[$doc])* fn $name $parameters $(-> $result)?;)*
        }

        impl<M: Model> Runtime for Typed<M> {
            $(fn $name $parameters $(-> $result)? $body)*
        }
    };
}

/// The one [`Runtime`].
pub(crate) struct Typed<M: Model> {
    pub(crate) setup: M::Setup,
    pub(crate) variables: M::Variables,
    pub(crate) start: Arc<Values>,
    /// Places of the parameters that an importer may set.
    pub(crate) parameters: [SetBits; Element::TABLES],
    pub(crate) state: Option<M::State>,
}

impl<M: Model> Typed<M> {
    fn context<'a>(&'a self, values: &Values, log: &'a dyn Log) -> Context<'a, M> {
        let Self { setup, variables, start, parameters, .. } = self;
        Context { setup, variables, start, sets_all_parameters: values.are_all_set(parameters), log }
    }

    /// The context and the state to be changed.
    fn parts<'a>(
        &'a mut self,
        values: &Values,
        log: &'a dyn Log,
    ) -> Result<(Context<'a, M>, &'a mut M::State), Failure> {
        let Self { setup, variables, start, parameters, state } = self;
        let sets_all_parameters = values.are_all_set(parameters);
        let context = Context { setup, variables, start, sets_all_parameters, log };
        Ok((context, state.as_mut().ok_or_else(not_initialized)?))
    }

    fn check_state(&self, state: &M::State) -> Result<(), Failure> {
        check_finite(state)?;
        M::check_state(&self.setup, state)
    }

    fn own(saved: &ErasedState) -> Result<&Option<M::State>, Failure> {
        saved.downcast_ref().ok_or_else(|| Failure::new("it is the state of another model"))
    }
}

runtime! {
    /// Parses a schedule into the setup, before anything else is called.
    fn set_schedule(&mut self, schedule: &str, file: &str, text: &str) -> Result<(), SetupError> {
        M::parse_schedule(&mut self.setup, schedule, file, text)
    }

    fn initialize(&mut self, values: &mut Values, start_s: f64, log: &dyn Log) -> Result<(), Failure> {
        self.state = Some(M::initialize(&self.context(values, log), values, start_s)?);
        Ok(())
    }

    /// Writes parameters as they act.
    fn resolve_parameters(&self, values: &mut Values, log: &dyn Log) {
        M::resolve_parameters(&self.context(values, log), values);
    }

    fn step(&mut self, values: &mut Values, step: &Step<'_>, log: &dyn Log) -> Result<StepEnd, Failure> {
        let (context, state) = self.parts(values, log)?;
        M::step(&context, values, state, step)
    }

    /// Groups of outputs that are written when they are read.
    fn output_groups(&self) -> Vec<Knowns> {
        M::EXTENSIONS.deferred_outputs.map_or_else(Vec::new, |it| (it.groups)(&self.variables))
    }

    /// Writes the outputs of these groups at the last communication point.
    fn write_outputs(
        &mut self,
        values: &mut Values,
        groups: OutputGroups,
        time_s: f64,
        log: &dyn Log,
    ) -> Result<(), Failure> {
        let (context, state) = self.parts(values, log)?;
        M::EXTENSIONS.write_outputs(&context, values, state, groups, time_s)
    }

    fn output_rate(&self, values: &Values, output: Real, log: &dyn Log) -> Result<f64, Failure> {
        let state = self.state.as_ref().ok_or_else(not_initialized)?;
        let context = self.context(values, log);
        let rate = M::EXTENSIONS.output_rate.and_then(|rate| rate(&context, values, state, output));
        Ok(rate.unwrap_or(0.0))
    }

    fn jacobian_vector_product(
        &self,
        values: &Values,
        unknowns: &[Real],
        seeds: &[(Real, f64)],
        products: &mut [f64],
        log: &dyn Log,
    ) -> Result<(), Failure> {
        let state = self.state.as_ref().ok_or_else(not_initialized)?;
        let Some(product) = M::EXTENSIONS.jacobian_vector_product else {
            return Err(Failure::new("this model provides no directional derivatives"));
        };
        product(&self.context(values, log), values, state, unknowns, seeds, products)
    }

    /// Forgets the state.
    fn clear(&mut self) {
        self.state = None;
    }

    /// A copy of the state, in `reuse` where its type allows.
    fn save(&self, reuse: Option<ErasedState>) -> ErasedState {
        match reuse.map(|old| old.downcast::<Option<M::State>>()) {
            Some(Ok(mut old)) => {
                (*old).clone_from(&self.state);
                old
            }
            _ => Box::new(self.state.clone()),
        }
    }

    /// Takes over a saved state.
    fn restore(&mut self, saved: &ErasedState) -> Result<(), Failure> {
        self.state.clone_from(Self::own(saved)?);
        Ok(())
    }

    /// Whether a saved state holds one, that is, was taken after initialization.
    fn is_initialized(&self, saved: &ErasedState) -> bool {
        Self::own(saved).is_ok_and(Option::is_some)
    }

    /// Whether [`Runtime::decode`] would take what is saved.
    fn check(&self, saved: &ErasedState) -> Result<(), Failure> {
        match Self::own(saved)? {
            Some(state) => self.check_state(state),
            None => Ok(()),
        }
    }

    /// Bytes that [`Runtime::encode`] needs.
    fn encoded_size(&self, saved: &ErasedState) -> Result<usize, Failure> {
        postcard::serialize_with_flavor(Self::own(saved)?, postcard::ser_flavors::Size::default())
            .map_err(unencodable)
    }

    /// Writes a saved state into `bytes` and returns how many it took.
    fn encode(&self, saved: &ErasedState, bytes: &mut [u8]) -> Result<usize, Failure> {
        postcard::to_slice(Self::own(saved)?, bytes).map(|used| used.len()).map_err(unencodable)
    }

    /// Reads what [`Runtime::encode`] wrote, all of `bytes`; total: any bytes give a state or an error.
    fn decode(&self, bytes: &[u8]) -> Result<ErasedState, Failure> {
        let (state, rest) = postcard::take_from_bytes::<Option<M::State>>(bytes)
            .map_err(|error| Failure::new(format!("model state: {error}")))?;
        if !rest.is_empty() {
            return Err(Failure::new(format!("{} bytes after the model state", rest.len())));
        }
        if let Some(state) = &state {
            self.check_state(state)?;
        }
        Ok(Box::new(state))
    }

    /// Whether a decoded state belongs to a communication point.
    fn check_time(&self, decoded: &ErasedState, time_s: f64) -> Result<(), Failure> {
        match Self::own(decoded)? {
            Some(state) => M::check_time(state, time_s),
            None => Ok(()),
        }
    }
}

pub(crate) fn unencodable(error: postcard::Error) -> Failure {
    Failure::new(format!("cannot be encoded: {error}"))
}

fn not_initialized() -> Failure {
    Failure::new("nothing has been computed: the initialization failed or never ran")
}

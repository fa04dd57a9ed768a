//! The model traits: what an author writes, and in which order it is called. They are free of any version of FMI.
//!
//! [`Model`] is for every model. [`OutputRates`], [`Differentiable`] and [`DeferredOutputs`] are optional and named in
//! [`Model::EXTENSIONS`]; other abilities (continuous states with rates and event indicators) would become another
//! trait and another field there.

mod about;
mod output_groups;
mod step;

use serde::{Serialize, de::DeserializeOwned};

use crate::dependencies::{Dependencies, Knowns};
use crate::variables::{Elements, Given, Real, Values, Variables};

pub use about::{About, Manual, SetupValue, StartValue};
pub use output_groups::OutputGroups;
pub use step::{InputDerivative, InputsOverTime, Step, StepEnd};

/// A co-simulation model.
///
/// The order of calls in one instance: [`Model::parse_setup`] once, [`Model::parse_schedule`] once for each schedule there
/// is, then [`Model::initialize`] whenever
/// parameters changed before the first step (it is a pure function of its arguments and may run several
/// times), then [`Model::step`] with strictly increasing times. Between two steps the state may be cloned,
/// serialised, restored or thrown away. All a model knows is in `Setup` (immutable, shared), `Values` (what
/// the importer sees) and `State` (what only the model sees); there is nothing else, so restoring these
/// restores the model to the bit.
pub trait Model: Sized + 'static {
    /// `modelName` and default `modelIdentifier`: a C identifier.
    const NAME: &'static str;
    /// Raised whenever the meaning of `State` changes; part of the GUID.
    const STATE_VERSION: u32;
    /// File under `resources/` that holds the setup, or `None` for a model without resources.
    const SETUP_FILE: Option<&'static str> = None;
    /// Files under `resources/` that hold schedules, commands or data over time; each is optional next to
    /// the setup. A schedule does not enter the GUID: one FMU simulates many.
    const SCHEDULE_FILES: &'static [&'static str] = &[];
    /// The compiled-in setup text, used when an importer gives no resource location.
    const DEFAULT_SETUP: &'static str = "";
    /// Inputs of the reference flight that a packed FMU carries: CSV whose first column, `time`, counts steps of the default
    /// experiment. Columns that a setup has no input for are left out.
    const REFERENCE_INPUTS: &'static str = "";
    /// Purpose and use of the model, for its manual.
    const MANUAL: Manual = Manual::NONE;
    /// The optional traits that the model implements.
    const EXTENSIONS: Extensions<Self> = Extensions::none();

    /// Content of the resources; serialised only to enter the GUID.
    type Setup: Serialize + Send + Sync + 'static;
    /// The declared variables as handles.
    type Variables: Variables<Self::Setup> + Send + Sync + 'static;
    /// Everything a step needs from the steps before.
    type State: Clone + Serialize + DeserializeOwned + Send + 'static;

    /// Parses and validates the setup text; `file` names it in errors.
    fn parse_setup(file: &str, text: &str) -> Result<Self::Setup, SetupError>;

    /// Parses and validates one of [`Model::SCHEDULE_FILES`], `schedule`, and puts it into the setup, where it may not change
    /// what is declared; `file` names it in errors. Called at most once for each, before the first instance call.
    fn parse_schedule(
        _setup: &mut Self::Setup,
        _schedule: &str,
        file: &str,
        _text: &str,
    ) -> Result<(), SetupError> {
        Err(SetupError(format!("{file}: {} takes no schedule", Self::NAME)))
    }

    /// Start values that the setup gives to parameters and inputs, instead of the declared ones; those that it fixes become local
    /// constants. What they are for is checked when the model is described.
    fn start_values(_setup: &Self::Setup) -> Vec<StartValue> {
        Vec::new()
    }

    /// Start values that follow from those of `start` and are declared in place of what the setup leaves open: each is of a
    /// parameter that it did not give. They count as given by nobody.
    fn following_start_values(
        _setup: &Self::Setup,
        _variables: &Self::Variables,
        _start: &Values,
    ) -> Vec<StartValue> {
        Vec::new()
    }

    /// Description, default experiment and the like.
    fn about(setup: &Self::Setup) -> About;

    /// Builds the state at `start_time_s` from parameters and inputs, and writes every output and calculated
    /// parameter into `values`. Pure: same arguments, same result.
    fn initialize(
        context: &Context<'_, Self>,
        values: &mut Values,
        start_time_s: f64,
    ) -> Result<Self::State, Failure>;

    /// Advances from `step.start_s` to `step.end_s`, or to an earlier time that it gives back, and writes the outputs there, but for
    /// those of [`DeferredOutputs`].
    ///
    /// After an error the instance is not used further: `state` and `values` may be half written.
    fn step(
        context: &Context<'_, Self>,
        values: &mut Values,
        state: &mut Self::State,
        step: &Step<'_>,
    ) -> Result<StepEnd, Failure>;

    /// Writes the parameters that the importer left to the model as they act, so that they read back. Called once, when
    /// initialization ends: [`Model::initialize`] may run again before, with the values that were set.
    fn resolve_parameters(_context: &Context<'_, Self>, _values: &mut Values) {}

    /// Checks a length or index inside a decoded state against the setup; an error refuses the blob.
    fn check_state(_setup: &Self::Setup, _state: &Self::State) -> Result<(), Failure> {
        Ok(())
    }

    /// Checks that a decoded state belongs to the communication point `time_s`, from which a step could follow;
    /// an error refuses the blob. A step that begins elsewhere might otherwise never end.
    fn check_time(_state: &Self::State, _time_s: f64) -> Result<(), Failure> {
        Ok(())
    }

    /// The parameter by which the importer chooses how exact the results are, if there is one. A tolerance of the experiment
    /// becomes its value (within its limits) before [`Model::initialize`], unless the importer set the parameter itself. Its
    /// default should be [`About::tolerance`]: importers give that back.
    fn tolerance(_variables: &Self::Variables) -> Option<Real> {
        None
    }

    /// Dependencies of every output and calculated parameter: the union over all values of all options but those that the setup
    /// fixes. An unknown without a row is refused.
    fn dependencies(setup: &Self::Setup, variables: &Self::Variables) -> Dependencies;
}

/// A model that knows how fast its outputs change.
pub trait OutputRates: Model {
    /// First time derivative of an output at the last communication point; `None` counts as 0.
    fn output_rate(
        context: &Context<'_, Self>,
        values: &Values,
        state: &Self::State,
        output: Real,
    ) -> Option<f64>;
}

/// A model with partial derivatives.
pub trait Differentiable: Model {
    /// The Jacobian d(unknowns)/d(knowns) at the last communication point times a vector: `seeds` are the knowns, each with
    /// its component of the vector, one known perhaps several times; `products` is as long as `unknowns`. Six arguments: those of
    /// `fmi2GetDirectionalDerivative` and the three that every function of a model has.
    fn jacobian_vector_product(
        context: &Context<'_, Self>,
        values: &Values,
        state: &Self::State,
        unknowns: &[Real],
        seeds: &[(Real, f64)],
        products: &mut [f64],
    ) -> Result<(), Failure>;
}

/// A model that writes groups of outputs when one of them is read: an output that nobody reads costs nothing.
pub trait DeferredOutputs: Model {
    /// Outputs of each group, at most [`OutputGroups::MOST`] groups. No output belongs to two of them. What belongs to none, and
    /// what a set has that is no output, is written as in any model.
    fn output_groups(variables: &Self::Variables) -> Vec<Knowns>;

    /// Writes the outputs of these groups at the last communication point, `time_s`; `values` are those of the step that ended
    /// there. Called after [`Model::step`], at most once for each group, before the next step and before the state is saved.
    /// [`Model::initialize`] writes every output itself. An error ends the instance, as an error of the step does.
    fn write_outputs(
        context: &Context<'_, Self>,
        values: &mut Values,
        state: &mut Self::State,
        groups: OutputGroups,
        time_s: f64,
    ) -> Result<(), Failure>;
}

type OutputRate<M> = fn(&Context<'_, M>, &Values, &<M as Model>::State, Real) -> Option<f64>;
type JacobianVectorProduct<M> = fn(
    &Context<'_, M>,
    &Values,
    &<M as Model>::State,
    &[Real],
    &[(Real, f64)],
    &mut [f64],
) -> Result<(), Failure>;

type Groups<M> = fn(&<M as Model>::Variables) -> Vec<Knowns>;
type Write<M> =
    fn(&Context<'_, M>, &mut Values, &mut <M as Model>::State, OutputGroups, f64) -> Result<(), Failure>;

/// The functions of [`DeferredOutputs`].
pub(crate) struct DeferredFunctions<M: Model> {
    pub(crate) groups: Groups<M>,
    pub(crate) write: Write<M>,
}

impl<M: DeferredOutputs> DeferredFunctions<M> {
    pub(crate) const OF_MODEL: Self = Self { groups: M::output_groups, write: M::write_outputs };
}

/// The optional traits that a model has: `Extensions::none().output_rates().differentiable()`.
pub struct Extensions<M: Model> {
    pub(crate) output_rate: Option<OutputRate<M>>,
    pub(crate) jacobian_vector_product: Option<JacobianVectorProduct<M>>,
    pub(crate) deferred_outputs: Option<DeferredFunctions<M>>,
}

impl<M: Model> Extensions<M> {
    /// [`Model`] alone.
    pub const fn none() -> Self {
        Self { output_rate: None, jacobian_vector_product: None, deferred_outputs: None }
    }

    /// With [`OutputRates`].
    #[must_use]
    pub const fn output_rates(self) -> Self
    where
        M: OutputRates,
    {
        Self { output_rate: Some(M::output_rate), ..self }
    }

    /// With [`Differentiable`].
    #[must_use]
    pub const fn differentiable(self) -> Self
    where
        M: Differentiable,
    {
        Self { jacobian_vector_product: Some(M::jacobian_vector_product), ..self }
    }

    /// Writes deferred outputs of these groups, if the model has any.
    pub fn write_outputs(
        &self,
        context: &Context<'_, M>,
        values: &mut Values,
        state: &mut M::State,
        groups: OutputGroups,
        time_s: f64,
    ) -> Result<(), Failure> {
        self.deferred_outputs.as_ref().map_or(Ok(()), |it| (it.write)(context, values, state, groups, time_s))
    }

    /// Adds [`DeferredOutputs`].
    #[must_use]
    pub const fn deferred_outputs(self) -> Self
    where
        M: DeferredOutputs,
    {
        Self { deferred_outputs: Some(DeferredFunctions::OF_MODEL), ..self }
    }
}

/// Data that every call of a model may read.
pub struct Context<'a, M: Model> {
    /// The parsed resources.
    pub setup: &'a M::Setup,
    /// The variable handles.
    pub variables: &'a M::Variables,
    /// The start values of this FMU; what is set of them the setup gave.
    pub start: &'a Values,
    /// Whether the importer set every parameter that it may set, as tools do that write all of them.
    pub sets_all_parameters: bool,
    /// Receiver of events (dumps, eclipse edges ...); off costs nothing.
    pub log: &'a dyn Log,
}

impl<M: Model> Context<'_, M> {
    /// The variables of a group that the user gave a value.
    pub fn given<'v>(&'v self, values: &'v Values, group: &[Elements]) -> Given<'v> {
        Given::among(values, self.start, group)
    }

    /// The same, but sets of the importer count for nothing only where it set every parameter of the FMU, and these to their start
    /// values.
    pub fn given_deliberately<'v>(&'v self, values: &'v Values, group: &[Elements]) -> Given<'v> {
        self.given(values, group).deliberately(self.sets_all_parameters)
    }
}

/// Receives a model's messages.
pub trait Log {
    /// Whether events are logged; to be checked before a message is formatted.
    fn events_enabled(&self) -> bool;
    /// Reports an event at a time; `message` is plain text.
    fn event(&self, time_s: f64, message: &str);
    /// Reports something that the simulation continues with and its user should know.
    fn warning(&self, message: &str);
}

/// Why a model cannot continue; the text reaches the log.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct Failure(String);

impl Failure {
    /// From its text.
    pub fn new(message: impl Into<String>) -> Self {
        Self(message.into())
    }
}

/// A setup text that cannot be used: file, place, what was found, what is allowed.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct SetupError(pub String);

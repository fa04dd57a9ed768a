//! The model trait: what an author writes, and in which order it is called.

use serde::{Serialize, de::DeserializeOwned};

use crate::dependencies::Dependencies;
use crate::fmi2::StartValue;
use crate::variables::{Real, RealVector, Values, Variables};

/// A co-simulation model.
///
/// The order of calls in one instance: [`Model::parse_setup`] once, then [`Model::initialize`] whenever
/// parameters changed before the first step (it is a pure function of its arguments and may run several
/// times), then [`Model::step`] with strictly increasing times. Between two steps the state may be cloned,
/// serialised, restored or thrown away. All a model knows is in `Setup` (immutable, shared), `Values` (what
/// the master sees) and `State` (what only the model sees); there is nothing else, so restoring these
/// restores the model to the bit.
pub trait Model: Sized + 'static {
    /// `modelName` and default `modelIdentifier`: a C identifier.
    const NAME: &'static str;
    /// Raised whenever the meaning of `State` changes; part of the GUID.
    const STATE_VERSION: u32;
    /// File under `resources/` that holds the setup, or `None` for a model without resources.
    const SETUP_FILE: Option<&'static str>;
    /// The compiled-in setup text, used when an importer gives no resource location.
    const DEFAULT_SETUP: &'static str;
    /// By what the model computes, for its manual.
    const SOURCES: &'static [Source] = &[];
    /// Highest order `fmi2GetRealOutputDerivatives` answers.
    const MAX_OUTPUT_DERIVATIVE_ORDER: u32 = 0;
    /// Whether input derivatives have an effect.
    const CAN_INTERPOLATE_INPUTS: bool = true;
    /// Whether [`Model::directional_derivative`] is implemented.
    const PROVIDES_DIRECTIONAL_DERIVATIVE: bool = false;

    /// What the resources describe; serialised only to enter the GUID.
    type Setup: Serialize + Send + Sync + 'static;
    /// The declared variables as handles.
    type Variables: Variables<Self::Setup> + Send + Sync + 'static;
    /// Everything a step needs from the steps before.
    type State: Clone + Serialize + DeserializeOwned + Send + 'static;

    /// Parses and validates the setup text; `file` names it in errors.
    fn parse_setup(file: &str, text: &str) -> Result<Self::Setup, SetupError>;

    /// Start values that the setup gives to parameters and inputs, instead of the declared ones. What they are for
    /// is checked when the model is described.
    fn start_values(_setup: &Self::Setup) -> Vec<StartValue> {
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

    /// Advances from `step.start_s` to exactly `step.end_s` and writes the outputs there.
    ///
    /// On an error the instance is in FMI's error state: `state` and `values` may be half written.
    fn step(
        context: &Context<'_, Self>,
        values: &mut Values,
        state: &mut Self::State,
        step: &Step<'_>,
    ) -> Result<(), Failure>;

    /// Checks a length or index inside a decoded state against the setup; an error refuses the blob.
    fn check_state(_setup: &Self::Setup, _state: &Self::State) -> Result<(), Failure> {
        Ok(())
    }

    /// Checks that a decoded state belongs to the communication point `time_s`, from which a step could follow;
    /// an error refuses the blob. A step that begins elsewhere might otherwise never end.
    fn check_time(_state: &Self::State, _time_s: f64) -> Result<(), Failure> {
        Ok(())
    }

    /// First time derivative of an output at the last communication point; `None` counts as 0.
    fn output_derivative(
        _context: &Context<'_, Self>,
        _values: &Values,
        _state: &Self::State,
        _output: Real,
    ) -> Option<f64> {
        None
    }

    /// The parameter by which the master chooses how exact the results are, if there is one. A tolerance given to
    /// `fmi2SetupExperiment` becomes its value (within its limits) before [`Model::initialize`], unless the master set the
    /// parameter itself. Its default should be [`About::tolerance`]: masters give that back.
    fn tolerance(_variables: &Self::Variables) -> Option<Real> {
        None
    }

    /// What every output and calculated parameter depends on: the union over all values of all options. Written as
    /// `dependencies` under `ModelStructure`; an unknown without a row is refused.
    fn dependencies(setup: &Self::Setup, variables: &Self::Variables) -> Dependencies;

    /// Product of the Jacobian d(unknown)/d(known) with `seed` at the last communication point.
    /// `unknowns`, `knowns` are value references of Reals; `result` is as long as `unknowns`.
    fn directional_derivative(
        _context: &Context<'_, Self>,
        _values: &Values,
        _state: &Self::State,
        _unknowns: &[u32],
        _knowns: &[u32],
        _seed: &[f64],
        _result: &mut [f64],
    ) -> Result<(), Failure> {
        Err(Failure::new("this model provides no directional derivatives"))
    }
}

/// What every call of a model may read.
pub struct Context<'a, M: Model> {
    /// The parsed resources.
    pub setup: &'a M::Setup,
    /// The variable handles.
    pub variables: &'a M::Variables,
    /// Where events (dumps, eclipse edges ...) are reported; off costs nothing.
    pub log: &'a dyn Log,
}

/// Receives a model's messages.
pub trait Log {
    /// Whether the category `logEvents` is listened to; ask before formatting a message.
    fn events_enabled(&self) -> bool;
    /// Reports an event at a time; `message` is plain text.
    fn event(&self, time_s: f64, message: &str);
    /// Reports something odd the instance lives with.
    fn warning(&self, message: &str);
}

/// One communication step.
#[derive(Clone, Copy)]
pub struct Step<'a> {
    /// Where the last step ended, in s.
    pub start_s: f64,
    /// Where this one ends, in s; later than `start_s`.
    pub end_s: f64,
    /// Whether an input or tunable parameter was set to a *different* value since the last step, or input
    /// derivatives are given for this one or ended with the last: whatever was computed ahead of `start_s` is void.
    pub changed: bool,
    /// Input derivatives (value reference, order from 1, value) at `start_s`, in no particular order.
    pub input_derivatives: &'a [(u32, u32, f64)],
}

impl Step<'_> {
    /// The input `handle` at `time_s` by its Taylor polynomial u(t) = u + sum u_k (t - start)^k / k!.
    pub fn input(&self, values: &Values, handle: Real, time_s: f64) -> f64 {
        let mut sum = values.real(handle);
        for &(reference, order, derivative) in self.input_derivatives {
            if reference == handle.reference() {
                let dt_s = time_s - self.start_s;
                sum += (1..=order).fold(derivative, |term, k| term * dt_s / f64::from(k));
            }
        }
        sum
    }

    /// The vector input `handle` at `time_s`, see [`Step::input`].
    pub fn input_vector<const N: usize>(
        &self,
        values: &Values,
        handle: RealVector<N>,
        time_s: f64,
    ) -> [f64; N] {
        core::array::from_fn(|i| self.input(values, handle.element(i), time_s))
    }
}

/// What the XML says of a model beside its variables.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct About {
    /// One or two sentences.
    pub description: String,
    /// Default start, stop and step in s.
    pub start_time_s: f64,
    /// See `start_time_s`.
    pub stop_time_s: f64,
    /// See `start_time_s`.
    pub step_size_s: f64,
    /// Relative tolerance of the results.
    pub tolerance: f64,
    /// Who made the model; empty = not said.
    pub author: String,
    /// Version of the model; empty = not said.
    pub version: String,
    /// Licence of the model in one line; empty = not said.
    pub license: String,
}

/// By what a quantity of a model is computed, or what a name of a source stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Source {
    /// The quantity or the name.
    pub what: &'static str,
    /// Paper and equation, method, title.
    pub by: &'static str,
}

/// Why a model cannot go on; the text reaches the master's log.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{message}")]
pub struct Failure {
    message: String,
    terminated: bool,
    last_time_s: Option<f64>,
}

impl Failure {
    /// An error: the step was not carried out.
    pub fn new(message: impl Into<String>) -> Self {
        Self { message: message.into(), terminated: false, last_time_s: None }
    }

    /// The model ended by itself where the step began: `fmi2Discard` with `fmi2Terminated`.
    pub fn terminated(message: impl Into<String>) -> Self {
        Self { message: message.into(), terminated: true, last_time_s: None }
    }

    /// The model ended by itself at `time_s` within the step (`fmi2LastSuccessfulTime`); `values` hold the
    /// outputs there.
    pub fn terminated_at(message: impl Into<String>, time_s: f64) -> Self {
        Self { message: message.into(), terminated: true, last_time_s: Some(time_s) }
    }

    /// Where the model ended, if it said so.
    pub fn last_time_s(&self) -> Option<f64> {
        self.last_time_s
    }

    /// Whether the model ended by itself.
    pub fn is_terminated(&self) -> bool {
        self.terminated
    }
}

/// A setup text that cannot be used: file, place, what was found, what is allowed.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct SetupError(pub String);

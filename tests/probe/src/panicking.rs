//! The model that panics: in the callback that its setup or the parameter `fault` names.

use fmi_export::{
    About, Choice, Context, Dependencies, Differentiable, Enumeration, Extensions, Failure, Model,
    OutputRates, Real, SetupError, Step, StepEnd, Values, Variables, knowns,
};
use serde::{Deserialize, Deserializer, Serialize, Serializer, de, ser};

/// A model that has faults.
pub struct Panicking;

/// Callback in which the setup makes [`Panicking`] panic.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "camelCase")]
enum PanicCallback {
    Nowhere,
    ParseSetup,
    About,
    Declare,
    SerializeSetup,
}

/// The content of `panicking.toml`.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Setup {
    panic_in: PanicCallback,
}

/// Where and how the model goes wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Enumeration)]
pub enum Fault {
    /// Never.
    Nowhere,
    /// Panic in initialize.
    Initialize,
    /// Panic in step, with half of the outputs written.
    Step,
    /// Panic in `check_state`.
    CheckState,
    /// Panic in `output_rate`.
    OutputDerivative,
    /// Panic in `jacobian_vector_product`.
    DirectionalDerivative,
    /// Panic when the state is dropped.
    DropState,
    /// Panic when the state is cloned.
    CloneState,
    /// Panic when the state is serialised.
    SerializeState,
    /// Panic when the state is deserialised.
    DeserializeState,
    /// Panic in step with something that is no text.
    StepPayload,
    /// Panic in step with something that panics when it is dropped.
    StepPayloadDrop,
    /// Fail in initialize without panic.
    FailInitialize,
    /// Fail in step without panic.
    FailStep,
    /// End by itself in step.
    TerminateStep,
    /// Serialisation of the state fails without panic.
    FailSerializeState,
    /// Refuse every restored state without panic.
    FailCheckState,
    /// Panic in step by an index out of range.
    StepIndex,
    /// Leave every step longer than 0.2 s in the middle.
    StepShort,
    /// Leave every step where it began.
    StepStill,
}

/// The variables of [`Panicking`].
#[derive(Variables)]
#[variables(setup = Setup)]
pub struct PanickingVariables {
    /// Where and how the model goes wrong.
    #[parameter(tunable, start = setup.fault_at_start())]
    pub fault: Choice<Fault>,
    /// Goes to `output`.
    #[input(unit = "1", start = 1.0)]
    pub input: Real,
    /// `input` at the communication point.
    #[output(unit = "1")]
    pub output: Real,
    /// Time of the communication point.
    #[output(unit = "s")]
    pub clock: Real,
}

/// The state: a count of steps and the fault waiting in it.
#[derive(Debug, Serialize, Deserialize)]
pub struct State {
    #[serde(serialize_with = "serialize_fault", deserialize_with = "deserialize_fault")]
    fault: Fault,
    steps: u32,
}

#[allow(clippy::panic, reason = "panicking is what this model is for")]
fn panic_if(fault: bool, place: &str) {
    if fault {
        panic!("this is the fault in {place}: 100 % deliberate");
    }
}

#[allow(clippy::panic, reason = "panicking is what this model is for")]
fn panic_with<T: Send + 'static>(payload: T) -> ! {
    std::panic::panic_any(payload)
}

/// A panic's payload that panics in its own Drop.
struct PanicsOnDrop;

impl Drop for PanicsOnDrop {
    fn drop(&mut self) {
        panic_if(!std::thread::panicking(), "the payload's Drop");
    }
}

impl Setup {
    fn panic_if(&self, place: PanicCallback) {
        panic_if(self.panic_in == place, &format!("{place:?}"));
    }

    fn fault_at_start(&self) -> Fault {
        self.panic_if(PanicCallback::Declare);
        Fault::Nowhere
    }
}

impl Serialize for Setup {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.panic_if(PanicCallback::SerializeSetup);
        serializer.serialize_unit()
    }
}

impl State {
    fn panic_if(&self, fault: Fault) {
        panic_if(self.fault == fault, &format!("{fault:?}"));
    }
}

impl Clone for State {
    fn clone(&self) -> Self {
        self.panic_if(Fault::CloneState);
        Self { fault: self.fault, steps: self.steps }
    }
}

impl Drop for State {
    fn drop(&mut self) {
        // A second panic while unwinding aborts the process; no boundary can catch that.
        if !std::thread::panicking() {
            self.panic_if(Fault::DropState);
        }
    }
}

fn serialize_fault<S: Serializer>(fault: &Fault, serializer: S) -> Result<S::Ok, S::Error> {
    panic_if(*fault == Fault::SerializeState, "SerializeState");
    if *fault == Fault::FailSerializeState {
        return Err(ser::Error::custom("this state cannot be serialised"));
    }
    serializer.serialize_i32(fault.value())
}

fn deserialize_fault<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Fault, D::Error> {
    let value = i32::deserialize(deserializer)?;
    let fault =
        Fault::from_value(value).ok_or_else(|| de::Error::custom(format!("{value} is no item of Fault")))?;
    panic_if(fault == Fault::DeserializeState, "DeserializeState");
    Ok(fault)
}

/// The fault chosen now.
fn chosen(context: &Context<'_, Panicking>, values: &Values) -> Fault {
    values.choice(context.variables.fault)
}

impl Model for Panicking {
    const NAME: &'static str = "Panicking";
    const STATE_VERSION: u32 = 1;
    const SETUP_FILE: Option<&'static str> = Some("panicking.toml");
    const DEFAULT_SETUP: &'static str = include_str!("../resources/panicking.toml");
    const EXTENSIONS: Extensions<Self> = Extensions::none().output_rates().differentiable();

    type Setup = Setup;
    type Variables = PanickingVariables;
    type State = State;

    fn parse_setup(file: &str, text: &str) -> Result<Setup, SetupError> {
        let setup: Setup = toml::from_str(text).map_err(|error| SetupError(format!("{file}: {error}")))?;
        setup.panic_if(PanicCallback::ParseSetup);
        Ok(setup)
    }

    fn about(setup: &Setup) -> About {
        setup.panic_if(PanicCallback::About);
        About {
            description: "Panics or fails where `fault` says.".to_owned(),
            stop_time_s: 1.0,
            step_size_s: 0.1,
            tolerance: 1e-6,
            ..About::default()
        }
    }

    fn initialize(
        context: &Context<'_, Self>,
        values: &mut Values,
        start_time_s: f64,
    ) -> Result<State, Failure> {
        let fault = chosen(context, values);
        panic_if(fault == Fault::Initialize, "Initialize");
        if fault == Fault::FailInitialize {
            return Err(Failure::new("initialize fails, 100 % deliberately"));
        }
        values.set_real(context.variables.output, values.real(context.variables.input));
        values.set_real(context.variables.clock, start_time_s);
        Ok(State { fault, steps: 0 })
    }

    fn step(
        context: &Context<'_, Self>,
        values: &mut Values,
        state: &mut State,
        step: &Step<'_>,
    ) -> Result<StepEnd, Failure> {
        state.fault = chosen(context, values);
        state.steps = state.steps.saturating_add(1);
        let input = step.inputs.real(values, context.variables.input, step.end_s);
        values.set_real(context.variables.output, input);
        state.panic_if(Fault::Step);
        match state.fault {
            Fault::StepPayload => panic_with(42_u8),
            Fault::StepPayloadDrop => panic_with(PanicsOnDrop),
            Fault::StepIndex => {
                values.set_real(context.variables.output, [input][state.steps as usize]);
            }
            Fault::FailStep => return Err(Failure::new("step fails, 100 % deliberately")),
            Fault::TerminateStep => return Ok(StepEnd::at(step.start_s).terminate("the model ends here")),
            _ => {}
        }
        let length_s = step.end_s - step.start_s;
        let end_s = match state.fault {
            Fault::StepShort if length_s > 0.2 => step.start_s + length_s / 2.0,
            Fault::StepStill => step.start_s,
            _ => step.end_s,
        };
        let input = step.inputs.real(values, context.variables.input, end_s);
        values.set_real(context.variables.output, input);
        values.set_real(context.variables.clock, end_s);
        Ok(StepEnd::at(end_s))
    }

    fn check_state(_setup: &Setup, state: &State) -> Result<(), Failure> {
        state.panic_if(Fault::CheckState);
        if state.fault == Fault::FailCheckState {
            return Err(Failure::new("this state is refused, 100 % deliberately"));
        }
        Ok(())
    }

    fn dependencies(_setup: &Setup, variables: &PanickingVariables) -> Dependencies {
        let mut table = Dependencies::new();
        table.output(variables.output, variables.input, variables.input);
        table.output(variables.clock, knowns![], knowns![]);
        table
    }
}

impl OutputRates for Panicking {
    fn output_rate(
        context: &Context<'_, Self>,
        values: &Values,
        _state: &State,
        _output: Real,
    ) -> Option<f64> {
        panic_if(chosen(context, values) == Fault::OutputDerivative, "OutputDerivative");
        None
    }
}

impl Differentiable for Panicking {
    fn jacobian_vector_product(
        context: &Context<'_, Self>,
        values: &Values,
        _state: &State,
        unknowns: &[Real],
        seeds: &[(Real, f64)],
        products: &mut [f64],
    ) -> Result<(), Failure> {
        panic_if(chosen(context, values) == Fault::DirectionalDerivative, "DirectionalDerivative");
        let (from, to) = (context.variables.input, context.variables.output);
        for (unknown, product) in unknowns.iter().zip(products) {
            let along = seeds.iter().filter(|(known, _)| *unknown == to && *known == from);
            *product = along.map(|(_, seed)| seed).sum();
        }
        Ok(())
    }
}

//! The model that has everything: each base type in each role, input and output derivatives, directional
//! derivatives, groups of run-time length, events. Outputs are inputs, so that what is right is plain to see.

mod dependencies;
mod setup;
mod variables;

use fmi_export::{
    About, Context, Dependencies, Differentiable, Extensions, Failure, InputsOverTime, Model, OutputRates,
    Real, SetupError, Step, StepEnd, Values,
};
use serde::{Deserialize, Serialize};

pub use setup::{Channel, Setup};
pub use variables::{AllTypesVariables, Colour};

/// A model with everything.
pub struct AllTypes;

/// Everything a step needs from the steps before.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct State {
    start_time_s: f64,
    steps: i32,
    boolean_before: bool,
    integral: Integral,
    feedthroughs: Vec<Feedthrough>,
}

/// The integral of a signal that has been constant since a time: kept so that cutting a step changes no bit.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct Integral {
    since_s: f64,
    value_there: f64,
    signal: f64,
}

/// A Real output at the last communication point: gain times input, and the input's slope.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct Feedthrough {
    gain: f64,
    slope: f64,
}

/// Input, output, and gain where it is not 1.
type Pair = (Real, Real, Option<Real>);

impl AllTypesVariables {
    /// The continuous Reals that go from an input to an output, in the order of `State::feedthroughs`.
    fn pairs(&self) -> impl Iterator<Item = Pair> + '_ {
        let (input, output) = (&self.input, &self.output);
        let vector = (0..3).map(|i| (input.vector.element(i), output.vector.element(i), None));
        let matrix =
            (0..6).map(|i| (input.matrix.element(i / 3, i % 3), output.matrix.element(i / 3, i % 3), None));
        let channels = self.channel.iter().map(|channel| (channel.input, channel.output, Some(channel.gain)));
        core::iter::once((input.real, output.real, None)).chain(vector).chain(matrix).chain(channels)
    }
}

impl Model for AllTypes {
    const NAME: &'static str = "AllTypes";
    const STATE_VERSION: u32 = 1;
    const SETUP_FILE: Option<&'static str> = Some("all-types.toml");
    const SCHEDULE_FILES: &'static [&'static str] = &["all-types-schedule.toml"];
    const DEFAULT_SETUP: &'static str = include_str!("../../resources/all-types.toml");
    const EXTENSIONS: Extensions<Self> = Extensions::none().output_rates().differentiable();

    type Setup = Setup;
    type Variables = AllTypesVariables;
    type State = State;

    fn parse_setup(file: &str, text: &str) -> Result<Setup, SetupError> {
        toml::from_str(text).map_err(|error| SetupError(format!("{file}: {error}")))
    }

    fn parse_schedule(setup: &mut Setup, _schedule: &str, file: &str, text: &str) -> Result<(), SetupError> {
        let schedule = toml::from_str(text).map_err(|error| SetupError(format!("{file}: {error}")));
        setup.end_s = schedule.map(|it: setup::Schedule| Some(it.end_s))?;
        Ok(())
    }

    fn about(setup: &Setup) -> About {
        About {
            description: format!(
                "Every type in every role, with {} channels; \"<&>\" – ünïcödé.",
                setup.channel.len()
            ),
            stop_time_s: 10.0,
            step_size_s: 0.5,
            tolerance: 1e-9,
            ..About::default()
        }
    }

    fn initialize(
        context: &Context<'_, Self>,
        values: &mut Values,
        start_time_s: f64,
    ) -> Result<State, Failure> {
        let variables = context.variables;
        let role = &variables.role;
        let fixed = values.real(variables.parameter.real);
        values.set_real(role.calculated_fixed, 2.0 * fixed);
        values.set_real(role.calculated_approx, 3.0 * fixed);
        let integer = values.integer(variables.parameter.integer);
        values.set_integer(role.local_fixed, integer.saturating_add(1));

        let still = Step {
            start_s: start_time_s,
            end_s: start_time_s,
            changed: true,
            parameters_changed: true,
            inputs: InputsOverTime::held(),
        };
        let mut state = State {
            start_time_s,
            steps: 0,
            boolean_before: values.boolean(variables.input.boolean),
            integral: Integral {
                since_s: start_time_s,
                value_there: 0.0,
                signal: values.real(variables.input.real),
            },
            feedthroughs: vec![Feedthrough { gain: 1.0, slope: 0.0 }; variables.pairs().count()],
        };
        write_outputs(variables, values, &mut state, &still);
        values.set_real(variables.output.integral, 0.0);
        Ok(state)
    }

    fn step(
        context: &Context<'_, Self>,
        values: &mut Values,
        state: &mut State,
        step: &Step<'_>,
    ) -> Result<StepEnd, Failure> {
        let variables = context.variables;
        report(context, values, state, step);
        let ends_at_s = values.real(variables.end.time).min(context.setup.end_s.unwrap_or(f64::INFINITY));
        if ends_at_s < step.start_s {
            return Ok(StepEnd::at(step.start_s).terminate("`end.time` is over"));
        }
        let whole_end_s = step.end_s;
        let step = &Step { end_s: whole_end_s.min(ends_at_s), ..*step };
        state.steps = state.steps.saturating_add(1);
        write_outputs(variables, values, state, step);
        let integral = integrate(&mut state.integral, values, variables.input.real, step);
        values.set_real(variables.output.integral, integral);
        let exact = values.integer(variables.role.output_exact);
        values.set_integer(variables.role.output_exact, exact.saturating_add(1));
        if step.end_s < whole_end_s {
            return Ok(StepEnd::at(step.end_s).terminate("`end.time` is reached"));
        }
        Ok(StepEnd::at(step.end_s))
    }

    fn check_state(setup: &Setup, state: &State) -> Result<(), Failure> {
        let (expected, found) = (10 + setup.channel.len(), state.feedthroughs.len());
        if expected == found {
            return Ok(());
        }
        Err(Failure::new(format!("the state has {found} feedthroughs, the setup {expected}")))
    }

    fn dependencies(_setup: &Setup, variables: &AllTypesVariables) -> Dependencies {
        dependencies::table(variables)
    }
}

impl OutputRates for AllTypes {
    fn output_rate(context: &Context<'_, Self>, values: &Values, state: &State, output: Real) -> Option<f64> {
        if output == context.variables.output.integral {
            return Some(values.real(context.variables.output.real));
        }
        let at = context.variables.pairs().position(|(_, to, _)| to == output)?;
        state.feedthroughs.get(at).map(|it| it.gain * it.slope)
    }
}

impl Differentiable for AllTypes {
    fn jacobian_vector_product(
        context: &Context<'_, Self>,
        _values: &Values,
        state: &State,
        unknowns: &[Real],
        seeds: &[(Real, f64)],
        products: &mut [f64],
    ) -> Result<(), Failure> {
        for (unknown, product) in unknowns.iter().zip(products) {
            *product = 0.0;
            for ((from, to, _), feedthrough) in context.variables.pairs().zip(&state.feedthroughs) {
                if to == *unknown {
                    let along = seeds.iter().filter(|(known, _)| *known == from);
                    *product += feedthrough.gain * along.map(|(_, seed)| seed).sum::<f64>();
                }
            }
        }
        Ok(())
    }
}

/// Reports the rising edge of `input.boolean` and a negative `input.integer`.
fn report(context: &Context<'_, AllTypes>, values: &Values, state: &mut State, step: &Step<'_>) {
    let input = &context.variables.input;
    let boolean = values.boolean(input.boolean);
    if boolean && !state.boolean_before && context.log.events_enabled() {
        // Percent and hash are what loggers stumble over.
        context.log.event(step.start_s, "input.boolean rose: 100 % of #1# %s %n");
    }
    state.boolean_before = boolean;
    let integer = values.integer(input.integer);
    if integer < 0 {
        context.log.warning(&format!("input.integer is {integer}, below 0"));
    }
}

/// Writes all that depends on nothing but inputs, tunable parameters and counters.
fn write_outputs(variables: &AllTypesVariables, values: &mut Values, state: &mut State, step: &Step<'_>) {
    for ((from, to, gain), feedthrough) in variables.pairs().zip(&mut state.feedthroughs) {
        feedthrough.gain = gain.map_or(1.0, |gain| values.real(gain));
        feedthrough.slope = slope(step, from);
        values.set_real(to, feedthrough.gain * step.inputs.real(values, from, step.end_s));
    }
    let AllTypesVariables { tunable, input, output, echo, role, .. } = variables;
    values.set_real(output.discrete_real, values.real(input.discrete_real));
    values.set_real(echo.real, values.real(tunable.real));
    values.set_vector(echo.vector, values.vector(tunable.vector));
    values.set_matrix(echo.matrix, values.matrix(tunable.matrix));
    for (from, to) in [(input.integer, output.integer), (tunable.integer, echo.integer)] {
        values.set_integer(to, values.integer(from));
    }
    for (from, to) in [(input.boolean, output.boolean), (tunable.boolean, echo.boolean)] {
        values.set_boolean(to, values.boolean(from));
    }
    for (from, to) in [(input.text, output.text), (tunable.text, echo.text)] {
        if values.text(from) != values.text(to) {
            let text = values.text(from).to_owned();
            values.set_text(to, &text);
        }
    }
    for (from, to) in [(input.choice, output.choice), (tunable.choice, echo.choice)] {
        values.set_choice(to, values.choice(from));
    }
    values.set_real(role.calculated_tunable, 2.0 * values.real(tunable.real));
    values.set_real(role.output_approx, step.end_s - state.start_time_s);
    values.set_boolean(role.local_tunable, !values.boolean(tunable.boolean));
    values.set_integer(role.local_discrete, state.steps);
    values.set_real(role.local_continuous, 0.5 * values.real(output.real));
}

/// The integral at the end of the step, exact for the input's Taylor polynomial.
fn integrate(integral: &mut Integral, values: &Values, input: Real, step: &Step<'_>) -> f64 {
    if step.changed {
        integral.value_there += integral.signal * (step.start_s - integral.since_s);
        integral.since_s = step.start_s;
        integral.signal = values.real(input);
    }
    let mut value = integral.value_there + integral.signal * (step.end_s - integral.since_s);
    let mut curved = false;
    for (order, derivative) in step.inputs.derivatives(input) {
        value += taylor(derivative, order.saturating_add(1), step.end_s - step.start_s);
        curved = true;
    }
    if curved {
        *integral = Integral { since_s: step.end_s, value_there: value, signal: integral.signal };
    }
    value
}

/// The slope of an input at the end of the step.
fn slope(step: &Step<'_>, input: Real) -> f64 {
    step.inputs
        .derivatives(input)
        .map(|(order, derivative)| taylor(derivative, order - 1, step.end_s - step.start_s))
        .sum()
}

/// derivative * dt^order / order!
fn taylor(derivative: f64, order: u32, dt_s: f64) -> f64 {
    (1..=order).fold(derivative, |term, k| term * dt_s / f64::from(k))
}

//! A flight of the model begins, steps, and waits for inputs that are not set yet.

use fmi_export::{Failure, InputsOverTime, Step, Values};
use nalgebra::Vector3;
use physics::plant::{Changes, DownlinkForecast, ModeSettings, Report, Start, StepContext, World};

use super::inputs::{self, dynamics, propulsion};
use super::outputs::{self, failure, log_dump};
use super::setup::Plan;
use super::state::{PlantState, unset_places};

/// The flight begins at `time_s`: everything it needs is known.
pub fn begin(
    context: &Plan<'_>,
    values: &mut Values,
    state: &mut PlantState,
    time_s: f64,
) -> Result<(), Failure> {
    configure(context, values, state)?;
    let is_dynamic = dynamics::is_dynamic(context, values);
    let mass_kg = values.real(context.variables.spacecraft.mass);
    propulsion::check(&state.flight.thrusters.settings, mass_kg)?;
    if is_dynamic && inputs::is_left_to_master(context, values) {
        let reported = "dump.threshold is not set: in free flight dumps come on dump.request alone";
        context.log.event(time_s, reported);
    }
    let wheels = &context.variables.wheel;
    let start = if is_dynamic {
        let held = |k: usize| wheels.get(k).map_or(0.0, |wheel| values.real(wheel.start_momentum));
        Start::Dynamic(dynamics::start_motion(context, values)?, held)
    } else {
        Start::Ideal(Vector3::from(values.vector(context.variables.start.momentum)))
    };
    let held = InputsOverTime::held();
    let log = &mut |event: &_| log_dump(context, event);
    with_given(context, values, held, |given| {
        state.flight.begin(given, start, time_s, log).map_err(failure)
    })?;
    if let Some(planets) = state.flight.ephemeris() {
        context.setup.planets_at_start.get_or_init(|| planets.clone());
    }
    if let Some(estimate) = state.flight.estimate_at(time_s) {
        state.take_first_command(context, values, estimate.attitude, time_s)?;
    }
    // Samples at the start are taken anew by the first step, with its inputs.
    let step_inputs = dynamics::step_inputs(context, values, state.command, state.inputs.take());
    let sampled = with_given(context, values, held, |given| {
        state.flight.sample_at_start(given, &step_inputs).map_err(failure)
    });
    state.inputs = Some(step_inputs);
    let undo = sampled?;
    show(context, values, state, held, time_s)?;
    state.flight.undo(undo);
    propulsion::warn_unserved(context, values, &state.flight.thrusters, &mut state.warned.thrusters, 0);
    Ok(())
}

/// One step: what changed, the flight on to the step's end, outputs.
pub fn step(
    context: &Plan<'_>,
    values: &mut Values,
    state: &mut PlantState,
    step: &Step<'_>,
) -> Result<(), Failure> {
    let mut changes = match step.changed {
        true => Some(state.inputs_changed(context, values, step.inputs, step.start_s)?),
        false => None,
    };
    if state.waiting && unset_places(context, values).is_empty() {
        state.waiting = false;
        begin(context, values, state, step.start_s)?;
        changes = None;
    }
    state.warn_unset_inputs(context, values);
    if state.waiting {
        return wait(context, values, state, step.end_s);
    }
    if !state.flight.is_configured() {
        configure(context, values, state)?;
    }
    if let Some(changes) = changes {
        apply(context, values, state, step, changes)?;
    }
    let mut inputs = match state.inputs.take() {
        Some(unchanged) if !step.changed => unchanged,
        memory => dynamics::step_inputs(context, values, state.command, memory),
    };
    propulsion::warn(context, &inputs, &state.flight.thrusters.settings, &mut state.warned.thrusters, step);
    let is_requested = state.request.rises(values.boolean(context.variables.dump.request));
    let target = || Vector3::from(values.vector(context.variables.dump.target));
    inputs.dump_to_body_n_m_s = is_requested.then(target);
    let unserved = state.flight.thrusters.unserved_dumps();
    let log = &mut |event: &_| log_dump(context, event);
    let span_s = [step.start_s, step.end_s];
    let simulated = with_given(context, values, step.inputs, |given| {
        state.flight.advance(given, &inputs, span_s, log).map_err(failure)
    });
    state.inputs = Some(inputs);
    simulated?;
    show(context, values, state, step.inputs, step.end_s)?;
    propulsion::warn_unserved(
        context,
        values,
        &state.flight.thrusters,
        &mut state.warned.thrusters,
        unserved,
    );
    Ok(())
}

/// At `time_s` the flight still waits for inputs: the attitude is held as commanded, and nothing acts.
pub fn wait(
    context: &Plan<'_>,
    values: &mut Values,
    state: &mut PlantState,
    time_s: f64,
) -> Result<(), Failure> {
    configure(context, values, state)?;
    let inputs = dynamics::step_inputs(context, values, state.command, state.inputs.take());
    state.inputs = Some(inputs);
    show(context, values, state, InputsOverTime::held(), time_s)
}

/// Tells the flight what parameters and inputs say.
fn configure(context: &Plan<'_>, values: &mut Values, state: &mut PlantState) -> Result<(), Failure> {
    let panels = Vec::with_capacity(context.variables.panel.len());
    let configuration = inputs::configuration(context, values, state, InputsOverTime::held(), panels)?;
    let settings = match dynamics::is_dynamic(context, values) && !state.waiting {
        true => ModeSettings::Dynamic(dynamics::settings(context, values, &configuration)?.into()),
        false => ModeSettings::Ideal(dynamics::ideal_settings(context, values)?),
    };
    let mut world = World::new(configuration, inputs::laws(context, values));
    if let Some(planets) = context.setup.planets_at_start.get() {
        world.ephemeris.clone_from(planets);
    }
    if !state.waiting {
        world.light = inputs::light(context, values, &world.configuration)?;
    }
    state.flight.thrusters.settings = propulsion::reaction_control(context, values)?;
    outputs::write_calculated(context, values, &world.configuration);
    outputs::write_guaranteed(context, values);
    state.flight.configure(world, settings);
    Ok(())
}

/// The flight takes what changed.
fn apply(
    context: &Plan<'_>,
    values: &mut Values,
    state: &mut PlantState,
    step: &Step<'_>,
    changes: Changes,
) -> Result<(), Failure> {
    let is_dynamic = dynamics::is_dynamic(context, values);
    let (mut configuration, mut settings) = (None, None);
    if !is_dynamic || changes.orbit || changes.light || changes.tunables {
        let panels = state.flight.take_panels();
        let reported = inputs::configuration(context, values, state, step.inputs, panels)?;
        outputs::write_calculated(context, values, &reported);
        if is_dynamic {
            settings = Some(ModeSettings::Dynamic(dynamics::settings(context, values, &reported)?.into()));
        }
        configuration = Some(reported);
    }
    state.flight.apply(changes, configuration, settings, step.start_s).map_err(failure)
}

/// Hands what a step is given to `use_it`.
fn with_given<T>(
    context: &Plan<'_>,
    values: &Values,
    over_time: InputsOverTime<'_>,
    use_it: impl FnOnce(StepContext<'_>) -> Result<T, Failure>,
) -> Result<T, Failure> {
    let variables = context.variables;
    let sunshade = values.choice(variables.sunshade.shape).0;
    use_it(StepContext {
        prepared: context.setup.prepared_spacecraft(sunshade)?,
        external: &|time_s| dynamics::external(context, values, over_time, time_s),
        planner: &|outlook: &mut DownlinkForecast<'_>| {
            inputs::manager(context, values, sunshade).choose(outlook)
        },
        work_limit: variables.solver.work.units(values),
    })
}

/// Writes every output at `time_s`.
fn show(
    context: &Plan<'_>,
    values: &mut Values,
    state: &mut PlantState,
    over_time: InputsOverTime<'_>,
    time_s: f64,
) -> Result<(), Failure> {
    let PlantState { flight, command, waiting, inputs: Some(inputs), .. } = state else { return Ok(()) };
    let held = (*command, Vector3::from(values.vector(context.variables.start.momentum)));
    let report: Report<'_> = with_given(context, values, over_time, |given| {
        flight.report(given, inputs, held, time_s).map_err(failure)
    })?;
    if !*waiting {
        outputs::flyable(&report)?;
    }
    outputs::write(context, values, &report);
    outputs::write_plates(context, values, flight, time_s)
}

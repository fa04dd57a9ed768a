//! `MomentumPlant`: a three-axis spacecraft about a planet or the Sun, its disturbance torques by source and the
//! momentum they add up to.

mod dependencies;
mod inputs;
mod outputs;
mod setup;
mod variables;

use fmi_export::{
    About, Dependencies, Extensions, Failure, Manual, Model, OutputRates, Real, SetupError, Source,
    StartValue, Step, StepEnd, Values,
};
use nalgebra::Vector3;
use physics::momentum::{DumpEvent, DumpSpacing, MomentumIntegrator, Totals};
use physics::plant::{
    Configuration, Evaluation, ExternalLoad, Flight, IdealFlight, PropagatorState, ReactionControlSettings,
    SunPlanner,
};

use crate::common::ephemeris::{self, EPHEMERIS_FILE};
use inputs::dynamics;
use inputs::state::{Changes, PlantState, unset_places};
use outputs::{dynamic, flyable, log_dump};
use setup::Plan;
pub use setup::{MomentumPlant, PlantSetup};
use variables::PlantVariables;

impl Model for MomentumPlant {
    const NAME: &'static str = "MomentumPlant";
    const STATE_VERSION: u32 = 10;
    const SETUP_FILE: Option<&'static str> = Some("spacecraft.toml");
    const SCHEDULE_FILES: &'static [&'static str] = &[EPHEMERIS_FILE];
    const DEFAULT_SETUP: &'static str = include_str!("../../../resources/messenger.toml");
    const REFERENCE_INPUTS: &'static str = include_str!("../../../resources/reference/MomentumPlant.csv");
    const MANUAL: Manual = crate::manuals::MOMENTUM_PLANT;
    const SOURCES: &'static [Source] = crate::sources::MOMENTUM_PLANT;
    const EXTENSIONS: Extensions<Self> = Extensions::none().output_rates();

    type Setup = PlantSetup;
    type Variables = PlantVariables;
    type State = PlantState;

    fn parse_setup(file: &str, text: &str) -> Result<PlantSetup, SetupError> {
        PlantSetup::from_toml(file, text)
    }

    fn parse_schedule(
        setup: &mut PlantSetup,
        _schedule: &str,
        file: &str,
        text: &str,
    ) -> Result<(), SetupError> {
        setup.ephemeris = Some(ephemeris::read(file, text)?);
        Ok(())
    }

    fn start_values(setup: &PlantSetup) -> Vec<StartValue> {
        crate::common::start_values::start_values(&setup.spacecraft.start)
    }

    fn about(setup: &PlantSetup) -> About {
        // 90 days of the momentum; dynamics are computed at 50 Hz.
        let (stop_time_s, step_size_s) =
            if setup.starts_with_dynamics() { (86_400.0, 1.0) } else { (7_776_000.0, 600.0) };
        About {
            description: format!(
                "{}: solar-radiation torque, planet light, thermal recoil, gravity gradient, system momentum and thruster \
                 dumps of a three-axis spacecraft about a planet or the Sun",
                setup.spacecraft.name
            ),
            start_time_s: 0.0,
            stop_time_s,
            step_size_s,
            tolerance: 1e-10,
            ..crate::common::about()
        }
    }

    fn dependencies(setup: &PlantSetup, variables: &PlantVariables) -> Dependencies {
        dependencies::table(setup, variables)
    }

    fn initialize(context: &Plan<'_>, values: &mut Values, start_s: f64) -> Result<PlantState, Failure> {
        inputs::check_effects(context, values)?;
        let mut state = PlantState::new(context, values, start_s)?;
        if state.waiting {
            wait(context, values, &mut state, start_s)?;
        } else {
            begin(context, values, &mut state, start_s)?;
        }
        Ok(state)
    }

    fn step(
        context: &Plan<'_>,
        values: &mut Values,
        state: &mut PlantState,
        step: &Step<'_>,
    ) -> Result<StepEnd, Failure> {
        inputs::check_span(context, values, state, step.end_s)?;
        let mut changed = step.changed;
        let changes = if changed {
            state.inputs_changed(context, values, step.inputs, step.start_s)?
        } else {
            Changes::default()
        };
        if state.waiting && unset_places(context, values).is_empty() {
            state.waiting = false;
            begin(context, values, state, step.start_s)?;
            changed = false;
        }
        state.say_unset(context, values);
        if state.waiting {
            wait(context, values, state, step.end_s)?;
            return Ok(StepEnd::at(step.end_s));
        }
        if dynamics::is_dynamic(context, values) {
            dynamic::step(context, values, state, step, changed.then_some(changes))?;
            return Ok(StepEnd::at(step.end_s));
        }
        if changed {
            state.integrator.cut(step.start_s);
        }
        let mut configuration = match state.configuration.take() {
            Some(configuration) if !changed => configuration,
            previous => {
                let configuration = inputs::refreshed(context, values, state, previous)?;
                outputs::write_calculated(context, values, state, &configuration);
                configuration
            }
        };
        if changed {
            inputs::move_panels(context, values, step.inputs, &mut configuration);
            state.propagator.cut(&configuration, step.start_s, changes.light);
            if changes.orbit && inputs::is_given(context.variables, values) {
                state.propagator.move_to(&configuration, step.start_s).map_err(outputs::failure)?;
            }
        }
        let load = |time_s| ExternalLoad {
            force_body_n: Vector3::from(step.inputs.vector(values, context.variables.force.applied, time_s)),
            torque_body_n_m: Vector3::from(step.inputs.vector(
                values,
                context.variables.torque.applied,
                time_s,
            )),
        };
        if state.light.is_none() {
            state.light = inputs::light(context, values, &configuration)?;
        }
        let thrusters = take_thrusters(context, values, state)?;
        let rises = state.request.rises(values.boolean(context.variables.dump.request));
        let manager = inputs::manager(context, values, &configuration);
        let acting = Acting { load: &load, planner: &manager };
        let unserved = state.dump_side_effect.unserved;
        let (mut flown, spacing) = ideal(context, values, state, &mut configuration, &thrusters, acting)?;
        if rises {
            let target = Vector3::from(values.vector(context.variables.dump.target));
            note_dump(context, spacing, &flown.dump_to(step.start_s, target));
        }
        flown.advance(step.end_s, |event| note_dump(context, spacing, event)).map_err(outputs::failure)?;
        let evaluation = flown.evaluate(step.end_s);
        state.thrusters = Some(thrusters);
        flyable(&evaluation, &state.integrator.totals(step.end_s), step.end_s)?;
        outputs::write_plates(context, values, state, &configuration, step.end_s)?;
        let totals = state.integrator.totals(step.end_s);
        outputs::write(context, values, state, &configuration, &evaluation, &totals, step.end_s);
        outputs::write_ideal(context, values, state, &evaluation, &totals, step.end_s)?;
        say_unserved(context, values, state, unserved);
        state.configuration = Some(configuration);
        Ok(StepEnd::at(step.end_s))
    }

    fn settle_parameters(context: &Plan<'_>, values: &mut Values) {
        inputs::settle(context, values);
    }

    fn tolerance(variables: &PlantVariables) -> Option<Real> {
        Some(variables.solver.tolerance)
    }

    fn check_state(setup: &PlantSetup, state: &PlantState) -> Result<(), Failure> {
        state.check(&setup.spacecraft)
    }

    fn check_time(state: &PlantState, time_s: f64) -> Result<(), Failure> {
        if !state.propagator.light.as_ref().is_none_or(|light| light.covers(time_s)) {
            return Err(Failure::new(format!("light and heat were computed elsewhere than at {time_s:?} s")));
        }
        if !state.propagator.trajectory.covers(time_s) {
            return Err(Failure::new(format!("the orbit was integrated elsewhere than at {time_s:?} s")));
        }
        if state.dynamics.as_ref().is_some_and(|dynamics| !dynamics.covers(time_s)) {
            return Err(Failure::new(format!("the attitude was computed elsewhere than at {time_s:?} s")));
        }
        if state.dynamics.is_some() || state.integrator.covers(time_s) {
            return Ok(());
        }
        Err(Failure::new(format!("the momentum was accumulated elsewhere than at {time_s:?} s")))
    }
}

impl OutputRates for MomentumPlant {
    fn output_rate(context: &Plan<'_>, values: &Values, state: &PlantState, output: Real) -> Option<f64> {
        outputs::derivative(context, values, state, output)
    }
}

/// The flight begins at `time_s`: everything it needs is known.
fn begin(
    context: &Plan<'_>,
    values: &mut Values,
    state: &mut PlantState,
    time_s: f64,
) -> Result<(), Failure> {
    if dynamics::is_dynamic(context, values) {
        return dynamic::begin(context, values, state, time_s);
    }
    let mut configuration = inputs::configuration(context, values, state)?;
    let load = applied(context, values);
    state.propagator = PropagatorState::new(&configuration, time_s).map_err(outputs::failure)?;
    state.light = inputs::light(context, values, &configuration)?;
    let thrusters = take_thrusters(context, values, state)?;
    inputs::propulsion::check(&thrusters, &configuration)?;
    let load = |_: f64| load;
    let manager = inputs::manager(context, values, &configuration);
    let acting = Acting { load: &load, planner: &manager };
    let (mut flown, spacing) = ideal(context, values, state, &mut configuration, &thrusters, acting)?;
    let momentum = Vector3::from(values.vector(context.variables.start.momentum));
    let begun = flown.begin(time_s, momentum).map_err(outputs::failure)?;
    *flown.integrator = MomentumIntegrator::new(time_s, start_totals(context, values, &begun));
    flown.advance(time_s, |event| note_dump(context, spacing, event)).map_err(outputs::failure)?;
    let evaluation = flown.evaluate(time_s);
    state.thrusters = Some(thrusters);
    flyable(&evaluation, &state.integrator.totals(time_s), time_s)?;
    outputs::write_plates(context, values, state, &configuration, time_s)?;
    let totals = state.integrator.totals(time_s);
    outputs::write_calculated(context, values, state, &configuration);
    outputs::write(context, values, state, &configuration, &evaluation, &totals, time_s);
    outputs::write_ideal(context, values, state, &evaluation, &totals, time_s)?;
    say_unserved(context, values, state, 0);
    state.configuration = Some(configuration);
    Ok(())
}

/// Says once that a dump found no thrusters, as many as `before` having done so already.
fn say_unserved(context: &Plan<'_>, values: &Values, state: &mut PlantState, before: u32) {
    let unserved = [before, state.dump_side_effect.unserved];
    if let Some(thrusters) = &state.thrusters {
        inputs::propulsion::warn_unserved(context, values, thrusters, &mut state.said_of_thrusters, unserved);
    }
}

/// Thrusters and tanks, worked out once.
fn take_thrusters(
    context: &Plan<'_>,
    values: &Values,
    state: &mut PlantState,
) -> Result<ReactionControlSettings, Failure> {
    match state.thrusters.take() {
        Some(known) => Ok(known),
        None => inputs::propulsion::reaction_control(context, values),
    }
}

/// What acts from outside, and who chooses the Sun's place during downlinks.
#[derive(Clone, Copy)]
struct Acting<'f> {
    load: &'f dyn Fn(f64) -> ExternalLoad,
    planner: &'f dyn SunPlanner,
}

/// The flight in an attitude that is followed ideally, and the time between its dumps.
fn ideal<'f>(
    context: &'f Plan<'_>,
    values: &Values,
    state: &'f mut PlantState,
    configuration: &'f mut Configuration,
    thrusters: &'f ReactionControlSettings,
    acting: Acting<'f>,
) -> Result<(IdealFlight<'f, 'f>, &'f mut DumpSpacing), Failure> {
    let flown = IdealFlight {
        flight: Flight {
            prepared: context.setup.prepared_spacecraft(configuration.sunshade)?,
            configuration,
            propagator: &mut state.propagator,
            ephemeris: &mut state.ephemeris,
            light: state.light.as_mut(),
            propellant: &mut state.propellant,
            external: acting.load,
            planner: acting.planner,
        },
        integrator: &mut state.integrator,
        thrusters,
        side_effect: &mut state.dump_side_effect,
        work_limit: context.variables.solver.work.units(values),
    };
    Ok((flown, &mut state.spacing))
}

/// At `time_s` the flight still waits for inputs: the attitude is held as commanded, and nothing acts.
fn wait(context: &Plan<'_>, values: &mut Values, state: &mut PlantState, time_s: f64) -> Result<(), Failure> {
    let configuration = inputs::configuration(context, values, state)?;
    let evaluation = Evaluation::nowhere(state.command.frame_at(time_s), configuration.mass_at_zero());
    let totals = start_totals(context, values, &evaluation);
    state.integrator = MomentumIntegrator::new(time_s, totals);
    outputs::write_plates(context, values, state, &configuration, time_s)?;
    outputs::write_calculated(context, values, state, &configuration);
    outputs::write(context, values, state, &configuration, &evaluation, &totals, time_s);
    outputs::write_ideal(context, values, state, &evaluation, &totals, time_s)?;
    Ok(())
}

/// What the flight starts with: start.momentum in the body frame.
fn start_totals(context: &Plan<'_>, values: &Values, evaluation: &Evaluation) -> Totals {
    let momentum_body_n_m_s = Vector3::from(values.vector(context.variables.start.momentum));
    Totals::at_start(momentum_body_n_m_s, &evaluation.instant.frame.inertial_from_body)
}

fn applied(context: &Plan<'_>, values: &Values) -> ExternalLoad {
    ExternalLoad {
        force_body_n: Vector3::from(values.vector(context.variables.force.applied)),
        torque_body_n_m: Vector3::from(values.vector(context.variables.torque.applied)),
    }
}

/// Counts a dump and reports it.
fn note_dump(context: &Plan<'_>, spacing: &mut DumpSpacing, event: &DumpEvent) {
    spacing.dumped(event);
    log_dump(context, event);
}

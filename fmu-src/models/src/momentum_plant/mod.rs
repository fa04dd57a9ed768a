//! `MomentumPlant`: a three-axis spacecraft near Mercury or the Sun, its disturbance torques by source and the
//! momentum they add up to.

pub(crate) mod choices;
mod configure;
pub(crate) mod defaults;
mod outputs;
mod setup;
mod state;
mod variables;

use fmi_export::{About, Context, Failure, Model, Real, SetupError, Source, Step, Values};
use physics::constants::RADIUS_SUN_M;
use physics::momentum::{Accumulator, Event, Flight, Totals};
use physics::plant::{Course, ExternalLoad, Plant, PlantError, Snapshot};

use choices::OrbitSource;
pub use setup::PlantSetup;
use state::{Changes, PlantState};
use variables::PlantVariables;

/// The momentum plant.
pub struct MomentumPlant;

type Plan<'a> = Context<'a, MomentumPlant>;

impl Model for MomentumPlant {
    const NAME: &'static str = "MomentumPlant";
    const STATE_VERSION: u32 = 3;
    const SETUP_FILE: Option<&'static str> = Some("spacecraft.toml");
    const DEFAULT_SETUP: &'static str = include_str!("../../../resources/messenger.toml");
    const SOURCES: &'static [Source] = crate::sources::MOMENTUM_PLANT;
    const MAX_OUTPUT_DERIVATIVE_ORDER: u32 = 1;

    type Setup = PlantSetup;
    type Variables = PlantVariables;
    type State = PlantState;

    fn parse_setup(file: &str, text: &str) -> Result<PlantSetup, SetupError> {
        PlantSetup::from_toml(file, text)
    }

    fn about(setup: &PlantSetup) -> About {
        About {
            description: format!(
                "{}: solar-radiation torque, planet light, thermal recoil, gravity gradient, system momentum and thruster \
                 dumps of a three-axis spacecraft near Mercury or the Sun",
                setup.spacecraft.name
            ),
            start_time_s: 0.0,
            stop_time_s: 90.0 * 86_400.0,
            step_size_s: 600.0,
            tolerance: 1e-10,
            ..crate::about()
        }
    }

    fn initialize(context: &Plan<'_>, values: &mut Values, start_s: f64) -> Result<PlantState, Failure> {
        let mut state = PlantState::new(context, values, start_s)?;
        let configuration = configure::configuration(context, values, &state)?;
        let load = external(context, values);
        let craft = context.setup.craft(configuration.sunshade)?;
        state.course = Course::new(&configuration, start_s).map_err(ended)?;
        state.light = configure::light(context, values, &configuration)?;
        let (course, ephemeris) = (&mut state.course, &mut state.ephemeris);
        let mut plant = Plant::new(craft, &configuration, course, ephemeris, state.light.as_mut(), |_| load);
        plant.prepare(start_s).map_err(ended)?;
        let totals = Totals {
            momentum_inertial_n_m_s: plant.snapshot(start_s).frame.inertial_from_body
                * physics_vector(values.vector(context.variables.initial.momentum)),
            torque_integral_body_n_m_s: physics_vector(values.vector(context.variables.initial.momentum)),
            ..Totals::default()
        };
        state.accumulator = Accumulator::new(start_s, totals);
        let (accumulator, spacing) = (&mut state.accumulator, &mut state.spacing);
        accumulator
            .advance(&mut plant, &configuration.momentum, start_s, |event| spacing.dumped(context, event))
            .map_err(ended)?;
        let snapshot = plant.snapshot(start_s);
        flyable(&snapshot, start_s)?;
        outputs::write_plates(context, values, &mut state, &configuration, start_s)?;
        let totals = state.accumulator.totals(start_s);
        outputs::write_calculated(context, values, &configuration);
        outputs::write(context, values, &state, &configuration, &snapshot, &totals, start_s);
        state.configuration = Some(configuration);
        Ok(state)
    }

    fn step(
        context: &Plan<'_>,
        values: &mut Values,
        state: &mut PlantState,
        step: &Step<'_>,
    ) -> Result<(), Failure> {
        let mut changes = Changes::default();
        if step.changed {
            changes = state.inputs_changed(context, values, step.start_s)?;
            state.accumulator.cut(step.start_s);
        }
        let configuration = match state.configuration.take() {
            Some(configuration) if !step.changed => configuration,
            previous => {
                let configuration = configure::refreshed(context, values, state, previous)?;
                outputs::write_calculated(context, values, &configuration);
                configuration
            }
        };
        if step.changed {
            state.course.cut(&configuration, step.start_s, changes.light);
        }
        if changes.orbit && matches!(values.choice(context.variables.orbit.source), Some(OrbitSource::Inputs))
        {
            state.course.move_to(&configuration, step.start_s).map_err(ended)?;
        }
        let load = |time_s| ExternalLoad {
            force_body_n: physics_vector(step.input_vector(values, context.variables.force.external, time_s)),
            torque_body_n_m: physics_vector(step.input_vector(
                values,
                context.variables.torque.external,
                time_s,
            )),
        };
        let craft = context.setup.craft(configuration.sunshade)?;
        if state.light.is_none() {
            state.light = configure::light(context, values, &configuration)?;
        }
        let (course, ephemeris) = (&mut state.course, &mut state.ephemeris);
        let mut plant = Plant::new(craft, &configuration, course, ephemeris, state.light.as_mut(), load);
        let (accumulator, spacing) = (&mut state.accumulator, &mut state.spacing);
        if state.request.rises(values.boolean(context.variables.dump.request)) {
            let target = physics_vector(values.vector(context.variables.dump.target));
            let event = accumulator.dump_to(&mut plant, &configuration.momentum, step.start_s, target);
            spacing.dumped(context, &event);
        }
        accumulator
            .advance(&mut plant, &configuration.momentum, step.end_s, |event| spacing.dumped(context, event))
            .map_err(ended)?;
        let snapshot = plant.snapshot(step.end_s);
        flyable(&snapshot, step.end_s)?;
        outputs::write_plates(context, values, state, &configuration, step.end_s)?;
        let totals = state.accumulator.totals(step.end_s);
        outputs::write(context, values, state, &configuration, &snapshot, &totals, step.end_s);
        state.configuration = Some(configuration);
        Ok(())
    }

    fn check_time(state: &PlantState, time_s: f64) -> Result<(), Failure> {
        if !state.course.light.as_ref().is_none_or(|light| light.covers(time_s)) {
            return Err(Failure::new(format!("light and heat were computed elsewhere than at {time_s:?} s")));
        }
        if !state.course.trajectory.covers(time_s) {
            return Err(Failure::new(format!("the orbit was integrated elsewhere than at {time_s:?} s")));
        }
        if state.accumulator.covers(time_s) {
            return Ok(());
        }
        Err(Failure::new(format!("the momentum was accumulated elsewhere than at {time_s:?} s")))
    }

    fn output_derivative(
        context: &Plan<'_>,
        values: &Values,
        state: &PlantState,
        output: Real,
    ) -> Option<f64> {
        outputs::derivative(context, values, state, output)
    }
}

fn ended(error: PlantError) -> Failure {
    let hint = match error {
        PlantError::Light { .. } => "; see orbit.*, sun.position and planet.radius",
        PlantError::Dumps(_) => "; see dump.threshold, dump.reinit and torque.external",
        _ => "",
    };
    Failure::new(format!("{error}{hint}"))
}

/// Refuses a place where there is no flight: inside the planet or the Sun, or nowhere.
fn flyable(snapshot: &Snapshot, time_s: f64) -> Result<(), Failure> {
    let numbers = snapshot.torque_body_n_m() + snapshot.force_body_n();
    let outside_the_sun = snapshot.geometry.to_sun.position_m.norm() > RADIUS_SUN_M;
    if outside_the_sun && snapshot.lit_fraction.is_finite() && numbers.iter().all(|x| x.is_finite()) {
        return Ok(());
    }
    let spacecraft = snapshot.geometry.spacecraft.position_m;
    Err(Failure::new(format!(
        "at {time_s} s the spacecraft at {:?} m about the orbit's centre is inside the planet or the Sun, or its position \
         is no number; see orbit.*, sun.position and planet.radius",
        spacecraft.as_slice()
    )))
}

fn external(context: &Plan<'_>, values: &Values) -> ExternalLoad {
    ExternalLoad {
        force_body_n: physics_vector(values.vector(context.variables.force.external)),
        torque_body_n_m: physics_vector(values.vector(context.variables.torque.external)),
    }
}

fn physics_vector(value: [f64; 3]) -> nalgebra::Vector3<f64> {
    value.into()
}

fn log_dump(context: &Plan<'_>, event: &Event) {
    if context.log.events_enabled() {
        let message = format!(
            "thruster dump: momentum {:?} -> {:?} N.m.s (body)",
            event.before_body_n_m_s.as_slice(),
            event.after_body_n_m_s.as_slice()
        );
        context.log.event(event.time_s, &message);
    }
}

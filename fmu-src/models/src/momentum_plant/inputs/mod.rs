//! One reading of parameters and inputs into settings of the physics; refuses by name.

mod air_and_field;
mod center;
mod configuration;
mod dynamics;
mod ephemeris_source;
pub(super) mod guidance;
mod n_body;
mod orbit;
mod panels;
pub(super) mod plausibility;
pub(super) mod propulsion;
mod solvers;
pub(super) mod wheels;

use fmi_export::{Failure, InputsOverTime, Step, Values};
use physics::environment::ephemeris::Ephemeris;
use physics::environment::time;
use physics::management::Manager;
use physics::plant::{
    Configuration, DownlinkForecast, DynamicsInputs, ModeSettings, PreparedSpacecraft, SimulationContext,
    Sources, StepContext, ThrusterAllocator, ThrusterEvent, Thrusters,
};

use self::center::Center;
use self::panels::MovingPanels;
use super::setup::{Plan, Read};
use super::state::PlantState;
use super::state::step_inputs::{AppliedLoad, StepInputs};
use super::variables::choices::EphemerisSource;
use crate::common::effects::unused_map;
use crate::common::ephemeris::{self, NamedEpoch};
use crate::common::management::ManagedSpacecraft;
use crate::common::spacecraft::start_attitude;

/// Parameters and inputs of one step that [`PlantState::inputs`] do not hold.
pub(super) struct Reading<'a> {
    /// Whether something was set since the last step.
    pub is_set: bool,
    /// Whether the flight begins, with all inputs that it needs set.
    pub begins: bool,
    /// Whether the configuration changed since the last step, or was never read.
    pub is_reconfigured: bool,
    /// Whether fixed parameters are read too: the simulation begins, was restored or waits for inputs.
    is_complete: bool,
    applied: AppliedLoad<'a>,
    manager: Manager<'a>,
    prepared: PreparedSpacecraft<'a>,
    work_limit: u32,
}

/// A configuration that was read anew, with its settings.
#[expect(clippy::large_enum_variant, reason = "a step allocates nothing")]
pub(super) enum Reconfigured {
    /// Simulation made anew, by fixed parameters too.
    Simulation(Box<SimulationContext>, ModeSettings),
    /// The part that depends on inputs and tunable parameters, with settings where they do.
    Changed(Configuration, Option<ModeSettings>),
}

impl Reading<'_> {
    /// Acts with the context of a step of the flight with these inputs, whose dumps and maneuvers go to `log`.
    pub(super) fn with<T>(
        &self,
        inputs: &DynamicsInputs,
        log: &dyn Fn(&ThrusterEvent),
        act: impl FnOnce(StepContext<'_>) -> T,
    ) -> T {
        let Self { prepared, work_limit, .. } = *self;
        let external = |time_s| self.applied.at(time_s);
        let planner = |forecast: &mut DownlinkForecast<'_, '_>| self.manager.choose(forecast);
        act(StepContext { prepared, external: &external, inputs, planner: &planner, work_limit, log })
    }
}

/// Reads the parameters and inputs of a step; `state` stores those that changed.
pub(super) fn read<'a>(
    context: &Plan<'a>,
    values: &Values,
    state: &mut PlantState,
    step: &Step<'a>,
) -> Result<Reading<'a>, Failure> {
    let (read, variables) = (Read::new(context, values), context.variables);
    let (mut is_set, mut is_changed) = (step.changed, false);
    if step.changed || !state.inputs.are_read {
        state.inputs.update(context, values, step.inputs);
        is_changed = state.update_inputs(step.start_s)?;
        is_set |= state.update_schedules(read.setup.schedules, step.start_s);
    }
    let begins = state.saved.waiting && state.inputs.unset_places.is_empty();
    state.saved.waiting &= !begins;
    let sunshade = read.choice(variables.sunshade.shape).0;
    let limits_rad = [variables.keep_in.azimuth, variables.keep_in.elevation].map(|limit| read.real(limit));
    let (momentum, spacecraft) = (&variables.momentum, &context.setup.spacecraft);
    let strategy = read.choice(momentum.strategy).0;
    let is_dynamic = state.inputs.source.is_dynamic && !state.saved.waiting;
    let is_complete =
        begins || state.saved.flight.configuration().is_none() || (state.saved.waiting && is_set);
    let is_reconfigured = is_complete || (is_set && (!is_dynamic || is_changed));
    let current = state.saved.flight.configuration().filter(|_| !is_reconfigured);
    let bias_body_n_m_s = current.map(|it| it.momentum.policy.bias_body_n_m_s);
    Ok(Reading {
        is_set,
        begins,
        is_reconfigured,
        is_complete,
        applied: AppliedLoad {
            inputs: [variables.force.applied, variables.torque.applied],
            held: state.inputs.applied,
            over_time: step.inputs,
        },
        manager: momentum.targeting.manager(
            values,
            strategy,
            ManagedSpacecraft {
                spacecraft,
                sunshade,
                antennas: &context.setup.antennas.all,
                sun_limits_rad: limits_rad,
                bias_body_n_m_s: bias_body_n_m_s.unwrap_or_else(|| wheels::bias_body_n_m_s(read)),
            },
        ),
        prepared: context.setup.prepared_spacecraft(sunshade)?,
        work_limit: variables.solver.work.units(read.values),
    })
}

/// The configuration by inputs and tunable parameters, and by fixed ones where [`Reading::is_complete`].
pub(super) fn configured(
    read: Read<'_>,
    state: &mut PlantState,
    over_time: InputsOverTime<'_>,
    reading: &Reading<'_>,
) -> Result<Reconfigured, Failure> {
    let is_dynamic = state.inputs.source.is_dynamic && !state.saved.waiting;
    let center = Center::read(read);
    let moving = MovingPanels { over_time, memory: state.saved.flight.extract_panels() };
    let configuration = configuration::read(read, state, &center, moving)?;
    let settings = if is_dynamic {
        let start = guidance::start_motion(read, &configuration, state)?;
        let settings = dynamics::dynamic(read, &configuration, start)?;
        Some(ModeSettings::Dynamic(settings.into()))
    } else {
        None
    };
    if !reading.is_complete {
        return Ok(Reconfigured::Changed(configuration, settings));
    }
    let settings = match settings {
        Some(settings) => settings,
        None => ModeSettings::Ideal(dynamics::ideal(read)?),
    };
    let acting = Some(&configuration).filter(|_| !state.saved.waiting);
    let air = acting.map(|it| solvers::air(read, it)).transpose()?.flatten();
    let light = acting.map(|it| solvers::light(read, it, &center.surface)).transpose()?.flatten();
    let mut simulation = SimulationContext::new(configuration);
    simulation.models.ephemeris = Ephemeris::with_cache(&read.setup.ephemeris_cache);
    simulation.models.solar = Some(reading.prepared.solar.clone());
    simulation.models.sources = Sources::new(light, air);
    simulation.allocator = ThrusterAllocator::new(propulsion::reaction_control(read)?);
    Ok(Reconfigured::Simulation(Box::new(simulation), settings))
}

/// Sets the materials of the surfaces where they are other than the flight has them.
///
/// # Errors
/// Names parameters whose values no material has.
pub(super) fn update_materials(read: Read<'_>, state: &mut PlantState) -> Result<(), Failure> {
    let Some(flown) = state.saved.flight.context_mut() else { return Ok(()) };
    for found in read.variables.optics.materials(read, &read.setup.optics) {
        let (place, material) = found?;
        flown.models.set_material(place, &material);
    }
    Ok(())
}

/// Reads the state in which a flight begins.
pub(super) fn start(read: Read<'_>, start_s: f64) -> Result<PlantState, Failure> {
    let mut inputs = StepInputs::default();
    inputs.update(&read, read.values, InputsOverTime::held());
    let attitude = start_attitude(read.values, read.variables.start.q)?;
    let settings = propulsion::reaction_control(read)?;
    let thrusters = Thrusters::new(settings.thrusters.len(), settings.tanks.len(), start_s);
    PlantState::new(inputs, attitude, thrusters, start_s, read.setup.schedules)
}

/// Warns of settings, and keys of the file, that are without effect.
///
/// # Errors
/// A setting that cannot have an effect.
pub(super) fn check_effects(read: Read<'_>, start_s: f64) -> Result<(), Failure> {
    let (variables, spacecraft) = (read.variables, &read.setup.spacecraft);
    let shape = read.choice(variables.sunshade.shape).0;
    let shadows = variables.shadowing.check(read.values, spacecraft, shape)?;
    let encounter = n_body::unused_encounter(read);
    let prediction = n_body::unused_prediction(read);
    for warning in [shadows, unused_map(spacecraft), encounter, prediction].into_iter().flatten() {
        read.log.warning(&warning);
    }
    center::warn_defaulted(read);
    air_and_field::report(read, start_s);
    Ok(())
}

/// Writes the parameters that follow `orbit.center` as they act.
pub(super) fn resolve_start(context: &Plan<'_>, values: &mut Values) {
    let ellipse = &context.variables.ephemeris;
    let read = Read::new(context, values);
    let center = Center::read(read);
    let elements = ellipse.read(read, &context.setup.bodies.body(center.data.body));
    ellipse.write(values, &elements);
    center.write(context.variables, values);
    let defaults = air_and_field::BodyDefaults::read(Read::new(context, values), center.planet.body);
    defaults.write(context.variables, values);
    wheels::write_start(context, values);
    let is_about_sun = !center.data.body.is_planet();
    context.variables.guided.resolve_start(context, values, &context.setup.guided, is_about_sun);
}

/// Refuses a step that leaves the span of the onboard ephemerides in use.
pub(super) fn check_span(read: Read<'_>, state: &PlantState, end_s: f64) -> Result<(), Failure> {
    let variables = read.variables;
    let is_onboard = matches!(read.choice(variables.ephemeris_source), EphemerisSource::Chebyshev);
    let Some(carried) = ephemeris::precise(read.setup.ephemeris.as_ref()).filter(|_| is_onboard) else {
        return Ok(());
    };
    let epoch_minus_time_s = time::epoch_minus_time_s(read.real(variables.start.epoch), state.saved.start_s);
    let end_epoch_s = time::epoch_at_s(end_s, epoch_minus_time_s);
    let name = "the epoch at the end of the step";
    n_body::check_onboard(read, carried, NamedEpoch { name, epoch_s: end_epoch_s })
}

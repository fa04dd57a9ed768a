//! Controlled and free flight: the attitude follows from torque, wheels and controller.

use fmi_export::{Failure, InputsOverTime, Step, Values};
use nalgebra::Vector3;
use physics::attitude::Attitude;
use physics::guidance::modes::system::CommandKind as Kind;
use physics::momentum::{Convention, DumpEvent, Totals};
use physics::plant::{
    AttitudeDynamics, Configuration, DynamicsInputs, DynamicsSettings, ExternalLoad, Flight, Motion,
    PropagatorState, SunPlanner, Tracked,
};

use super::super::inputs::state::{Changes, PlantState};
use super::super::inputs::{self, dynamics, propulsion};
use super::super::setup::Plan;
use super::propulsion::write_thrusters;
use super::write::{self as outputs, flyable, log_dump};
use crate::common::choices::CommandKind;

/// What one stretch of flight needs besides the state.
struct Stretch<'a> {
    context: &'a Plan<'a>,
    values: &'a Values,
    over_time: InputsOverTime<'a>,
    tracked: Tracked,
}

impl Stretch<'_> {
    /// Hands the inputs of the stretch to `use_them`.
    fn with_inputs<T>(&self, use_them: impl FnOnce(&DynamicsInputs<'_>) -> T) -> T {
        let (context, values) = (self.context, self.values);
        let (wheels, sensors) = (&context.variables.wheel, &context.variables.sun_sensor);
        use_them(&DynamicsInputs {
            tracked: self.tracked,
            wheel_torque_n_m: &|k| wheels.get(k).map_or(0.0, |wheel| values.real(wheel.torque_command)),
            wheel_failed: &|k| wheels.get(k).is_some_and(|wheel| values.boolean(wheel.failed)),
            sun_sensor_failed: &|k| sensors.get(k).is_some_and(|sensor| values.boolean(sensor.failed)),
            pulse: &|k| propulsion::pulse(context, values, k),
            thrust: propulsion::thrust_command(context, values),
            health: dynamics::health(context, values),
            external: &|time_s| dynamics::external(context, values, self.over_time, time_s),
        })
    }
}

/// What the controller tracks.
fn tracked(context: &Plan<'_>, values: &Values, state: &PlantState) -> Tracked {
    if dynamics::guides_itself(context, values) {
        return Tracked::Guidance;
    }
    match values.choice(context.variables.command.kind) {
        CommandKind(Kind::RateOnly) => Tracked::Rate(state.command.rate_body_rad_s),
        _ => Tracked::Attitude(state.command),
    }
}

/// The flight begins at `time_s`.
pub fn begin(
    context: &Plan<'_>,
    values: &mut Values,
    state: &mut PlantState,
    time_s: f64,
) -> Result<(), Failure> {
    let mut configuration = inputs::configuration(context, values, state)?;
    let mut settings = dynamics::settings(context, values, &configuration)?;
    propulsion::check(&settings.thrusters, &configuration)?;
    if inputs::is_left_to_master(context, values) {
        context
            .log
            .event(time_s, "dump.threshold is not set: in free flight dumps come on dump.request alone");
    }
    state.propagator = PropagatorState::new(&configuration, time_s).map_err(outputs::failure)?;
    state.light = inputs::light(context, values, &configuration)?;
    let start = dynamics::start_motion(context, values)?;
    let (mut attitude, mut rate_body_rad_s) = (start.attitude, start.rate_body_rad_s);
    let [start_load, _] = dynamics::external(context, values, InputsOverTime::held(), time_s);
    let acting = |_: f64| start_load;
    let manager = inputs::manager(context, values, &configuration);
    if start.attitude_is_guided {
        let guided = flight(context, state, &mut configuration, &acting, &manager)?
            .guided_start(time_s, settings.work_limit)
            .map_err(outputs::failure)?;
        if let Some(frame) = guided {
            attitude = Attitude::from_rotation(&frame.inertial_from_body);
            if start.rate_is_guided {
                rate_body_rad_s = frame.rate_body_rad_s;
            }
        }
    }
    let mut mass = configuration.loaded();
    if settings.panels_have_mass {
        mass = flight(context, state, &mut configuration, &acting, &manager)?.mass_at_start(time_s, attitude);
        settings.gyrostat.set_mass_properties(mass.inertia_body_kg_m2, mass.center_of_mass_body_m);
    }
    let wheels = &context.variables.wheel;
    let held = |k: usize| wheels.get(k).map_or(0.0, |wheel| values.real(wheel.start_momentum));
    let mut begun = AttitudeDynamics::new(&settings, mass, time_s, attitude, rate_body_rad_s, held);
    if settings.panels_have_mass {
        let mut flight = flight(context, state, &mut configuration, &acting, &manager)?;
        let panels = flight.panels_at_start(time_s, attitude, rate_body_rad_s);
        begun = begun.with_panels(&flight.prepared, panels);
    }
    state.dynamics = Some(Box::new(begun));
    state.take_first_command(context, values, attitude, time_s)?;
    outputs::write_calculated(context, values, state, &configuration);
    // The sample at the start is taken anew by the first step, with its inputs.
    let begun = state.dynamics.clone();
    let propellant = state.propellant.clone();
    let over_time = InputsOverTime::held();
    let stretch = Stretch { context, values, over_time, tracked: tracked(context, values, state) };
    let limit = settings.work_limit;
    if let Some(mut shown) = state.dynamics.take() {
        let mut flight = flight(context, state, &mut configuration, &acting, &manager)?;
        let mut work = flight.begin_work(limit);
        stretch
            .with_inputs(|inputs| {
                let silent = &mut |_: &DumpEvent| {};
                shown.take_due(&mut settings, &mut flight, inputs, &mut work, silent)
            })
            .map_err(outputs::failure)?;
        state.dynamics = Some(shown);
    }
    show(context, values, state, &mut configuration, &settings, over_time, time_s)?;
    (state.dynamics, state.propellant) = (begun, propellant);
    state.configuration = Some(configuration);
    state.dynamics_settings = Some(settings);
    Ok(())
}

/// One step, under the configuration so far where nothing changed that it depends on.
pub fn step(
    context: &Plan<'_>,
    values: &mut Values,
    state: &mut PlantState,
    step: &Step<'_>,
    changes: Option<Changes>,
) -> Result<(), Failure> {
    let kept = changes.is_none_or(|changes| !changes.any());
    let known = state.configuration.take().zip(state.dynamics_settings.take()).filter(|_| kept);
    let (mut configuration, mut settings) = match known {
        Some(known) => known,
        None => {
            let configuration = inputs::configuration(context, values, state)?;
            outputs::write_calculated(context, values, state, &configuration);
            let settings = dynamics::settings(context, values, &configuration)?;
            (configuration, settings)
        }
    };
    if changes.is_some() {
        inputs::move_panels(context, values, step.inputs, &mut configuration);
    }
    if state.light.is_none() {
        state.light = inputs::light(context, values, &configuration)?;
    }
    let Some(mut flown) = state.dynamics.take() else {
        return Err(Failure::new(
            "the state holds no attitude dynamics: it belongs to another attitude.source",
        ));
    };
    if let Some(changes) = changes {
        // On a disturbed orbit the mass tells where the spacecraft goes.
        let pushed =
            changes.force && matches!(configuration.motion, Motion::Disturbed { feedback: true, .. });
        let loads_change = changes.light || changes.mass || pushed;
        flown.cut(step.start_s, loads_change);
        if loads_change {
            state.propagator.cut(&configuration, step.start_s, true);
        }
        if changes.orbit && inputs::is_given(context.variables, values) {
            state.propagator.move_to(&configuration, step.start_s).map_err(outputs::failure)?;
        }
    }
    if state.request.rises(values.boolean(context.variables.dump.request)) {
        let target = Vector3::from(values.vector(context.variables.dump.target));
        flown.cut(step.start_s, false);
        let event = flown.dump_to(&settings, target);
        log_dump(context, &event);
    }
    let over_time = step.inputs;
    let stretch = Stretch { context, values, over_time, tracked: tracked(context, values, state) };
    let acting = |time_s: f64| dynamics::external(context, stretch.values, over_time, time_s)[0];
    propulsion::warn(context, stretch.values, &settings.thrusters, &mut state.said_of_thrusters, step);
    let manager = inputs::manager(context, stretch.values, &configuration);
    let unserved = flown.thrusters().unserved_dumps();
    let mut flight = flight(context, state, &mut configuration, &acting, &manager)?;
    stretch
        .with_inputs(|inputs| {
            flown.command_thrusters(&settings, inputs, step.start_s, step.end_s);
            flown.advance(&mut settings, &mut flight, inputs, step.end_s, |event| log_dump(context, event))
        })
        .map_err(outputs::failure)?;
    let unserved = [unserved, flown.thrusters().unserved_dumps()];
    state.dynamics = Some(flown);
    show(context, values, state, &mut configuration, &settings, over_time, step.end_s)?;
    let said = &mut state.said_of_thrusters;
    propulsion::warn_unserved(context, values, &settings.thrusters, said, unserved);
    state.configuration = Some(configuration);
    state.dynamics_settings = Some(settings);
    Ok(())
}

fn flight<'f>(
    context: &'f Plan<'_>,
    state: &'f mut PlantState,
    configuration: &'f mut Configuration,
    external: &'f dyn Fn(f64) -> ExternalLoad,
    planner: &'f dyn SunPlanner,
) -> Result<Flight<'f>, Failure> {
    Ok(Flight {
        prepared: context.setup.prepared_spacecraft(configuration.sunshade)?,
        configuration,
        propagator: &mut state.propagator,
        ephemeris: &mut state.ephemeris,
        light: state.light.as_mut(),
        propellant: &mut state.propellant,
        external,
        planner,
    })
}

/// Writes every output at `time_s`.
fn show(
    context: &Plan<'_>,
    values: &mut Values,
    state: &mut PlantState,
    configuration: &mut Configuration,
    settings: &DynamicsSettings,
    over_time: InputsOverTime<'_>,
    time_s: f64,
) -> Result<(), Failure> {
    let Some(flown) = state.dynamics.take() else { return Ok(()) };
    let body = flown.body(settings, time_s);
    let [external, _] = dynamics::external(context, values, over_time, time_s);
    let manager = inputs::manager(context, values, configuration);
    let evaluation = flown.evaluation(
        settings,
        &mut flight(context, state, configuration, &|_| external, &manager)?,
        &body,
        external,
        time_s,
    );
    let totals = Totals {
        momentum_inertial_n_m_s: body.momentum_inertial_n_m_s,
        delta_v_inertial_m_s: body.delta_v_inertial_m_s,
        ..Totals::default()
    };
    flyable(&evaluation, &totals, time_s)?;
    outputs::write_plates(context, values, state, configuration, time_s)?;
    outputs::write(context, values, state, configuration, &evaluation, &totals, time_s);
    let rotation = &evaluation.instant.frame.inertial_from_body;
    outputs::write_by_source(context, values, &flown.by_source(time_s), Convention::Inertial, rotation);
    outputs::write_dumps(context, values, flown.dumps(), flown.spacing(), flown.is_dumping(time_s));
    let mut pushed_m_s = Vector3::zeros();
    if let Some([impulse, delta_v]) = flown.dumped_at(time_s) {
        values.set_vector(context.variables.dump.impulse, impulse.into());
        pushed_m_s = delta_v;
    }
    values.set_vector(context.variables.dump.delta_v, pushed_m_s.into());
    outputs::write_dynamics(context, values, settings, &flown, &body, time_s);
    write_thrusters(context, values, settings, &flown, &state.propellant, time_s);
    state.dynamics = Some(flown);
    Ok(())
}

//! From an evaluation to the output variables.

use fmi_export::{Failure, Real, Values};
use nalgebra::{Rotation3, Vector3};
use physics::attitude::control::{sample_number, sensed_sun};
use physics::attitude::{Attitude, BodyMotion, SunAngles, motor_power_w, wheel_speed_rad_s};
use physics::environment::time;
use physics::momentum::{Convention, DumpEvent, DumpSpacing, Dumps, SourceMomenta, Totals, WheelArray};
use physics::plant::{
    AttitudeDynamics, Configuration, Cost, DynamicsSettings, Evaluation, ExternalLoad, Instant, PanelSetting,
    Plant, PlantError, Work,
};
use physics::radiation::{Effect, TorquePolynomial, polynomial_valid};

use super::super::inputs::dynamics;
use super::super::inputs::state::PlantState;
use super::super::setup::Plan;
use super::propulsion::write_tanks;

/// Writes every output at `time_s`.
pub fn write(
    context: &Plan<'_>,
    values: &mut Values,
    state: &PlantState,
    configuration: &Configuration,
    evaluation: &Evaluation,
    totals: &Totals,
    time_s: f64,
) {
    let variables = context.variables;
    let Evaluation { instant, loads, mass, .. } = evaluation;
    let rotation = &instant.frame.inertial_from_body;
    values.set_real(variables.epoch, time::epoch_at_s(time_s, configuration.epoch_minus_time_s));
    values.set_vector(variables.attitude.q, Attitude::from_rotation(rotation).quaternion(None));
    values.set_vector(variables.attitude.rate, instant.frame.rate_body_rad_s.into());

    let total = loads.total();
    for effect in Effect::ALL {
        if let Some(torque) = variables.torque.by_source.of(effect) {
            values.set_vector(torque, loads[effect].torque_body_n_m.into());
        }
        if let Some(force) = variables.force.by_source.of(effect) {
            values.set_vector(force, loads[effect].force_body_n.into());
        }
    }
    let own = &loads[Effect::Thrusters];
    values.set_vector(variables.torque.thruster, own.torque_body_n_m.into());
    values.set_vector(variables.force.thruster, own.force_body_n.into());
    values.set_vector(variables.torque.total, total.torque_body_n_m.into());
    values.set_vector(variables.force.total, total.force_body_n.into());
    values.set_vector(variables.force.inertial, evaluation.force_inertial_n().into());
    let acceleration_m_s2 = evaluation.acceleration_inertial_m_s2(mass.mass_kg);
    values.set_vector(variables.acceleration, acceleration_m_s2.into());
    values.set_vector(variables.delta_v, totals.delta_v_inertial_m_s.into());

    let momenta = state.integrator.by_source(time_s);
    write_by_source(context, values, &momenta, configuration.momentum.convention, rotation);
    values.set_boolean(variables.momentum.target_clamped, state.propagator.sun_choice.is_clamped());

    let sun = SunAngles::of(&instant.sun_body);
    let planet_body_m = instant.planet_body_m.unwrap_or_default();
    values.set_vector(variables.sun.position_body, instant.sun_position_body_m().into());
    values.set_vector(variables.planet.position_body, planet_body_m.into());
    values.set_vector(variables.sun.direction, instant.sun_body.into());
    values.set_real(variables.sun.azimuth, sun.azimuth_rad);
    values.set_real(variables.sun.elevation, sun.elevation_rad);
    values.set_real(variables.sun.lit_fraction, instant.lit_fraction);
    values.set_real(variables.sun.distance, instant.sun_distance_m);
    let earth = SunAngles::of(&instant.earth_body());
    values.set_real(variables.earth.azimuth, earth.azimuth_rad);
    values.set_real(variables.earth.elevation, earth.elevation_rad);
    let (azimuth_limit_rad, elevation_limit_rad) =
        (values.real(variables.keep_in.azimuth), values.real(variables.keep_in.elevation));
    values.set_real(variables.keep_in.margin, sun.keep_in_margin_rad(azimuth_limit_rad, elevation_limit_rad));

    let spacecraft = &instant.geometry.spacecraft;
    values.set_vector(variables.position, spacecraft.position_m.into());
    values.set_vector(variables.velocity, spacecraft.velocity_m_s.into());
    let (sun, earth) = (instant.geometry.sun_from_center(), instant.geometry.earth_from_center());
    values.set_vector(variables.sun.position_inertial, sun.position_m.into());
    values.set_vector(variables.sun.velocity_inertial, sun.velocity_m_s.into());
    values.set_vector(variables.earth.position_inertial, earth.position_m.into());
    values.set_vector(variables.earth.velocity_inertial, earth.velocity_m_s.into());
    values.set_vector(variables.heliocentric.position, instant.geometry.heliocentric_position_m().into());
    let since_s = if state.waiting {
        0.0
    } else {
        state.propagator.trajectory.time_since_periapsis_s(configuration, time_s)
    };
    values.set_real(variables.orbit.time_since_periapsis, since_s);
    values.set_real(variables.mass, mass.mass_kg);
    values.set_vector(variables.center_of_mass, mass.center_of_mass_body_m.into());

    let valid = context
        .setup
        .spacecraft
        .sunshade
        .as_ref()
        .is_none_or(|shade| polynomial_valid(shade, configuration.sunshade, &instant.sun_body));
    values.set_boolean(variables.sunshade.polynomial_valid, valid);
    let panels = context.setup.spacecraft.panels.iter().zip(&configuration.panels);
    for (panel, (body, setting)) in variables.panel.iter().zip(panels) {
        values
            .set_real(panel.angle_actual, setting.angle_rad(body, &instant.sun_body, time_s).unwrap_or(0.0));
    }

    values.set_vector(
        variables.momentum.body,
        totals.momentum_body_n_m_s(configuration.momentum.convention, rotation).into(),
    );
    values.set_vector(variables.momentum.inertial, totals.momentum_inertial_n_m_s.into());
}

/// Writes what guided and commanded flight know without dynamics: ideal wheels, dumps, sensors that see the true attitude.
pub fn write_ideal(
    context: &Plan<'_>,
    values: &mut Values,
    state: &mut PlantState,
    evaluation: &Evaluation,
    totals: &Totals,
    time_s: f64,
) -> Result<(), Failure> {
    write_wheels(context, values, state, totals, evaluation, time_s);
    write_dumps(context, values, state.integrator.dumps(), &state.spacing, false);
    let dump_delta_v_m_s = state.dump_side_effect.delta_v_inertial_m_s;
    values.set_vector(context.variables.dump.delta_v, dump_delta_v_m_s.into());
    if let Some(thrusters) = &state.thrusters {
        write_tanks(context, values, thrusters, &state.propellant, time_s);
    }
    let v = context.variables;
    let Instant { frame, sun_body, lit_fraction, .. } = &evaluation.instant;
    values.set_vector(v.estimate.q, Attitude::from_rotation(&frame.inertial_from_body).quaternion(None));
    values.set_vector(v.estimate.rate, frame.rate_body_rad_s.into());
    values.set_boolean(v.estimate.valid, dynamics::health(context, values).star_tracker);
    if state.sun_sensors.is_none() {
        state.sun_sensors = Some(dynamics::sun_sensors(context, values)?);
    }
    let sensors = state.sun_sensors.as_deref().unwrap_or_default();
    let failed = |k: usize| v.sun_sensor.get(k).is_some_and(|sensor| values.boolean(sensor.failed));
    let seed = values.integer(v.noise.seed).unsigned_abs().into();
    let sample = sample_number(time_s, values.real(v.control.rate));
    let seen =
        if state.waiting { None } else { sensed_sun(sensors, failed, sun_body, *lit_fraction, seed, sample) };
    write_sensed_sun(context, values, seen);
    Ok(())
}

/// Writes wheels, sensors and control of controlled and free flight.
pub fn write_dynamics(
    context: &Plan<'_>,
    values: &mut Values,
    settings: &DynamicsSettings,
    flown: &AttitudeDynamics,
    body: &BodyMotion,
    time_s: f64,
) {
    let v = context.variables;
    for (k, wheel) in v.wheel.iter().enumerate() {
        let momentum_n_m_s = flown.wheel_n_m_s(settings, k, time_s, body);
        values.set_real(wheel.momentum, momentum_n_m_s);
        let flown_wheel = &settings.gyrostat.wheels()[k];
        let speed_rad_s = flown_wheel.speed_rad_s(momentum_n_m_s);
        let torque_n_m = flown.motor_n_m(settings, k, time_s);
        values.set_real(wheel.speed, speed_rad_s);
        values.set_real(wheel.torque, torque_n_m);
        values.set_real(wheel.power, motor_power_w(torque_n_m, speed_rad_s));
        values.set_boolean(wheel.saturated, flown_wheel.is_saturated(momentum_n_m_s));
    }
    for (k, mode) in v.flexible_mode.iter().enumerate() {
        values.set_real(mode.displacement, flown.mode_sqrt_kg_m(k, time_s, body));
    }
    for (k, slosh) in v.slosh.iter().enumerate() {
        values.set_vector(slosh.angle, flown.slosh_rad(settings, k, time_s, body));
    }
    let estimate = flown.estimate_at(time_s);
    values.set_vector(v.estimate.q, estimate.attitude.quaternion(None));
    values.set_vector(v.estimate.rate, estimate.rate_body_rad_s.unwrap_or_default().into());
    values.set_boolean(v.estimate.valid, estimate.is_valid);
    write_sensed_sun(context, values, flown.sun_sensed_body());
    let controlled = settings.control.is_some();
    values.set_real(v.control.error, if controlled { flown.control_error_rad() } else { 0.0 });
    values.set_boolean(v.control.settled, controlled && flown.is_settled());
    values.set_boolean(v.control.saturated, flown.is_torque_limited());
}

fn write_sensed_sun(context: &Plan<'_>, values: &mut Values, seen: Option<Vector3<f64>>) {
    values.set_vector(context.variables.sun.sensed, seen.unwrap_or_default().into());
    values.set_boolean(context.variables.sun.sensed_valid, seen.is_some());
}

/// Writes the faces that are reported one by one; those of panels that are left out stay 0.
pub fn write_plates(
    context: &Plan<'_>,
    values: &mut Values,
    state: &mut PlantState,
    configuration: &Configuration,
    time_s: f64,
) -> Result<(), Failure> {
    if context.variables.plate.is_empty() {
        return Ok(());
    }
    if state.waiting {
        for plate in &context.variables.plate {
            values.set_real(plate.temperature, 0.0);
            values.set_vector(plate.force, [0.0; 3]);
        }
        return Ok(());
    }
    let left_out = |panel: usize| configuration.panels.get(panel) == Some(&PanelSetting::Disabled);
    let faces = context.variables.plate.iter().zip(&context.setup.reported_faces);
    let mut flown = faces.filter(|(_, face)| !face.panel.is_some_and(left_out)).map(|(plate, _)| plate);
    let prepared = context.setup.prepared_spacecraft(configuration.sunshade)?;
    let (propagator, ephemeris, light) = (&mut state.propagator, &mut state.ephemeris, state.light.as_mut());
    let work = Work::new(u32::MAX, ephemeris.evaluations());
    Plant::new(prepared, configuration, propagator, ephemeris, light, |_| ExternalLoad::default(), work)
        .faces(time_s, |temperature_k, force_body_n| {
            if let Some(plate) = flown.next() {
                values.set_real(plate.temperature, temperature_k);
                values.set_vector(plate.force, force_body_n.into());
            }
        })
        .map_err(failure)
}

/// Writes what follows from parameters alone.
pub fn write_calculated(
    context: &Plan<'_>,
    values: &mut Values,
    state: &mut PlantState,
    configuration: &Configuration,
) {
    let spacecraft = &context.setup.spacecraft;
    let shade = spacecraft.sunshade.as_ref();
    let polynomial = shade.and_then(|shade| {
        TorquePolynomial::of_sunshade(shade, configuration.sunshade, &configuration.center_of_mass_body_m)
            .ok()
    });
    values.set_matrix(context.variables.sunshade.coefficient, polynomial.map_or([[0.0; 9]; 3], |p| p.k));
    let capacities_n_m_s = context.variables.wheel.iter().map(|wheel| values.real(wheel.capacity));
    let array = state.wheels.get_or_insert_with(|| wheels(context, values)).as_ref();
    let guaranteed_n_m_s = array.map_or(0.0, |it| it.guaranteed_threshold_n_m_s(capacities_n_m_s));
    values.set_real(context.variables.dump.guaranteed_threshold, guaranteed_n_m_s);
}

/// Distribution of momentum over the wheels; `None` unless they span all directions.
pub fn wheels(context: &Plan<'_>, values: &Values) -> Option<WheelArray> {
    let axes = context
        .variables
        .wheel
        .iter()
        .map(|wheel| Vector3::from(values.vector(wheel.axis)).try_normalize(0.0));
    WheelArray::new(&axes.collect::<Option<Vec<_>>>()?)
}

/// Ideal wheels hold the system's momentum less what the body's own rotation and panels that turn take.
fn write_wheels(
    context: &Plan<'_>,
    values: &mut Values,
    state: &mut PlantState,
    totals: &Totals,
    evaluation: &Evaluation,
    time_s: f64,
) {
    let acceleration = state.integrator.acceleration_body_rad_s2(time_s);
    let Some(array) = state.wheels.get_or_insert_with(|| wheels(context, values)) else { return };
    let frame = &evaluation.instant.frame;
    let inertia_body_kg_m2 = &evaluation.mass.inertia_body_kg_m2;
    let wheels_body_n_m_s =
        totals.wheels_body_n_m_s(inertia_body_kg_m2, &evaluation.panels_body_n_m_s, frame);
    let torque_body_n_m = evaluation.loads.total().torque_body_n_m;
    let rate_body_n_m =
        totals.wheels_rate_body_n_m(inertia_body_kg_m2, frame, &torque_body_n_m, &acceleration);
    for (number, variables) in context.variables.wheel.iter().enumerate() {
        let momentum_n_m_s = array.momentum_n_m_s(number, &wheels_body_n_m_s);
        values.set_real(variables.momentum, momentum_n_m_s);
        let inertia_kg_m2 = values.real(variables.inertia);
        let speed_rad_s = wheel_speed_rad_s(momentum_n_m_s, inertia_kg_m2);
        let torque_n_m = array.motor_n_m(number, inertia_kg_m2, &rate_body_n_m, &acceleration);
        values.set_real(variables.speed, speed_rad_s);
        values.set_real(variables.torque, torque_n_m);
        values.set_real(variables.power, motor_power_w(torque_n_m, speed_rad_s));
        values.set_boolean(variables.saturated, momentum_n_m_s.abs() > values.real(variables.capacity));
    }
}

/// Writes dumps, how far apart they lay, and whether one lasts.
pub fn write_dumps(
    context: &Plan<'_>,
    values: &mut Values,
    dumps: &Dumps,
    spacing: &DumpSpacing,
    is_active: bool,
) {
    let dump = &context.variables.dump;
    values.set_boolean(dump.active, is_active);
    values.set_integer(dump.count, dumps.count);
    values.set_real(dump.last_time, dumps.last.map_or(-1.0, |event| event.time_s));
    values.set_real(dump.closest, spacing.closest_s.unwrap_or(-1.0));
    let required_s = values.real(dump.required_spacing);
    values.set_boolean(dump.too_close, spacing.closest_s.is_some_and(|closest_s| closest_s < required_s));
    values.set_vector(
        dump.impulse,
        dumps.last.map_or(Vector3::zeros(), |event| event.impulse_body_n_m_s()).into(),
    );
}

/// First derivative of what the plant integrates, from the rates at the same time.
pub fn derivative(context: &Plan<'_>, values: &Values, state: &PlantState, output: Real) -> Option<f64> {
    if state.waiting {
        return None;
    }
    let variables = context.variables;
    let convention = state.configuration.as_ref()?.momentum.convention;
    let mut torque_body = Vector3::from(values.vector(variables.torque.total));
    if let Some(flown) = state.dynamics.as_ref().filter(|_| values.boolean(variables.dump.active)) {
        torque_body = flown.with_dump_body_n_m(&torque_body);
    }
    if let Some(element) = variables.attitude.q.index_of(output) {
        let attitude = Attitude::from_quaternion(values.vector(variables.attitude.q)).ok()?;
        return Some(attitude.quaternion_rate(&values.vector(variables.attitude.rate).into())[element]);
    }
    if let Some(axis) = variables.momentum.body.index_of(output) {
        let [momentum_body, rate_body] = [variables.momentum.body, variables.attitude.rate]
            .map(|handle| Vector3::from(values.vector(handle)));
        return Some(convention.momentum_rate_body_n_m(&momentum_body, &torque_body, &rate_body)[axis]);
    }
    let by_source = variables.momentum.by_source.all().into_iter();
    let found =
        by_source.filter_map(|(effect, handle)| Some((effect, handle, handle.index_of(output)?))).next();
    if let Some((effect, handle, axis)) = found {
        let torque = variables.torque.by_source.of(effect).unwrap_or(variables.torque.applied);
        let [momentum_body, torque_body, rate_body] =
            [handle, torque, variables.attitude.rate].map(|handle| Vector3::from(values.vector(handle)));
        return Some(convention.momentum_rate_body_n_m(&momentum_body, &torque_body, &rate_body)[axis]);
    }
    if let Some(axis) = variables.momentum.inertial.index_of(output) {
        let attitude = Attitude::from_quaternion(values.vector(variables.attitude.q)).ok()?;
        return Some(attitude.to_inertial(&torque_body)[axis]);
    }
    if let Some(axis) = variables.delta_v.index_of(output) {
        return Some(values.vector(variables.acceleration)[axis]);
    }
    let moving = [
        (variables.position, variables.velocity),
        (variables.sun.position_inertial, variables.sun.velocity_inertial),
        (variables.earth.position_inertial, variables.earth.velocity_inertial),
    ];
    let found = moving.iter().find_map(|(place, rate)| place.index_of(output).map(|axis| (rate, axis)));
    found.map(|(rate, axis)| values.vector(*rate)[axis])
}

/// Writes what each effect did to the momentum since the last dump, the body standing like this.
pub fn write_by_source(
    context: &Plan<'_>,
    values: &mut Values,
    momenta: &SourceMomenta,
    convention: Convention,
    inertial_from_body: &Rotation3<f64>,
) {
    for (effect, output) in context.variables.momentum.by_source.all() {
        let momentum = momenta.body_n_m_s(effect, convention, inertial_from_body).unwrap_or_default();
        values.set_vector(output, momentum.into());
    }
}

/// Why a flight ends, with the variables to look at.
pub fn failure(error: PlantError) -> Failure {
    let hint = match &error {
        PlantError::Nowhere { .. } | PlantError::Light { .. } => {
            "; see orbit.*, sun.position and planet.radius"
        }
        PlantError::Dumps(_) => "; see dump.threshold, dump.reinitTo and torque.applied",
        PlantError::Work(exceeded) => {
            let most = match exceeded.most {
                Cost::Segment => {
                    "internal steps, which solver.step, orbit.step and solver.disturbanceStep keep short"
                }
                Cost::Refinement => {
                    "internal steps shortened for solver.tolerance, which is small for this torque and attitude rate"
                }
                Cost::Search => {
                    "searches for changes of attitude, light and eclipse: see orbit.*, guided.* and command.rate"
                }
                Cost::Dump => {
                    "dumps: dump.threshold is low for this torque; see torque.applied and spacecraft.centerOfMass"
                }
                Cost::Light => {
                    "light and heat: see solver.disturbanceStep, solver.disturbanceTolerance and planetLight.nodes"
                }
                Cost::Orbit => "integrating the orbit in steps of orbit.step",
                Cost::Ephemeris => {
                    "the positions of planets far apart in time: see guided.slewRate and guided.downlinkEvery"
                }
            };
            return Failure::new(format!(
                "{error} (solver.workLimit = {}); most went into {most}. Take a shorter step or raise solver.workLimit",
                exceeded.limit
            ));
        }
        _ => "",
    };
    Failure::new(format!("{error}{hint}"))
}

/// Refuses a place where there is no flight: inside the planet or the Sun, or nowhere.
pub fn flyable(evaluation: &Evaluation, totals: &Totals, time_s: f64) -> Result<(), Failure> {
    if !totals.is_finite() {
        return Err(Failure::new(format!(
            "at {time_s} s momentum.inertial, momentum.body or deltaV is no finite number; see start.momentum, torque.applied, \
             force.applied, spacecraft.mass and spacecraft.centerOfMass"
        )));
    }
    evaluation.check(time_s).map_err(failure)
}

/// Reports a dump.
pub fn log_dump(context: &Plan<'_>, event: &DumpEvent) {
    if context.log.events_enabled() {
        let message = format!(
            "thruster dump: momentum {:?} -> {:?} N.m.s (body)",
            event.before_body_n_m_s.as_slice(),
            event.after_body_n_m_s.as_slice()
        );
        context.log.event(event.time_s, &message);
    }
}

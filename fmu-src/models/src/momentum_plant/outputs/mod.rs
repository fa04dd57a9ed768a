//! From a report of the flight to the output variables.

mod encounter;
pub(super) mod messages;
mod rates;

use fmi_export::{DeferredOutputs, Failure, Knowns, OutputGroups, Values, knowns};
use nalgebra::Vector3;
use physics::attitude::SunAngles;
use physics::environment::time;
use physics::loads::Switch;
use physics::plant::{AirAndField, Evaluation, Flight, PreparedSpacecraft, ReachedState, Report, THRUSTERS};
use physics::plausibility::is_sun_offset_reached;
use physics::propulsion::surface_in_plume;
use physics::radiation::{SolarModel, TorquePolynomial, polynomial_valid};
use physics::spacecraft::light_suns;

use self::messages::failure;
use super::setup::{MomentumPlant, Plan};
use super::state::{PlantState, SavedState};
use super::variables::PlantVariables;
use crate::common::choices::OrbitCenter;
use crate::common::loads;

/// Outputs that are written together, and what writes them.
struct Group {
    outputs: fn(&PlantVariables) -> Knowns,
    /// Whether they follow from forces and torques.
    read_loads: bool,
    write: fn(&Plan<'_>, &mut Values, &Report<'_>),
}

const fn group(
    write: fn(&Plan<'_>, &mut Values, &Report<'_>),
    outputs: fn(&PlantVariables) -> Knowns,
) -> Group {
    Group { outputs, read_loads: false, write }
}

/// The outputs in groups, but for the faces; all of them are written when one is read.
const GROUPS: [Group; 10] = [
    group(write_motion, |v| knowns![v.momentum.body, v.momentum.inertial, v.delta_v, &v.attitude, v.epoch]),
    Group {
        read_loads: true,
        ..group(write_loads, |v| knowns![&v.torque, &v.force, v.acceleration, v.mass, v.center_of_mass])
    },
    group(write_bodies, |v| {
        let sun = knowns![v.sun.position_body, v.sun.direction, v.sun.azimuth, v.sun.elevation];
        let light = knowns![v.sun.lit_fraction, v.sun.distance, v.sunshade.polynomial_valid];
        let others = knowns![&v.earth, v.planet.position_body, v.planet.pole_body, &v.keep_in];
        let inertial = knowns![v.sun.position_inertial, v.sun.velocity_inertial, v.heliocentric_position];
        knowns![sun, light, others, inertial, v.position, v.velocity]
    }),
    group(write_orbit, |v| knowns![&v.orbit, &v.osculating, v.sun.beta, &v.encounter, &v.prediction]),
    group(write_air_and_field, |v| knowns![&v.geodetic, &v.atmosphere, &v.magnetic_field]),
    // The plume of a thruster reaches panels as they stand.
    group(write_panels_and_thrusters, |v| {
        knowns![&v.panel, &v.thruster, &v.thrust, &v.tank, v.propellant_used]
    }),
    group(write_momentum, |v| {
        let momentum = knowns![&v.momentum.by_source, v.momentum.bias, v.momentum.unheld];
        knowns![momentum, v.momentum.target_clamped, v.guided_degenerate, &v.downlink, &v.timeline]
    }),
    Group { read_loads: true, ..group(write_wheels, |v| knowns![&v.wheel, &v.flexible_mode, &v.slosh]) },
    group(write_dumps, |v| knowns![&v.dump, &v.maneuver]),
    group(write_sensors, |v| {
        knowns![&v.estimate, v.sun.sensed, v.sun.sensed_valid, &v.accelerometer, &v.control]
    }),
];

impl DeferredOutputs for MomentumPlant {
    /// The outputs of each group, those of the faces last.
    fn output_groups(v: &PlantVariables) -> Vec<Knowns> {
        let of_faces = core::iter::once(knowns![&v.plate]);
        GROUPS.iter().map(|group| (group.outputs)(v)).chain(of_faces).collect()
    }

    /// Writes the outputs of these groups at `time_s`, where the flight was evaluated last.
    fn write_outputs(
        context: &Plan<'_>,
        values: &mut Values,
        state: &mut PlantState,
        groups: OutputGroups,
        time_s: f64,
    ) -> Result<(), Failure> {
        let PlantState { saved: SavedState { flight, command, .. }, inputs } = state;
        let prepared =
            context.setup.prepared_spacecraft(values.choice(context.variables.sunshade.shape).0)?;
        let asked = || GROUPS.iter().enumerate().filter(|(index, _)| groups.contains(*index));
        let with_loads = asked().any(|(_, group)| group.read_loads);
        // Not `map_err`, which would copy the report.
        let report = match flight.report(prepared, &inputs.dynamics, command, with_loads, time_s) {
            Ok(report) => report,
            Err(error) => return Err(failure(error)),
        };
        asked().for_each(|(_, group)| (group.write)(context, values, &report));
        if groups.contains(GROUPS.len()) {
            write_faces(context, values, flight, prepared, time_s)
        } else {
            Ok(())
        }
    }
}

/// Time, attitude, momentum, velocity change.
fn write_motion(context: &Plan<'_>, values: &mut Values, report: &Report<'_>) {
    let Report { time_s, configuration, evaluation, summary, .. } = report;
    let (v, frame) = (context.variables, &evaluation.instant.law.frame);
    let convention = configuration.momentum.convention;
    let rotation = &frame.inertial_from_body;
    values.set_real(v.epoch, time::epoch_at_s(*time_s, configuration.epoch_minus_time_s));
    values.set_vector(v.attitude.q, summary.attitude.unit_quaternion().0);
    values.set_vector(v.attitude.rate, frame.rate_body_rad_s.into());
    values.set_vector(v.delta_v, summary.totals.delta_v_inertial_m_s.into());
    values.set_vector(v.momentum.body, summary.totals.momentum_body_n_m_s(convention, rotation).into());
    values.set_vector(v.momentum.inertial, summary.totals.momentum_inertial_n_m_s.into());
}

/// Force, torque, mass.
fn write_loads(context: &Plan<'_>, values: &mut Values, report: &Report<'_>) {
    let (variables, evaluation) = (context.variables, report.evaluation);
    let Evaluation { loads, mass, .. } = evaluation;
    let total = loads.total();
    for (output, vector) in loads::vectors(&variables.torque.by_source, &variables.force.by_source, loads) {
        values.set_vector(output, vector.into());
    }
    let own = &loads[THRUSTERS];
    values.set_vector(variables.torque.thruster, own.torque_body_n_m.into());
    values.set_vector(variables.force.thruster, own.force_body_n.into());
    values.set_vector(variables.torque.total, total.torque_body_n_m.into());
    values.set_vector(variables.force.total, total.force_body_n.into());
    let [force_inertial_n, acceleration_inertial_m_s2] = evaluation.force_and_acceleration_inertial();
    values.set_vector(variables.force.inertial, force_inertial_n.into());
    values.set_vector(variables.acceleration, acceleration_inertial_m_s2.into());
    values.set_real(variables.mass, mass.mass_kg);
    values.set_vector(variables.center_of_mass, mass.center_of_mass_body_m.into());
}

/// Positions of spacecraft, Sun, Earth and planet.
fn write_bodies(context: &Plan<'_>, values: &mut Values, report: &Report<'_>) {
    let Report { configuration, evaluation, .. } = report;
    let (variables, instant) = (context.variables, &evaluation.instant);
    let sun = SunAngles::from_direction(&instant.sun_body);
    let planet_body_m = instant.planet_body_m.unwrap_or_default();
    values.set_vector(variables.sun.position_body, instant.sun_position_body_m().into());
    values.set_vector(variables.planet.position_body, planet_body_m.into());
    values.set_vector(variables.planet.pole_body, evaluation.pole_body(configuration).into());
    values.set_vector(variables.sun.direction, instant.sun_body.into());
    values.set_real(variables.sun.azimuth, sun.azimuth_rad);
    values.set_real(variables.sun.elevation, sun.elevation_rad);
    values.set_real(variables.sun.lit_fraction, instant.lit_fraction);
    values.set_real(variables.sun.distance, instant.sun_distance_m);
    let earth = SunAngles::from_direction(&instant.earth_body());
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
    values.set_vector(variables.heliocentric_position, instant.geometry.heliocentric_position_m().into());
    let valid = context
        .setup
        .spacecraft
        .sunshade
        .as_ref()
        .is_none_or(|shade| polynomial_valid(shade, configuration.sunshade, &instant.sun_body));
    values.set_boolean(variables.sunshade.polynomial_valid, valid);
}

/// Orbit and encounter.
fn write_orbit(context: &Plan<'_>, values: &mut Values, report: &Report<'_>) {
    let variables = context.variables;
    values.set_real(variables.orbit.time_since_periapsis, report.since_periapsis_s);
    let center = report.propagator.trajectory.integration_center(report.configuration);
    values.set_choice(variables.orbit.current_center, OrbitCenter(center));
    let osculating = report.osculating_orbit();
    variables.osculating.write(values, osculating.as_ref());
    values.set_real(variables.sun.beta, osculating.map_or(0.0, |orbit| orbit.sun_elevation_rad));
    encounter::write(&variables.encounter, values, report);
    encounter::write_prediction(&variables.prediction, values, report);
}

/// Angles of the panels, and the light on their cells; thrusters and tanks.
fn write_panels_and_thrusters(context: &Plan<'_>, values: &mut Values, report: &Report<'_>) {
    let Report { time_s, configuration, evaluation, .. } = report;
    let (variables, time_s) = (context.variables, *time_s);
    let panels = context.setup.spacecraft.panels.iter().zip(&configuration.panels);
    let sun = evaluation.instant.sun();
    // The corridor was checked where the flight began.
    let corridor = variables.articulation.read(values).unwrap_or_default();
    for (index, (panel, (body, setting))) in variables.panel.iter().zip(panels).enumerate() {
        let angle_rad = setting.angle_rad(body, &sun);
        let normal_body = angle_rad.filter(|_| sun.distance_m > 0.0).map(|it| body.normal_body(it));
        let suns =
            normal_body.map(|normal_body| light_suns(&normal_body, &sun.direction_body, sun.distance_m));
        let continued_rad = |angle_rad| report.propagator.panel_turns.continued_rad(index, angle_rad, time_s);
        let offsets_rad = normal_body.map(|normal_body| setting.sun_offsets_rad(&normal_body, &sun));
        values.set_real(panel.sun_offset_actual, offsets_rad.map_or(0.0, |[_, actual_rad]| actual_rad));
        values.set_boolean(panel.sun_offset_reached, offsets_rad.is_some_and(is_sun_offset_reached));
        values.set_real(panel.angle_actual, angle_rad.map_or(0.0, continued_rad));
        values.set_real(panel.suns, suns.unwrap_or(0.0));
        values.set_real(panel.corridor_margin, suns.map_or(0.0, |suns| corridor.margin_suns(suns)));
    }
    write_thrusters(context, values, report);
}

/// Place over the planet, air and magnetic field.
fn write_air_and_field(context: &Plan<'_>, values: &mut Values, report: &Report<'_>) {
    let Report { time_s, configuration, evaluation, .. } = report;
    let Evaluation { instant, air_and_field, .. } = evaluation;
    let AirAndField { air, field_inertial_t, .. } = air_and_field;
    let v = context.variables;
    let from_planet = instant.geometry.from_planet();
    if let Some((figure, place)) = configuration.figure.as_ref().zip(from_planet) {
        let epoch_s = time::epoch_at_s(*time_s, configuration.epoch_minus_time_s);
        let geodetic = figure.geodetic(epoch_s, &place.position_m);
        values.set_real(v.geodetic.latitude, geodetic.latitude_rad);
        values.set_real(v.geodetic.longitude, geodetic.longitude_rad);
        values.set_real(v.geodetic.height, geodetic.height_m);
    }
    if configuration.effects.is_on(Switch::Aerodynamics) {
        values.set_real(v.atmosphere.density, air.density_kg_m3);
        values.set_real(v.atmosphere.temperature, air.temperature_k);
        values.set_real(v.atmosphere.molar_mass, air.molar_mass_kg_mol);
        values.set_vector(v.atmosphere.velocity_body, evaluation.velocity_in_air_body_m_s().into());
    }
    if configuration.effects.is_on(Switch::Magnetics) {
        values.set_vector(v.magnetic_field.inertial, (*field_inertial_t).into());
        values.set_vector(v.magnetic_field.body, evaluation.field_body_t().into());
    }
}

/// Momentum by source and beyond the wheels, downlink, timeline.
fn write_momentum(context: &Plan<'_>, values: &mut Values, report: &Report<'_>) {
    let (v, summary) = (context.variables, &report.summary);
    let convention = report.configuration.momentum.convention;
    let rotation = &report.evaluation.instant.law.frame.inertial_from_body;
    values.set_vector(v.momentum.bias, report.configuration.momentum.policy.bias_body_n_m_s.into());
    values.set_vector(v.momentum.unheld, summary.unheld_body_n_m_s().into());
    let by_source = summary.by_source();
    for (effect, output) in v.momentum.by_source.iter() {
        values.set_vector(output, by_source.body_n_m_s(effect, convention, rotation).into());
    }
    values.set_boolean(v.momentum.target_clamped, report.propagator.sun_choice.is_clamped());
    values.set_boolean(v.guided_degenerate, report.evaluation.instant.law.degenerate);
    values.set_boolean(v.downlink.active, report.downlink.active);
    values.set_boolean(v.downlink.clamped, report.downlink.clamped);
    values.set_integer(v.timeline.command, i32::try_from(report.timeline_row).unwrap_or(i32::MAX));
    values.set_real(v.timeline.until, report.timeline_until_s.unwrap_or(-1.0));
}

/// Wheels, flexible modes, slosh.
fn write_wheels(context: &Plan<'_>, values: &mut Values, report: &Report<'_>) {
    let (v, summary) = (context.variables, &report.summary);
    for (k, variables) in v.wheel.iter().enumerate() {
        let Some(wheel) = summary.wheel(k) else { break };
        values.set_real(variables.momentum, wheel.momentum_n_m_s);
        values.set_real(variables.speed, wheel.speed_rad_s);
        values.set_real(variables.torque, wheel.torque_n_m);
        values.set_real(variables.power, wheel.power_w);
        values.set_boolean(variables.saturated, wheel.is_saturated);
    }
    for (k, mode) in v.flexible_mode.iter().enumerate() {
        values.set_real(mode.displacement, summary.mode_sqrt_kg_m(k));
    }
    for (k, slosh) in v.slosh.iter().enumerate() {
        values.set_vector(slosh.angle, summary.slosh_rad(k));
    }
}

/// Dumps and maneuvers.
fn write_dumps(context: &Plan<'_>, values: &mut Values, report: &Report<'_>) {
    let (v, summary) = (context.variables, &report.summary);
    let (dump, closest_s) = (&v.dump, summary.spacing.closest_s);
    values.set_boolean(dump.active, summary.is_dumping);
    values.set_integer(dump.count, summary.dumps.count);
    values.set_real(dump.last_time, summary.dumps.last.map_or(-1.0, |event| event.time_s));
    values.set_real(dump.closest, closest_s.unwrap_or(-1.0));
    let required_s = values.real(dump.required_spacing);
    values.set_boolean(dump.too_close, closest_s.is_some_and(|closest_s| closest_s < required_s));
    values.set_vector(dump.impulse, summary.dump_impulse_body_n_m_s.into());
    values.set_vector(dump.delta_v, summary.dump_delta_v_inertial_m_s.into());
    let (last_s, executed_m_s) = summary.maneuvers.last.unwrap_or((-1.0, Vector3::from([0.0; 3])));
    values.set_integer(v.maneuver.count, summary.maneuvers.count);
    values.set_real(v.maneuver.last_time, last_s);
    values.set_vector(v.maneuver.executed, executed_m_s.into());
}

/// Sensors and control.
fn write_sensors(context: &Plan<'_>, values: &mut Values, report: &Report<'_>) {
    let v = context.variables;
    let summary = &report.summary;
    values.set_vector(v.estimate.q, summary.estimate.attitude.unit_quaternion().0);
    values.set_vector(v.estimate.rate, summary.estimate.rate_body_rad_s.unwrap_or_default().into());
    values.set_boolean(v.estimate.valid, summary.estimate.is_valid);
    values.set_vector(v.sun.sensed, summary.sun_sensed_body.unwrap_or_default().into());
    values.set_boolean(v.sun.sensed_valid, summary.sun_sensed_body.is_some());
    values.set_vector(v.accelerometer.delta_v, summary.accelerometer_body_m_s.into());
    values.set_real(v.control.error, summary.control.error_rad);
    values.set_boolean(v.control.settled, summary.control.is_settled);
    values.set_boolean(v.control.saturated, summary.control.is_limited);
}

/// Thrusters and tanks.
fn write_thrusters(context: &Plan<'_>, values: &mut Values, report: &Report<'_>) {
    let (v, time_s, thrusters) = (context.variables, report.time_s, report.thrusters);
    let reaction_control = report.reaction_control;
    for (k, (thruster, variables)) in reaction_control.thrusters.iter().zip(&v.thruster).enumerate() {
        let thrust_n = thrusters.thrust_n(reaction_control, k, time_s);
        let hits = thrust_n > 0.0 && {
            let angle = |panel: usize| {
                let enabled = v.panel.get(panel).filter(|it| values.boolean(it.enabled));
                enabled.map(|it| values.real(it.angle_actual))
            };
            surface_in_plume(&context.setup.spacecraft, thruster, angle).is_some()
        };
        values.set_real(variables.thrust, thrust_n);
        let valves = &thrusters.valves;
        values.set_integer(variables.pulses, i32::try_from(valves.valves[k].pulses()).unwrap_or(i32::MAX));
        values.set_boolean(variables.too_short, valves.schedule[k].was_too_short());
        values.set_boolean(variables.plume, hits);
    }
    values.set_boolean(v.thrust.active, thrusters.valves.burning().is_some());
    let propellant = &thrusters.propellant;
    for (k, (tank, variables)) in reaction_control.tanks.iter().zip(&v.tank).enumerate() {
        let used_kg = propellant.used_kg(k, time_s);
        values.set_real(variables.propellant_left, tank.left_kg(used_kg));
        values.set_real(variables.pressure_actual, tank.pressure_pa(used_kg));
        values.set_boolean(variables.feeds, tank.feeds(used_kg));
    }
    values.set_real(v.propellant_used, propellant.total_used_kg(time_s));
}

/// Writes the faces that are reported one by one; those of disabled panels stay 0, and all while the flight waits.
fn write_faces(
    context: &Plan<'_>,
    values: &mut Values,
    flight: &mut Flight,
    prepared: PreparedSpacecraft<'_>,
    time_s: f64,
) -> Result<(), Failure> {
    let v = context.variables;
    if v.plate.is_empty() || flight.is_waiting() {
        return Ok(());
    }
    let mut faces = v.plate.iter().zip(&context.setup.reported_faces);
    let write = |temperature_k, force_body_n: Vector3<f64>| {
        let is_there = |panel: usize| v.panel.get(panel).is_none_or(|it| values.boolean(it.enabled));
        if let Some((plate, _)) = faces.find(|(_, face)| face.panel.is_none_or(is_there)) {
            values.set_real(plate.temperature, temperature_k);
            values.set_vector(plate.force, force_body_n.into());
        }
    };
    flight.faces(prepared, time_s, write).map_err(failure)
}

/// Writes the polynomial of the shade's torque.
pub(super) fn write_polynomial(context: &Plan<'_>, values: &mut Values, flight: &Flight) {
    let polynomial =
        context.setup.spacecraft.sunshade.as_ref().zip(flight.context()).and_then(|(shade, flown)| {
            let (configuration, materials) =
                (&flown.configuration, flown.models.solar.as_ref().map_or(&[][..], SolarModel::materials));
            let center_of_mass_body_m = &configuration.wet_mass.center_of_mass_body_m;
            TorquePolynomial::of_sunshade(shade, configuration.sunshade, materials, center_of_mass_body_m)
                .ok()
        });
    values.set_matrix(context.variables.sunshade.coefficient, polynomial.map_or([[0.0; 9]; 3], |p| p.k));
}

/// Refuses a flight inside the planet or the Sun, or without position.
pub(super) fn check(flight: &Flight, reached: &ReachedState, time_s: f64) -> Result<(), Failure> {
    if !reached.totals_are_finite {
        return Err(Failure::new(format!(
            "at {time_s} s momentum.inertial, momentum.body or deltaV is no finite number; see start.momentum, torque.applied, \
             force.applied, spacecraft.mass and spacecraft.centerOfMass"
        )));
    }
    flight.evaluation().map_or(Ok(()), |evaluation| evaluation.check(time_s).map_err(failure))
}

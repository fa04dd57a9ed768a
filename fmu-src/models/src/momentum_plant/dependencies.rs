//! What each output and calculated parameter depends on.

use fmi_export::{Dependencies, Knowns, knowns};

use super::setup::PlantSetup;
use super::variables::PlantVariables;
use crate::common::spacecraft::{
    across, can_shadow, has_both_shapes, inertia_about_others, inertia_along, shape_recoils_along,
    stores_heat_in_shadow, turns_out_of,
};

/// Inputs by what they act on. A command or an orbit given by inputs starts anew when any of its inputs changes, so all
/// of them act together; and the flight begins when orbit and Sun are no longer zero.
struct Inputs {
    /// Where spacecraft and Sun are.
    places: Knowns,
    /// How the spacecraft is turned: by command, or guided by where Sun, planet and Earth are.
    attitude: Knowns,
    panels: Knowns,
    /// Star tracker and gyros.
    sensors: Knowns,
    /// The torque that an internal controller asks of the wheels; none where the wheels cannot be in all directions.
    controller: Knowns,
}

impl Inputs {
    fn of(v: &PlantVariables) -> Self {
        let places = knowns![v.orbit.position, v.orbit.velocity, v.sun.position];
        let command = knowns![v.command.kind, v.command.q, v.command.rate, v.command.error];
        let attitude = knowns![&places, command, v.earth.position];
        let sensors = knowns![v.star_tracker.failed, v.gyro.failed];
        let failed = v.wheel.iter().map(|wheel| wheel.failed).collect::<Knowns>();
        let dump = knowns![v.dump.request, v.dump.target];
        let controller = knowns![&attitude, &sensors, failed, dump].only_if(can_control(v));
        let panels = v.panel.iter().map(|panel| panel.angle).collect();
        Self { places, attitude, panels, sensors, controller }
    }
}

/// Whether the wheels' axes, which are parameters, can be such that they span all directions.
fn can_control(v: &PlantVariables) -> bool {
    v.wheel.len() >= 3
}

/// Inputs and parameters by what they act on at the start.
struct Start {
    /// Whether the flight begins, or waits for orbit or Sun.
    begun: Knowns,
    /// The same without position and velocity.
    awaited: Knowns,
    /// Elements of the orbit and their frame, without the pole's right ascension.
    elements: Knowns,
    /// The right ascension of the pole turns the orbit about EME2000's Z axis.
    turned_about_z: Knowns,
    /// Where Sun and planets are.
    ephemeris: Knowns,
    /// Where the Sun is from the spacecraft.
    sun: Knowns,
    /// The same along Z of EME2000.
    sun_z: Knowns,
    attitude: Knowns,
    /// What the attitude's rate follows, but for command.rate.
    rate: Knowns,
    /// The orbit phase's own guidance, where it sets the start of a controlled flight.
    guided: Knowns,
    /// Of each panel.
    panels: Vec<Knowns>,
    momentum: Knowns,
    /// Momentum of body and wheels of controlled and free flight, without the inertia.
    turning: Knowns,
    /// What the estimated attitude follows besides the true one, and which.
    measured_attitude: Knowns,
}

impl Start {
    fn of(v: &PlantVariables) -> Self {
        let (orbit, ephemeris, guided, command) = (&v.orbit, &v.ephemeris, &v.guided, &v.command);
        let awaited = knowns![orbit.source, orbit.center, ephemeris.source, v.sun.position];
        let begun = knowns![&awaited, orbit.position, orbit.velocity];
        let shape = knowns![orbit.semi_major_axis, orbit.eccentricity, orbit.true_anomaly];
        let orientation = knowns![
            orbit.frame,
            orbit.inclination,
            orbit.ascending_node,
            orbit.periapsis_argument,
            v.planet.pole_declination,
        ];
        let elements = knowns![shape, orientation];
        let turned_about_z = knowns![v.planet.pole_right_ascension];
        let ephemeris = knowns![
            v.start.epoch,
            ephemeris.semi_major_axis,
            ephemeris.eccentricity,
            ephemeris.inclination,
            ephemeris.ascending_node,
            ephemeris.periapsis_argument,
            ephemeris.true_anomaly,
        ];
        let sun_z = knowns![&begun, &elements, &ephemeris];
        let sun = knowns![&sun_z, &turned_about_z];
        let schedule =
            knowns![guided.downlink_start, guided.downlink_end, guided.downlink_every, guided.slew_rate];
        let law = knowns![guided.science_rule, guided.science_gain, v.keep_in.elevation];
        let guidance = knowns![&sun, law, schedule, v.planet.gravitational_parameter, v.earth.position];
        // A command of zero is none.
        let sources = knowns![v.attitude.source, command.source];
        let rate = knowns![&guidance, &sources, command.kind, command.q, command.error];
        let guided = knowns![guidance, sources, v.start.q].only_if(can_control(v));
        let attitude = knowns![&rate, v.start.q];
        let panels = v
            .panel
            .iter()
            .map(|panel| knowns![panel.control, panel.sun_offset, panel.tilt, panel.enabled, panel.angle]);
        let dump = &v.dump;
        let momentum =
            knowns![v.start.momentum, dump.threshold, dump.reinit_to, dump.reinit_fraction, dump.target];
        let wheels = v.wheel.iter().map(|wheel| knowns![wheel.axis, wheel.start_momentum]);
        let turning = knowns![&begun, &guided, v.attitude.source, v.start.rate, wheels.collect::<Knowns>()];
        let tracker = &v.star_tracker;
        let measured_attitude = knowns![
            tracker.noise,
            tracker.failed,
            tracker.period,
            v.gyro.failed,
            v.noise.seed,
            v.control.rate,
        ];
        Self {
            begun,
            awaited,
            elements,
            turned_about_z,
            ephemeris,
            sun,
            sun_z,
            attitude,
            rate,
            guided,
            panels: panels.collect(),
            momentum,
            turning,
            measured_attitude,
        }
    }
}

/// One row an unknown.
pub fn table(setup: &PlantSetup, v: &PlantVariables) -> Dependencies {
    let mut table = Dependencies::new();
    let (inputs, start) = (&Inputs::of(v), &Start::of(v));
    motion(&mut table, v, inputs, start);
    light_and_loads(&mut table, setup, v, inputs, start);
    sensors(&mut table, v, inputs, start);
    momentum(&mut table, v, inputs, start);
    wheels_and_control(&mut table, v, inputs, start);
    craft(&mut table, setup, v, inputs, start);
    table
}

/// Orbit and attitude, Sun and Earth as they are seen.
fn motion(table: &mut Dependencies, v: &PlantVariables, inputs: &Inputs, start: &Start) {
    table.output(v.epoch, knowns![], v.start.epoch);
    let (orbit, gm) = (&v.orbit, v.planet.gravitational_parameter);
    for axis in 0..3 {
        let [position, velocity] = [orbit.position, orbit.velocity].map(|vector| vector.element(axis));
        let turned = &start.turned_about_z.clone().only_if(axis < 2);
        let position = knowns![&start.awaited, &start.elements, turned, orbit.velocity, position];
        let velocity = knowns![&start.awaited, &start.elements, turned, orbit.position, velocity, gm];
        let from_sun = if axis < 2 { &start.sun } else { &start.sun_z };
        table.output(v.position.element(axis), &inputs.places, position);
        table.output(v.velocity.element(axis), &inputs.places, velocity);
        table.output(v.heliocentric.position.element(axis), &inputs.places, from_sun);
        let rate = v.command.rate.element(axis);
        let others = knowns![v.command.kind, v.command.q, v.command.error, v.earth.position];
        let turned = &start.guided.clone().and(v.start.rate.element(axis));
        let at_start = &knowns![&start.rate, rate, turned];
        let at_step = &knowns![&inputs.places, others, rate];
        table.output(v.attitude.rate.element(axis), at_step, at_start);
        let gyro = knowns![v.gyro.bias.element(axis), v.gyro.noise, v.gyro.drift, v.gyro.failed];
        table.output(
            v.estimate.rate.element(axis),
            knowns![at_step, &inputs.sensors],
            knowns![at_start, gyro, v.noise.seed, v.control.rate],
        );
    }
    let orbit_given = &knowns![orbit.position, orbit.velocity];
    let sources = &knowns![orbit.source, orbit.center, v.ephemeris.source, orbit_given, &start.ephemeris];
    for axis in 0..3 {
        let [sun, earth] = [v.sun.position, v.earth.position].map(|it| it.element(axis));
        table.output(v.sun.position_inertial.element(axis), knowns![orbit_given, sun], knowns![sources, sun]);
        let seen = knowns![orbit_given, v.sun.position, earth];
        table.output(v.earth.position_inertial.element(axis), &seen, knowns![sources, &seen]);
    }
    table.output(v.sun.velocity_inertial, orbit_given, sources);
    table.output(v.earth.velocity_inertial, orbit_given, sources);
    let shape = knowns![orbit.semi_major_axis, orbit.eccentricity, orbit.true_anomaly];
    table.output(orbit.time_since_periapsis, &inputs.places, knowns![&start.begun, shape, gm]);
    table.output(v.sun.distance, &inputs.places, &start.sun);
    let eclipse = knowns![v.planet.radius, v.eclipse.method];
    table.output(v.sun.lit_fraction, &inputs.places, knowns![&start.sun, eclipse]);
    let seen = [
        knowns![v.attitude.q],
        knowns![v.sun.direction, v.sun.azimuth, v.sun.elevation, v.sun.position_body],
        knowns![v.planet.position_body],
        knowns![v.earth.azimuth, v.earth.elevation],
    ];
    for output in seen {
        table.output(output, &inputs.attitude, &start.attitude);
    }
    table.output(v.keep_in.margin, &inputs.attitude, knowns![&start.attitude, v.keep_in.azimuth]);
}

/// What star tracker, gyros and Sun sensors give, but for the rate.
fn sensors(table: &mut Dependencies, v: &PlantVariables, inputs: &Inputs, start: &Start) {
    table.output(
        v.estimate.q,
        knowns![&inputs.attitude, &inputs.sensors],
        knowns![&start.attitude, &start.measured_attitude],
    );
    // The first sample of controlled and free flight is valid.
    table.output(
        v.estimate.valid,
        knowns![&inputs.places, &inputs.sensors],
        knowns![&start.begun, v.attitude.source, v.star_tracker.failed],
    );
    let failed = v.sun_sensor.iter().map(|sensor| sensor.failed).collect::<Knowns>();
    let has_sensors = !v.sun_sensor.is_empty();
    let at_step = &knowns![&inputs.attitude, &failed].only_if(has_sensors);
    let fields = v.sun_sensor.iter().map(|sensor| knowns![sensor.axis, sensor.field_of_view]);
    let eclipse = knowns![v.planet.radius, v.eclipse.method];
    let solver = &v.solver;
    let linear = knowns![solver.dynamics_step, solver.disturbance_step, solver.disturbance_tolerance];
    let seen =
        &knowns![&start.attitude, failed, fields.collect::<Knowns>(), eclipse, linear].only_if(has_sensors);
    let noise = v.sun_sensor.iter().map(|sensor| sensor.noise).collect::<Knowns>();
    let drawn = knowns![noise, v.noise.seed, v.control.rate].only_if(has_sensors);
    table.output(v.sun.sensed_valid, at_step, seen);
    table.output(v.sun.sensed, at_step, knowns![seen, drawn]);
}

/// Force and torque by source, what they add up to, and faces one by one.
fn light_and_loads(
    table: &mut Dependencies,
    setup: &PlantSetup,
    v: &PlantVariables,
    inputs: &Inputs,
    start: &Start,
) {
    let spacecraft = &setup.spacecraft;
    let (torque, force, planet) = (&v.torque, &v.force, &v.planet);
    let surface = &planet.surface;

    let sunlight = &knowns![v.solar.flux, v.solar.fixed_pressure, v.solar.pressure];
    let eclipse = &knowns![planet.radius, v.eclipse.method];
    let shade = &knowns![v.sunshade.shape].only_if(has_both_shapes(spacecraft));
    let is_shadowed = can_shadow(spacecraft);
    let shadows = &knowns![v.shadowing.enabled].only_if(is_shadowed);
    let panels = &start.panels.iter().collect::<Knowns>();
    // Light and heat beyond plain sunlight are read from a polynomial over a stretch of flight; what else lies within its
    // tolerance is no dependence.
    let fitted = &knowns![v.solver.disturbance_step, v.solver.disturbance_tolerance];

    let over_planet = &knowns![sunlight, planet.radius, v.planet_light.enabled, v.planet_light.nodes];
    let reflected = &knowns![over_planet, surface.diffuse_reflectivity];
    let radiated = &knowns![
        over_planet,
        surface.absorptivity,
        surface.emissivity,
        surface.night_temperature,
        surface.day_temperature,
    ];
    // The same holds for all that acts in controlled and free flight, which is linear in time over an interval that ends
    // with the stretch of light.
    let linear = &knowns![fitted, v.solver.dynamics_step];
    let by_sun = &knowns![&start.attitude, sunlight, eclipse, shadows, linear];
    let solar = &knowns![by_sun, shade];
    let albedo = &knowns![&start.attitude, reflected, shade, linear];
    let infrared = &knowns![&start.attitude, radiated, shade, linear];
    let recoil = &knowns![by_sun, reflected, radiated, v.thermal.enabled];
    let all = &knowns![solar, albedo, infrared, recoil];

    let lit = &knowns![&inputs.attitude, &inputs.panels];
    let forces = [(force.by_source.albedo, albedo), (force.by_source.infrared, infrared), (force.total, all)];
    for (force, at_start) in forces {
        table.output(force, lit, knowns![at_start, panels]);
    }
    let storage = &knowns![v.thermal.storage].only_if(stores_heat_in_shadow(spacecraft));
    for axis in 0..3 {
        let turning = |k: &usize| turns_out_of(spacecraft, *k, axis);
        let angles = (0..v.panel.len()).filter(turning).map(|k| v.panel[k].angle).collect::<Knowns>();
        let turned = (0..v.panel.len()).filter(turning).map(|k| &start.panels[k]).collect::<Knowns>();
        let shape = knowns![v.sunshade.shape].only_if(shape_recoils_along(spacecraft, axis));
        table.output(
            force.by_source.thermal.element(axis),
            knowns![&inputs.attitude, angles],
            knowns![recoil, shape, &turned],
        );
        // Tilted the other way a panel takes as much light.
        let lit_alike =
            v.panel.iter().map(|panel| knowns![panel.control, panel.sun_offset, panel.enabled, panel.angle]);
        let at_start = knowns![solar, lit_alike.collect::<Knowns>(), turned];
        table.output(force.by_source.solar.element(axis), lit, at_start);
    }
    let torques = [
        (torque.by_source.solar, knowns![solar]),
        (torque.by_source.albedo, knowns![albedo]),
        (torque.by_source.infrared, knowns![infrared]),
        (torque.by_source.thermal, knowns![recoil, shade, storage]),
        (torque.total, knowns![all, storage]),
    ];
    for (torque, at_start) in torques {
        for axis in 0..3 {
            let center_of_mass = across(v.spacecraft.center_of_mass, axis);
            table.output(torque.element(axis), lit, knowns![&at_start, panels, center_of_mass]);
        }
    }
    for axis in 0..3 {
        let inertia = inertia_about_others(v.spacecraft.inertia, axis);
        let by_planet = knowns![v.gravity_gradient.enabled, planet.gravitational_parameter];
        let gradient = &knowns![&start.attitude, by_planet, inertia, linear];
        table.output(torque.by_source.gravity_gradient.element(axis), &inputs.attitude, gradient);
        let applied = &knowns![torque.applied.element(axis)];
        table.output(torque.total.element(axis), applied, knowns![applied, gradient]);
        let applied = &knowns![force.applied.element(axis)];
        table.output(force.total.element(axis), applied, applied);
    }
    let forced = &knowns![lit, force.applied];
    let at_start = &knowns![all, panels, force.applied];
    table.output(force.inertial, forced, at_start);
    table.output(v.acceleration, forced, knowns![at_start, v.spacecraft.mass]);
    table.output(v.delta_v, knowns![], knowns![]);

    for (plate, face) in v.plate.iter().zip(&setup.reported_faces) {
        let angles = face.lit_past.iter().filter_map(|&k| v.panel.get(k)).map(|panel| panel.angle);
        let lit = &knowns![&inputs.attitude, angles.collect::<Knowns>()];
        let panels = face.lit_past.iter().filter_map(|&k| start.panels.get(k)).collect::<Knowns>();
        let shadows = knowns![v.shadowing.enabled].only_if(face.shadowed);
        let stored = knowns![fitted].only_if(face.stores_heat);
        let at_start = &knowns![&start.attitude, sunlight, eclipse, shadows, reflected, radiated, panels];
        table.output(plate.temperature, lit, knowns![at_start, &stored]);
        for (axis, recoils) in face.recoils_along.into_iter().enumerate() {
            let recoil = knowns![v.thermal.enabled, &stored].only_if(recoils);
            table.output(plate.force.element(axis), lit, knowns![at_start, recoil]);
        }
    }
}

/// System momentum and dumps. A change of attitude can lift a component over its threshold, so that it is dumped at once.
fn momentum(table: &mut Dependencies, v: &PlantVariables, inputs: &Inputs, start: &Start) {
    let (momentum, dump) = (&v.momentum, &v.dump);
    let dumped = &knowns![&inputs.attitude, dump.request];
    let to_target = &knowns![dumped, dump.target];
    for axis in 0..3 {
        let [initial, threshold, target] =
            [v.start.momentum, dump.threshold, dump.target].map(|vector| vector.element(axis));
        let set = knowns![initial, threshold, target, dump.reinit_to, dump.reinit_fraction];
        let inertia = inertia_along(v.spacecraft.inertia, axis);
        let at_start = &knowns![&start.begun, set, &start.turning, inertia];
        table.output(momentum.body.element(axis), knowns![dumped, target], at_start);
        table.output(dump.impulse.element(axis), to_target, at_start);
    }
    let turning = &knowns![&start.turning, v.spacecraft.inertia];
    table.output(momentum.inertial, to_target, knowns![&start.attitude, &start.momentum, turning]);
    let exceeded = &knowns![&start.begun, v.start.momentum, dump.threshold, turning];
    table.output(dump.count, to_target, exceeded);
    table.output(dump.last_time, dumped, exceeded);
    table.output(dump.closest, to_target, knowns![]);
    table.output(dump.too_close, to_target, knowns![]);
    // Only in controlled and free flight, whose attitude follows guidance where the flight begins.
    let earth = knowns![v.earth.position].only_if(can_control(v));
    let requested = knowns![&inputs.places, earth, dump.request, dump.target];
    table.output(dump.active, requested, knowns![turning, dump.threshold]);
}

/// Wheels, and the controller that drives them.
fn wheels_and_control(table: &mut Dependencies, v: &PlantVariables, inputs: &Inputs, start: &Start) {
    let (control, dump, can_control) = (&v.control, &v.dump, can_control(v));
    let axes = &v.wheel.iter().map(|wheel| wheel.axis).collect::<Knowns>();
    // Ideal wheels hold what is left of the momentum; where the flight begins others hold what they start with.
    let dumped = knowns![&inputs.attitude, dump.request, dump.target].only_if(can_control);
    let held = &knowns![&inputs.places, dumped];
    let ideal = knowns![&start.rate, v.command.rate, v.spacecraft.inertia, &start.momentum, axes];
    let ideal = &ideal.only_if(can_control);

    let references = knowns![
        &start.begun,
        &start.guided,
        v.start.rate,
        knowns![v.command.kind, v.command.q, v.command.rate, v.command.error],
    ];
    let gains = knowns![
        control.bandwidth,
        control.damping,
        control.integral,
        control.slew_rate,
        control.slew_acceleration,
    ];
    let gyro = knowns![v.gyro.noise, v.gyro.drift, v.gyro.bias];
    let settled = &knowns![references, gains, &start.measured_attitude, gyro].only_if(can_control);
    let wheels = v.wheel.iter().map(|wheel| {
        let friction = knowns![wheel.coulomb_friction, wheel.viscous_friction, wheel.inertia];
        knowns![wheel.axis, wheel.start_momentum, wheel.failed, wheel.locked, wheel.max_torque, friction]
    });
    let shared = knowns![
        v.spacecraft.inertia,
        wheels.collect::<Knowns>(),
        control.allocation,
        control.balance_time,
        control.friction_compensation,
    ];
    let dumping = knowns![dump.torque, dump.threshold, dump.reinit_to, dump.reinit_fraction, dump.target];
    let controller = &knowns![settled, shared, dumping].only_if(can_control);
    for wheel in &v.wheel {
        let at_start = &knowns![&start.begun, v.attitude.source, wheel.start_momentum, ideal];
        table.output(wheel.momentum, held, at_start);
        table.output(wheel.speed, held, knowns![at_start, wheel.inertia]);
        table.output(wheel.saturated, held, knowns![at_start, wheel.capacity]);
        let commanded = knowns![wheel.torque_command, wheel.failed];
        let free = knowns![&start.begun, v.attitude.source, &commanded, wheel.max_torque];
        table.output(
            wheel.torque,
            knowns![&inputs.places, commanded, &inputs.controller],
            knowns![free, controller],
        );
    }
    let tracked = &knowns![&inputs.attitude, &inputs.sensors].only_if(can_control);
    let command = knowns![v.command.kind, v.command.q, v.command.error];
    let error = knowns![&start.begun, &start.guided, command, &start.measured_attitude];
    table.output(control.error, tracked, error.only_if(can_control));
    table.output(control.settled, tracked, settled);
    table.output(control.saturated, &inputs.controller, controller);

    let capacities = v.wheel.iter().map(|wheel| wheel.capacity).collect::<Knowns>();
    table.calculated(dump.guaranteed_threshold, knowns![capacities, axes].only_if(can_control));
}

/// The spacecraft itself.
fn craft(table: &mut Dependencies, setup: &PlantSetup, v: &PlantVariables, inputs: &Inputs, start: &Start) {
    let center_of_mass = v.spacecraft.center_of_mass;
    table.output(v.mass, knowns![], v.spacecraft.mass);
    for axis in 0..3 {
        table.output(v.center_of_mass.element(axis), knowns![], center_of_mass.element(axis));
    }
    for (panel, set) in v.panel.iter().zip(&start.panels) {
        let at_step = knowns![&inputs.attitude, panel.angle];
        table.output(panel.angle_actual, at_step, knowns![&start.attitude, set]);
    }
    let shaded = setup.spacecraft.sunshade.is_some();
    let shape = knowns![v.sunshade.shape].only_if(has_both_shapes(&setup.spacecraft));
    table.output(
        v.sunshade.polynomial_valid,
        inputs.attitude.clone().only_if(shaded),
        knowns![&start.attitude, &shape].only_if(shaded),
    );
    let polynomials = setup.polynomials();
    for (row, column) in (0..27).map(|at| (at / 9, at % 9)) {
        let moved = (0..3).filter(|&axis| polynomials.moves_coefficient(axis, row, column));
        let moved: Knowns = moved.map(|axis| center_of_mass.element(axis)).collect();
        let shape = shape.clone().only_if(polynomials.shapes_differ(row, column));
        table.calculated(v.sunshade.coefficient.element(row, column), knowns![moved, shape]);
    }
}

//! What each output and calculated parameter depends on.

use fmi_export::{Dependencies, Knowns, knowns};

use super::setup::PlantSetup;
use super::variables::PlantVariables;
use crate::common::spacecraft::{
    across, can_shadow, has_both_shapes, inertia_about_others, shape_recoils_along, stores_heat_in_shadow,
    turns_out_of,
};

/// Inputs by what they act on. A command or an orbit given by inputs starts anew when any of its inputs changes, so all
/// of them act together; and the flight begins when orbit and Sun are no longer zero.
struct Inputs {
    /// Where spacecraft and Sun are.
    places: Knowns,
    /// How the spacecraft is turned: by command, or guided by where Sun, planet and Earth are.
    attitude: Knowns,
    panels: Knowns,
}

impl Inputs {
    fn of(v: &PlantVariables) -> Self {
        let places = knowns![v.orbit.position, v.orbit.velocity, v.sun.position];
        let command = knowns![v.command.kind, v.command.q, v.command.rate, v.command.error];
        let attitude = knowns![&places, command, v.earth.position];
        Self { places, attitude, panels: v.panel.iter().map(|panel| panel.angle).collect() }
    }
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
    /// Of each panel.
    panels: Vec<Knowns>,
    momentum: Knowns,
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
        let rate = knowns![guidance, v.attitude.source, command.kind, command.q, command.error];
        let attitude = knowns![&rate, v.start.q];
        let panels = v
            .panel
            .iter()
            .map(|panel| knowns![panel.control, panel.sun_offset, panel.tilt, panel.enabled, panel.angle]);
        let dump = &v.dump;
        let momentum =
            knowns![v.start.momentum, dump.threshold, dump.reinit_to, dump.reinit_fraction, dump.target];
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
            panels: panels.collect(),
            momentum,
        }
    }
}

/// One row an unknown.
pub fn table(setup: &PlantSetup, v: &PlantVariables) -> Dependencies {
    let mut table = Dependencies::new();
    let (inputs, start) = (&Inputs::of(v), &Start::of(v));
    motion(&mut table, v, inputs, start);
    light_and_loads(&mut table, setup, v, inputs, start);
    momentum(&mut table, setup, v, inputs, start);
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
        table.output(
            v.attitude.rate.element(axis),
            knowns![&inputs.places, others, rate],
            knowns![&start.rate, rate],
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
    let past_shadows = fitted.clone().only_if(is_shadowed);
    let by_sun = &knowns![&start.attitude, sunlight, eclipse, shadows, past_shadows];
    let solar = &knowns![by_sun, shade];
    let albedo = &knowns![&start.attitude, reflected, shade, fitted];
    let infrared = &knowns![&start.attitude, radiated, shade, fitted];
    let recoil = &knowns![by_sun, reflected, radiated, fitted, v.thermal.enabled];
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
        let gradient =
            &knowns![&start.attitude, v.gravity_gradient.enabled, planet.gravitational_parameter, inertia];
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

/// System momentum, wheels and dumps. A change of attitude can lift a component over its threshold, so that it is dumped
/// at once.
fn momentum(
    table: &mut Dependencies,
    setup: &PlantSetup,
    v: &PlantVariables,
    inputs: &Inputs,
    start: &Start,
) {
    let (momentum, dump) = (&v.momentum, &v.dump);
    let dumped = &knowns![&inputs.attitude, dump.request];
    let to_target = &knowns![dumped, dump.target];
    for axis in 0..3 {
        let [initial, threshold, target] =
            [v.start.momentum, dump.threshold, dump.target].map(|vector| vector.element(axis));
        let at_start =
            &knowns![&start.begun, initial, threshold, target, dump.reinit_to, dump.reinit_fraction];
        table.output(momentum.body.element(axis), knowns![dumped, target], at_start);
        table.output(dump.impulse.element(axis), to_target, at_start);
    }
    table.output(momentum.inertial, to_target, knowns![&start.attitude, &start.momentum]);
    let exceeded = &knowns![&start.begun, v.start.momentum, dump.threshold];
    table.output(dump.count, to_target, exceeded);
    table.output(dump.last_time, dumped, exceeded);
    table.output(dump.closest, to_target, knowns![]);
    table.output(dump.too_close, to_target, knowns![]);

    let spanned = setup.wheel_array.is_some();
    let turning = knowns![&start.rate, v.command.rate, v.spacecraft.inertia];
    let at_step = &to_target.clone().only_if(spanned);
    let at_start = &knowns![turning, &start.momentum].only_if(spanned);
    for wheel in &v.wheel {
        table.output(wheel.momentum, at_step, at_start);
        let capacity = knowns![wheel.capacity].only_if(spanned);
        table.output(wheel.saturated, at_step, knowns![at_start, capacity]);
    }
    let capacities = v.wheel.iter().map(|wheel| wheel.capacity).collect::<Knowns>();
    table.calculated(dump.guaranteed_threshold, capacities.only_if(spanned));
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

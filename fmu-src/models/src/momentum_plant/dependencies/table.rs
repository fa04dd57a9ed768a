//! What each output and calculated parameter depends on.

use fmi_export::{Dependencies, Knowns, knowns};

use super::super::setup::PlantSetup;
use super::super::variables::PlantVariables;
use super::dynamics::{momentum, sensors, wheels_and_control};
use super::flexibility::swinging;
use super::groups::{Inputs, Start, panels_weigh, turned_by};
use super::propulsion::thrusters;
use crate::common::spacecraft::{
    across, can_shadow, has_both_shapes, inertia_about_others, shape_recoils_along, stores_heat_in_shadow,
    turns_out_of,
};

/// One row an unknown.
pub fn table(setup: &PlantSetup, v: &PlantVariables) -> Dependencies {
    let mut table = Dependencies::new();
    let (inputs, start) = (&Inputs::of(setup, v), &Start::of(setup, v));
    motion(&mut table, v, inputs, start);
    light_and_loads(&mut table, setup, v, inputs, start);
    sensors(&mut table, v, inputs, start);
    momentum(&mut table, v, inputs, start);
    wheels_and_control(&mut table, setup, v, inputs, start);
    swinging(&mut table, v, start);
    craft(&mut table, setup, v, inputs, start);
    thrusters(&mut table, setup, v, inputs, start);
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
        let others = knowns![v.command.kind, v.command.q, v.command.error];
        let turned = &start.guided.clone().and(v.start.rate.element(axis));
        let at_start = &knowns![&start.rate, rate, turned];
        let at_step = &knowns![&inputs.management, others, rate];
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

    let sunlight = &v.solar.knowns();
    let eclipse = &knowns![planet.radius, v.eclipse.method];
    let shade = &knowns![v.sunshade.shape].only_if(has_both_shapes(spacecraft));
    let is_shadowed = can_shadow(spacecraft);
    let shadows = &knowns![v.shadowing.enabled, v.shadowing.sun_disc].only_if(is_shadowed);
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
    // with the stretch of light, the body turning on through it.
    let linear = &knowns![fitted, v.solver.dynamics_step, v.start.rate];
    let by_sun = &knowns![&start.attitude, sunlight, eclipse, shadows, linear];
    let solar = &knowns![by_sun, shade];
    let albedo = &knowns![&start.attitude, reflected, shade, linear];
    let infrared = &knowns![&start.attitude, radiated, shade, linear];
    let recoil = &knowns![by_sun, reflected, radiated, v.thermal.recoil.enabled];
    let all = &knowns![solar, albedo, infrared, recoil];

    let lit = &knowns![&inputs.attitude, &inputs.panels];
    let forces = [(force.by_source.albedo, albedo), (force.by_source.infrared, infrared), (force.total, all)];
    for (force, at_start) in forces {
        table.output(force, lit, knowns![at_start, panels]);
    }
    let storage = &knowns![v.thermal.storage].only_if(stores_heat_in_shadow(spacecraft));
    for axis in 0..3 {
        let turning = |k: &usize| turns_out_of(spacecraft, *k, axis);
        let angles = (0..v.panel.len()).filter(turning).map(|k| turned_by(&v.panel[k])).collect::<Knowns>();
        let turned = (0..v.panel.len()).filter(turning).map(|k| &start.panels[k]).collect::<Knowns>();
        let shape = knowns![v.sunshade.shape].only_if(shape_recoils_along(spacecraft, axis));
        table.output(
            force.by_source.thermal.element(axis),
            knowns![&inputs.attitude, angles],
            knowns![recoil, shape, &turned],
        );
        // Tilted the other way a panel takes as much light.
        let lit_alike = v
            .panel
            .iter()
            .map(|panel| knowns![panel.control, panel.sun_offset, panel.enabled, turned_by(panel)]);
        let at_start = knowns![solar, lit_alike.collect::<Knowns>(), turned];
        table.output(force.by_source.solar.element(axis), lit, at_start);
    }
    let weight = &knowns![&start.weight, v.spacecraft.center_of_mass].only_if(panels_weigh(setup));
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
            table.output(torque.element(axis), lit, knowns![&at_start, panels, center_of_mass, weight]);
        }
    }
    for axis in 0..3 {
        let inertia = inertia_about_others(v.spacecraft.inertia, axis);
        let by_planet = knowns![v.gravity_gradient.enabled, planet.gravitational_parameter];
        let gradient = &knowns![&start.attitude, by_planet, inertia, linear, weight];
        let at_step = knowns![&inputs.attitude, &inputs.weight];
        table.output(torque.by_source.gravity_gradient.element(axis), at_step, gradient);
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
        let angles = face.lit_past.iter().filter_map(|&k| v.panel.get(k)).map(turned_by);
        let lit = &knowns![&inputs.attitude, angles.collect::<Knowns>()];
        let panels = face.lit_past.iter().filter_map(|&k| start.panels.get(k)).collect::<Knowns>();
        let shadows = knowns![v.shadowing.enabled, v.shadowing.sun_disc].only_if(face.shadowed);
        let stored = linear.clone().only_if(face.stores_heat);
        let at_start = &knowns![&start.attitude, sunlight, eclipse, shadows, reflected, radiated, panels];
        table.output(plate.temperature, lit, knowns![at_start, &stored]);
        for (axis, recoils) in face.recoils_along.into_iter().enumerate() {
            let recoil = knowns![v.thermal.recoil.enabled, &stored].only_if(recoils);
            table.output(plate.force.element(axis), lit, knowns![at_start, recoil]);
        }
    }
}

/// The spacecraft itself.
fn craft(table: &mut Dependencies, setup: &PlantSetup, v: &PlantVariables, inputs: &Inputs, start: &Start) {
    let center_of_mass = v.spacecraft.center_of_mass;
    table.output(v.mass, knowns![], v.spacecraft.mass);
    for axis in 0..3 {
        let at_start = knowns![center_of_mass.element(axis), &start.weight];
        table.output(v.center_of_mass.element(axis), &inputs.weight, at_start);
    }
    for (panel, set) in v.panel.iter().zip(&start.panels) {
        let at_step = knowns![&inputs.attitude, turned_by(panel)];
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

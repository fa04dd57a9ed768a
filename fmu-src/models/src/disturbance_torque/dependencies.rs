//! What each output depends on. There is no memory: at a step the same inputs count as at the start. Nothing acts while the
//! Sun is at zero.

use fmi_export::{Dependencies, Knowns, knowns};

use super::setup::DisturbanceSetup;
use super::variables::DisturbanceVariables;
use crate::common::spacecraft::{
    across, can_shadow, has_both_shapes, inertia_about_others, shape_recoils_along, turns_out_of,
};

/// One row an output.
pub fn table(setup: &DisturbanceSetup, v: &DisturbanceVariables) -> Dependencies {
    let spacecraft = &setup.spacecraft;
    let (light, planet, torque, force) = (&v.planet_light, &v.planet, &v.torque, &v.force);

    // Inputs.
    let places = &knowns![v.sun.position_body, planet.position_body];
    let panels = &v.panel.iter().map(|panel| panel.angle).collect::<Knowns>();
    let sunlit = &knowns![places, panels];
    let planet_lit = &knowns![sunlit, planet.pole];

    // Parameters.
    let shade = &knowns![v.sunshade.shape].only_if(has_both_shapes(spacecraft));
    let shadows = &knowns![v.shadowing.enabled, v.shadowing.sun_disc].only_if(can_shadow(spacecraft));
    let eclipse = &knowns![planet.present, planet.radius, v.eclipse.method];
    let by_sun = &knowns![v.solar.flux, eclipse, shadows];
    let over_planet = &knowns![
        v.solar.flux,
        planet.present,
        planet.radius,
        light.rings.enabled,
        light.method,
        light.belts,
        light.rings.nodes,
    ];
    let surface = &planet.surface;
    let reflecting = &knowns![over_planet, surface.diffuse_reflectivity];
    let radiating = &knowns![
        over_planet,
        surface.absorptivity,
        surface.emissivity,
        surface.night_temperature,
        surface.day_temperature,
    ];
    let recoil = &knowns![by_sun, reflecting, radiating, v.thermal.enabled];

    let mut table = Dependencies::new();
    table.output(v.sun.lit_fraction, places, knowns![places, eclipse]);
    for axis in 0..3 {
        let panels = v.panel.iter().enumerate().filter(|(k, _)| turns_out_of(spacecraft, *k, axis));
        let panels = panels.map(|(_, panel)| panel.angle).collect::<Knowns>();
        let inputs = &knowns![places, planet.pole, panels];
        let shape = knowns![v.sunshade.shape].only_if(shape_recoils_along(spacecraft, axis));
        table.output(force.by_source.thermal.element(axis), inputs, knowns![inputs, recoil, shape]);
    }
    let forces = [
        (force.by_source.solar, sunlit, by_sun),
        (force.by_source.albedo, planet_lit, reflecting),
        (force.by_source.infrared, planet_lit, radiating),
        (force.total, planet_lit, recoil),
    ];
    for (force, inputs, parameters) in forces {
        table.output(force, inputs, knowns![inputs, parameters, shade]);
    }
    let torques = [
        (torque.by_source.solar, sunlit, by_sun),
        (torque.by_source.albedo, planet_lit, reflecting),
        (torque.by_source.infrared, planet_lit, radiating),
        (torque.by_source.thermal, planet_lit, recoil),
        (torque.total, planet_lit, recoil),
    ];
    for (torque, inputs, parameters) in torques {
        for axis in 0..3 {
            let inputs = &knowns![inputs, across(v.spacecraft.center_of_mass, axis)];
            table.output(torque.element(axis), inputs, knowns![inputs, parameters, shade]);
        }
    }
    for axis in 0..3 {
        let inertia = inertia_about_others(v.spacecraft.inertia, axis);
        let by_planet = knowns![v.gravity_gradient.enabled, planet.gravitational_parameter];
        let gradient = &knowns![planet.present, by_planet, inertia];
        let at_start = knowns![places, gradient];
        table.output(torque.by_source.gravity_gradient.element(axis), places, at_start);
        table.output(torque.total.element(axis), knowns![], gradient);
    }
    for (plate, face) in v.plate.iter().zip(&setup.reported_faces) {
        let panels = face.lit_past.iter().filter_map(|&k| v.panel.get(k)).map(|panel| panel.angle);
        let inputs = &knowns![places, planet.pole, panels.collect::<Knowns>()];
        let shadows = knowns![v.shadowing.enabled, v.shadowing.sun_disc].only_if(face.shadowed);
        let parameters = &knowns![v.solar.flux, eclipse, reflecting, radiating, shadows, shade];
        table.output(plate.temperature, inputs, knowns![inputs, parameters]);
        for (axis, recoils) in face.recoils_along.into_iter().enumerate() {
            let recoil = knowns![v.thermal.enabled].only_if(recoils);
            table.output(plate.force.element(axis), inputs, knowns![inputs, parameters, recoil]);
        }
    }
    table
}

//! Dependencies of each output, by groups. There is no memory: in steps the same inputs count as at the start.

use fmi_export::{Dependencies, knowns};
use physics::loads::Switch;
use physics::plant::REFLECTED_LIGHT;

use super::setup::DisturbanceSetup;
use super::variables::DisturbanceVariables;

/// Rows by groups of outputs.
pub(super) fn table(_setup: &DisturbanceSetup, v: &DisturbanceVariables) -> Dependencies {
    let (torque, force) = (&v.torque, &v.force);
    let places = &knowns![v.sun.position_body, v.planet.position_body];
    let lit = &knowns![places, v.planet.pole, &v.panel];
    let eclipse = &knowns![&v.planet, v.sun.radius, &v.eclipse];
    let light = &knowns![eclipse, &v.solar, &v.planet_light, &v.thermal, &v.shadowing, v.sunshade_shape];
    let laws = &knowns![&v.planet, &v.laws, &v.spacecraft];
    let planet_geometry = &knowns![places, v.planet.pole];
    // Surfaces in air are as warm as light makes them.
    let aerodynamic = &knowns![lit, v.spacecraft.center_of_mass, &v.atmosphere];
    let air = &knowns![light, laws];
    let field = &knowns![v.magnetic_field_body];
    let on_torque = (&knowns![lit, v.spacecraft.center_of_mass], &knowns![light, laws]);

    let mut table = Dependencies::new();
    table.output(v.sun.lit_fraction, places, eclipse);
    let heated = &knowns![light, v.optics.light_and_heat()];
    table.output(&v.plate, lit, heated);
    let quantities =
        [(&torque.by_source, torque.total, on_torque), (&force.by_source, force.total, (lit, light))];
    for (by_source, total, of_light) in quantities {
        for (effect, output) in by_source.iter() {
            let (at_steps, at_start) = match effect {
                effect if effect.row().switch == Some(Switch::Aerodynamics) => {
                    (aerodynamic, &knowns![air, &v.optics])
                }
                effect if effect.is_in_field() => (field, laws),
                effect if REFLECTED_LIGHT.contains(&effect) => {
                    (of_light.0, &knowns![of_light.1, v.optics.light()])
                }
                effect if effect.is_light() => (of_light.0, &knowns![of_light.1, v.optics.light_and_heat()]),
                _ => (planet_geometry, laws),
            };
            table.output(knowns![output, total], at_steps, at_start);
        }
    }
    table
}

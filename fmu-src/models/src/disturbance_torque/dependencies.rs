//! What each output depends on, by groups. There is no memory: in steps the same inputs count as at the start.

use fmi_export::{Dependencies, knowns};

use super::setup::DisturbanceSetup;
use super::variables::DisturbanceVariables;

/// Rows by groups of outputs.
pub fn table(_setup: &DisturbanceSetup, v: &DisturbanceVariables) -> Dependencies {
    let (torque, force) = (&v.torque, &v.force);
    let places = &knowns![v.sun.position_body, v.planet.position_body];
    let lit = &knowns![places, v.planet.pole, &v.panel];
    let eclipse = &knowns![&v.planet, v.sun.radius, &v.eclipse];
    let light = &knowns![eclipse, &v.solar, &v.planet_light, &v.thermal, &v.shadowing, &v.sunshade];
    let gradient = &knowns![&v.planet, &v.gravity_gradient, &v.spacecraft];

    let mut table = Dependencies::new();
    table.output(v.sun.lit_fraction, places, eclipse);
    table.output(knowns![force, &v.plate], lit, light);
    table.output(torque.by_source.gravity_gradient, places, gradient);
    let torque = knowns![
        torque.by_source.solar,
        torque.by_source.albedo,
        torque.by_source.infrared,
        torque.by_source.thermal,
        torque.total,
    ];
    table.output(torque, knowns![lit, v.spacecraft.center_of_mass], knowns![light, gradient]);
    table
}

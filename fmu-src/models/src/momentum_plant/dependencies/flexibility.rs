//! What flexible modes, propellant and rotors out of balance depend on, and what depends on them.

use fmi_export::{Dependencies, Knowns, knowns};

use super::super::variables::PlantVariables;
use super::groups::Start;
use crate::common::spacecraft::across;

/// Modes and propellant are at rest where the flight begins; rotors out of balance push and turn the body from there on, and
/// propellant does where a force moves it.
pub fn swinging(table: &mut Dependencies, v: &PlantVariables, start: &Start) {
    for mode in &v.flexible_mode {
        table.output(mode.displacement, knowns![], knowns![]);
    }
    for slosh in &v.slosh {
        table.output(slosh.angle, knowns![], knowns![]);
    }
    let wheels = v
        .wheel
        .iter()
        .map(|wheel| knowns![wheel.axis, wheel.start_momentum, wheel.inertia, wheel.static_imbalance]);
    let turning = knowns![&start.begun, v.attitude.source, wheels.collect::<Knowns>()];
    let force = &turning.only_if(!v.wheel.is_empty());
    for axis in 0..3 {
        let places = v.wheel.iter().map(|wheel| knowns![across(wheel.position, axis)]).collect::<Knowns>();
        let center_of_mass = across(v.spacecraft.center_of_mass, axis);
        let levers = knowns![places, center_of_mass].only_if(!v.wheel.is_empty());
        // Propellant aside of its axis turns the body by the force across.
        let aside = across(v.force.applied, axis).only_if(!v.slosh.is_empty());
        table.output(v.torque.total.element(axis), aside, knowns![force, &levers]);
    }
    table.output(v.force.total, knowns![], force);
    table.output(v.force.inertial, knowns![], force);
    table.output(v.acceleration, knowns![], knowns![force]);
}

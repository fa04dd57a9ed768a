//! How a master cuts its steps, and whether it saves and restores in between, changes no bit of any output: through
//! eclipses, slews, dumps and the cells of a disturbed orbit.

use models::MomentumPlant;

use super::named_model::{NamedModel, assert_cuts_change_nothing, assert_same};
use super::plant_light::SHADOWED;

/// Everything on, and dumps often.
const ALL: &[(&str, f64)] = &[
    ("orbit.dynamics", 2.0),
    ("guided.slewRate", 3e-3),
    ("guided.downlinkEvery", 1.0),
    ("dump.threshold[1]", 0.1),
    ("dump.threshold[2]", 0.1),
    ("dump.threshold[3]", 0.1),
];

fn sets() -> Vec<(&'static str, f64)> {
    [ALL, SHADOWED].concat()
}

#[test]
fn neither_cuts_nor_saving_change_a_bit() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let (mut shaded, mut dumps) = (0, 0);
    let initialize = || named.initialize(0.0, &sets()).unwrap();
    let ends_s = (1..=48).map(|hour| 3600.0 * f64::from(hour));
    assert_cuts_change_nothing(initialize, ends_s, &[130.0, 60.0, 97.3], |flight| {
        shaded += i32::from(flight.real("sun.litFraction") == 0.0);
        dumps = flight.integer("dump.count");
    });
    assert!(shaded > 0 && dumps > 3, "{shaded} {dumps}");
}

#[test]
fn setting_what_was_set_changes_nothing_and_a_new_value_does() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let mut held = named.initialize(0.0, &sets()).unwrap();
    let mut pushed = named.initialize(0.0, &sets()).unwrap();
    held.simulate_to(5_000.0, 500.0).unwrap();
    while pushed.time_s() < 5_000.0 {
        let end_s = pushed.time_s() + 250.0;
        // To another value and back, and to the same value.
        pushed.set("torque.applied[2]", 0.1);
        pushed.set("torque.applied[2]", 0.0);
        pushed.set("force.applied[1]", 0.0);
        pushed.set("spacecraft.centerOfMass[3]", held.real("spacecraft.centerOfMass[3]"));
        pushed.step_to(end_s).unwrap();
    }
    assert_same(&held, &pushed);
    pushed.set("force.applied[1]", 1.0);
    held.simulate_to(10_000.0, 500.0).unwrap();
    pushed.simulate_to(10_000.0, 500.0).unwrap();
    // 1 N on half a ton for 5000 s, about Mercury: the same order as the free motion 1/2 a t^2.
    let moved_m = (held.vector("position") - pushed.vector("position")).norm();
    assert!((0.3..3.0).contains(&(moved_m / (0.5 * 5_000.0 * 5_000.0 / held.real("mass")))), "{moved_m}");
}

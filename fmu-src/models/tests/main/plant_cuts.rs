//! How a master cuts its steps, and whether it saves and restores in between, changes no bit of any output: through
//! eclipses, slews, dumps and the cells of a disturbed orbit.

use models::MomentumPlant;

use super::named_model::{NamedModel, assert_same};

const DAY_S: f64 = 86_400.0;

/// Everything on, and dumps often.
const ALL: &[(&str, f64)] = &[
    ("orbit.dynamics", 2.0),
    ("guided.slewRate", 3e-3),
    ("guided.downlinkEvery", 1.0),
    ("dump.threshold[1]", 0.1),
    ("dump.threshold[2]", 0.1),
    ("dump.threshold[3]", 0.1),
];

/// A day on which the orbit's plane holds the Sun.
const SHADOWED: &[(&str, f64)] =
    &[("ephemeris.source", 2.0), ("ephemeris.trueAnomaly", 1.7), ("orbit.frame", 1.0)];

fn sets() -> Vec<(&'static str, f64)> {
    [ALL, SHADOWED].concat()
}

#[test]
fn the_cut_changes_no_bit() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let mut coarse = named.fly(0.0, &sets()).unwrap();
    let mut fine = named.fly(0.0, &sets()).unwrap();
    let mut odd = named.fly(0.0, &sets()).unwrap();
    let mut shaded = 0;
    while coarse.time_s() < 2.0 * DAY_S {
        let end_s = coarse.time_s() + 3600.0;
        coarse.step_to(end_s).unwrap();
        fine.fly_to(end_s, 60.0).unwrap();
        odd.fly_to(end_s, 97.3).unwrap();
        assert_same(&coarse, &fine);
        assert_same(&coarse, &odd);
        shaded += i32::from(coarse.real("sun.litFraction") == 0.0);
    }
    assert!(shaded > 0 && coarse.integer("dump.count") > 3, "{shaded} {}", coarse.integer("dump.count"));
}

#[test]
fn a_restored_flight_goes_on_to_the_bit() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let mut whole = named.fly(0.0, &sets()).unwrap();
    let mut relay = named.fly(0.0, &sets()).unwrap();
    let mut shaded = 0;
    while whole.time_s() < DAY_S {
        let end_s = whole.time_s() + 130.0;
        whole.step_to(end_s).unwrap();
        relay = relay.restored();
        relay.step_to(end_s).unwrap();
        assert_same(&whole, &relay);
        shaded += i32::from(whole.real("sun.litFraction") < 1.0);
    }
    assert!(shaded > 0);
}

#[test]
fn setting_what_was_set_changes_nothing_and_a_new_value_does() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let mut held = named.fly(0.0, &sets()).unwrap();
    let mut pushed = named.fly(0.0, &sets()).unwrap();
    held.fly_to(5_000.0, 500.0).unwrap();
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
    held.fly_to(10_000.0, 500.0).unwrap();
    pushed.fly_to(10_000.0, 500.0).unwrap();
    // 1 N on half a ton for 5000 s, about Mercury: the same order as the free motion 1/2 a t^2.
    let moved_m = (held.vector("position") - pushed.vector("position")).norm();
    assert!((0.3..3.0).contains(&(moved_m / (0.5 * 5_000.0 * 5_000.0 / held.real("mass")))), "{moved_m}");
}

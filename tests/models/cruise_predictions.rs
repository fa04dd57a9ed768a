//! Predictions of an encounter are what the flight then does, as long as inputs and timeline stay.

use client::short_or_long;
use models::MomentumPlant;
use nalgebra::Vector3;
use physics::constants::DAY_S;

use super::cruise::{AHEAD_S, FLYBY_S, sets, start};
use super::named_model::{NamedInstance, NamedModel, assert_cuts_change_nothing};

const LEAD_S: f64 = 21_600.0;

/// A flyby at 200 km in ten days, light pushing the spacecraft, and predictions.
fn predicting(refresh_s: f64) -> Vec<(&'static str, f64)> {
    [&sets(&start(2e5, 0.0), true)[..], &[("prediction.refresh", refresh_s)]].concat()
}

/// Arrival, altitude, B.T, B.R, speed far away.
fn predicted(flight: &NamedInstance<'_, MomentumPlant>) -> [f64; 5] {
    assert!(flight.boolean("prediction.valid"));
    ["arrival", "altitude", "bT", "bR", "excessSpeed"].map(|name| flight.real(&format!("prediction.{name}")))
}

/// The same as the flight has it, which is before `arrival_s` by more than the lead.
fn simulated(flight: &mut NamedInstance<'_, MomentumPlant>, arrival_s: f64) -> [f64; 5] {
    flight.step_to(arrival_s - LEAD_S).unwrap();
    let hyperbola = ["bT", "bR", "excessSpeed"].map(|name| flight.real(&format!("encounter.{name}")));
    flight.step_to(arrival_s + 3600.0).unwrap();
    let [arrival_s, altitude_m] =
        ["lastTime", "lastAltitude"].map(|name| flight.real(&format!("encounter.{name}")));
    let [b_t_m, b_r_m, speed_m_s] = hyperbola;
    [arrival_s, altitude_m, b_t_m, b_r_m, speed_m_s]
}

#[test]
fn what_is_predicted_comes_to_the_bit() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let mut flight = named.initialize(0.0, &predicting(2.5 * DAY_S)).unwrap();
    let first = predicted(&flight);
    assert_eq!(flight.real("prediction.since"), 0.0);
    assert_eq!(flight.real("prediction.epoch"), FLYBY_S - AHEAD_S + (first[0] - LEAD_S));
    for (days, since_days) in [(1.0, 0.0), (2.5, 0.0), (3.0, 2.5), (7.6, 7.5)] {
        flight.step_to(days * DAY_S).unwrap();
        assert_eq!(flight.real("prediction.since"), since_days * DAY_S);
        assert_eq!(predicted(&flight), first);
    }
    assert_eq!(simulated(&mut flight, first[0]), first);
    // Light is in it.
    let without = [&predicting(2.5 * DAY_S)[..], &[("orbit.radiationFeedback", 0.0)]].concat();
    let other = predicted(&named.initialize(0.0, &without).unwrap());
    assert!((other[2] - first[2]).hypot(other[3] - first[3]) > 1e3);
}

#[test]
fn maneuvers_ahead_count_and_inputs_are_held() {
    let events = "[[event]]\nat = \"2008-09-29T08:40:00 TDB\"\nmaneuver = { deltaV = [0.3, 0.1, -0.2], dump = false }\n[[panels]]\n\
                  at = \"2008-10-01T00:00:00 TDB\"\nsunOffset = \"40 deg\"\n";
    let named = NamedModel::<MomentumPlant>::shipped().with_schedule("timeline.toml", events);
    let plain =
        predicted(&NamedModel::<MomentumPlant>::shipped().initialize(0.0, &predicting(DAY_S)).unwrap());
    let mut flight = named.initialize(0.0, &predicting(DAY_S)).unwrap();
    let first = predicted(&flight);
    // 0.37 m/s over seven days.
    assert!((1e5..4e5).contains(&(first[2] - plain[2]).hypot(first[3] - plain[3])), "{first:?} {plain:?}");
    flight.step_to(1.5 * DAY_S).unwrap();
    assert_eq!(predicted(&flight), first);
    // A force, and a maneuver at the very time of a prediction.
    flight.step_to(2.0 * DAY_S).unwrap();
    flight.set_elements("force.applied", &[2e-5, 0.0, 1e-5]);
    flight.set("maneuver.request", 1.0);
    flight.set_elements("maneuver.deltaV", &[0.0, 0.05, 0.0]);
    flight.step_to(2.1 * DAY_S).unwrap();
    assert_eq!(flight.integer("maneuver.count"), 1);
    let with_inputs = predicted(&flight);
    assert!((with_inputs[2] - first[2]).hypot(with_inputs[3] - first[3]) > 1e4);
    assert_eq!(simulated(&mut flight, with_inputs[0]), with_inputs);
    assert_eq!(flight.integer("maneuver.count"), 2);
}

#[test]
fn neither_cuts_nor_saving_change_a_bit_of_them() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let sets = predicting(1.3 * DAY_S);
    let mut since_s = Vec::new();
    let begin = || named.initialize(0.0, &sets).unwrap();
    let ends_s = [1.3, 5.0, 9.9, 10.002, 10.5].map(|day| day * DAY_S);
    assert_cuts_change_nothing(begin, ends_s, &[short_or_long(43_200.0, 10_800.0), 3.0 * DAY_S], |flight| {
        since_s.push(flight.real("prediction.since"));
    });
    since_s.dedup();
    assert_eq!(since_s, [0.0, 3.0, 7.0, 8.0].map(|number| number * (1.3 * DAY_S)));
}

#[test]
fn without_an_approach_there_is_none() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let short = [&predicting(3.0 * DAY_S)[..], &[("prediction.horizon", 8.0 * DAY_S)]].concat();
    let mut flight = named.initialize(0.0, &short).unwrap();
    let none = |flight: &NamedInstance<'_, MomentumPlant>| {
        assert!(!flight.boolean("prediction.valid"));
        assert_eq!(flight.real("prediction.arrival"), -1.0);
        for name in ["altitude", "bT", "bR", "excessSpeed", "epoch"] {
            assert_eq!(flight.real(&format!("prediction.{name}")), 0.0, "{name}");
        }
    };
    none(&flight);
    assert_eq!(flight.real("prediction.since"), 0.0);
    flight.step_to(4.0 * DAY_S).unwrap();
    predicted(&flight);
    flight.step_to(13.0 * DAY_S).unwrap();
    assert_eq!(flight.real("prediction.since"), 12.0 * DAY_S);
    none(&flight);
    // None is requested, and none possible.
    let flight = named.initialize(0.0, &sets(&start(2e5, 0.0), true)).unwrap();
    none(&flight);
    assert_eq!(flight.real("prediction.since"), -1.0);
    assert!(!named.warnings().iter().any(|it| it.contains("prediction.refresh")));
    let flight = named.initialize(0.0, &[("prediction.refresh", 10.0)]).unwrap();
    assert_eq!(flight.real("prediction.since"), -1.0);
    assert!(named.warnings().iter().any(|it| it.contains("prediction.refresh") && it.contains("nBody")));
}

#[test]
fn within_the_lead_it_is_the_present_hyperbola() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let mut flight = named.initialize(0.0, &predicting(AHEAD_S - 2.0 * 3600.0)).unwrap();
    let first = predicted(&flight);
    let now_s = AHEAD_S - 2.0 * 3600.0;
    flight.step_to(now_s).unwrap();
    let present = ["encounter.bT", "encounter.bR"].map(|name| flight.real(name));
    flight.step_to(now_s + 60.0).unwrap();
    let late = predicted(&flight);
    assert_eq!(late[..2], first[..2]);
    assert_eq!(late[2..4], present);
    assert_eq!(flight.real("prediction.epoch"), FLYBY_S - 2.0 * 3600.0);
}

#[test]
fn a_path_into_the_planet_arrives_where_it_hits() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let falling = [&sets(&start(1.0, 0.5), false)[..], &[("prediction.refresh", DAY_S)]].concat();
    let mut flight = named.initialize(0.0, &falling).unwrap();
    flight.step_to(9.0 * DAY_S).unwrap();
    let [arrival_s, altitude_m, b_t_m, b_r_m, _] = predicted(&flight);
    assert_eq!(altitude_m, 0.0);
    let error = flight.step_to(11.0 * DAY_S).unwrap_err().to_string();
    let hit_s: f64 = error.split("at ").nth(1).unwrap().split(' ').next().unwrap().parse().unwrap();
    assert!((hit_s - arrival_s).abs() < 1e-3, "{error} {arrival_s}");
    // Less than what the planet's gravity draws in.
    assert!(b_t_m.hypot(b_r_m) < 3.2e6);
}

#[test]
fn in_flight_by_torque_the_command_is_followed_ideally() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let q = [0.1, -0.2, 0.3, 0.927_361_849_549_570_3];
    let turned = |source: f64| {
        let mut sets = predicting(600.0);
        sets.extend([("attitude.source", source)]);
        for (name, value) in ["command.q[1]", "command.q[2]", "command.q[3]", "command.q[4]"].iter().zip(q) {
            sets.push((name, value));
        }
        let mut flight = named.initialize(0.0, &sets).unwrap();
        flight.step_to(601.0).unwrap();
        assert_eq!(flight.real("prediction.since"), 600.0);
        Vector3::from_row_slice(&predicted(&flight)[1..4])
    };
    let [commanded, controlled] = [turned(2.0), turned(3.0)];
    // The controller's swing of ten minutes moves the spacecraft by less than a metre in ten days.
    assert!((commanded - controlled).norm() < 10.0, "{commanded} {controlled}");
    let controlled = [&predicting(100.0)[..], &[("attitude.source", 3.0), ("command.source", 2.0)]].concat();
    let begin = || named.initialize(0.0, &controlled).unwrap();
    assert_cuts_change_nothing(begin, [200.0, 350.0], &[50.0, 133.0], |flight| {
        assert!(flight.boolean("prediction.valid"));
    });
    let mut free = predicting(600.0);
    free.extend([("attitude.source", 4.0), ("start.q[1]", q[0]), ("start.q[2]", q[1])]);
    free.extend([("start.q[3]", q[2]), ("start.q[4]", q[3])]);
    let held = predicted(&named.initialize(0.0, &free).unwrap());
    assert!((Vector3::from_row_slice(&held[1..4]) - commanded).norm() < 10.0, "{held:?} {commanded}");
}

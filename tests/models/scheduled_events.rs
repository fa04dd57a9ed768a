//! Scheduled events happen at their very time, once, whatever the steps; in controlled and free flight dumps alone may.

use client::short_or_long;
use models::MomentumPlant;
use nalgebra::Vector3;

use super::maneuvers::{ERRORS, MESSENGER_FULL, full};
use super::named_model::{NamedModel, assert_cuts_change_nothing, assert_same};

/// An item of `[[event]]`; Rust writes numbers as TOML reads them.
fn event(at_s: f64, what: &str) -> String {
    format!("[[event]]\nat = {at_s:?}\n{what}\n")
}

fn dump(at_s: f64) -> String {
    event(at_s, "dump = true")
}

fn dump_to(at_s: f64, momentum: [f64; 3]) -> String {
    event(at_s, &format!("dump = {momentum:?}"))
}

fn maneuver(at_s: f64, delta_v: [f64; 3], dumps: bool) -> String {
    event(at_s, &format!("maneuver = {{ deltaV = {delta_v:?}, dump = {dumps} }}"))
}

fn center(at_s: f64, place: [f64; 3]) -> String {
    event(at_s, &format!("centerOfMass = {place:?}"))
}

fn scheduled(events: &[String]) -> NamedModel<MomentumPlant> {
    NamedModel::<MomentumPlant>::with("messenger-full.toml", MESSENGER_FULL)
        .with_schedule("timeline.toml", &events.concat())
}

#[test]
fn events_fall_at_their_time_in_steps_of_any_length_to_the_bit() {
    let with_dump = maneuver(43_211.7, [0.1, 0.2, -0.3], true) + "dump = [0.0, 0.5, 0.0]\n";
    let named = scheduled(&[
        dump(5000.5),
        center(20_000.0, [0.01, 0.0, -0.02]),
        with_dump,
        dump_to(43_211.8, [0.3, 0.0, 0.0]),
        maneuver(86_400.0, [0.0, 5.0, 0.0], false),
        maneuver(150_000.25, [1.0, 0.0, 0.0], true),
    ]);
    for dynamics in [1.0, 2.0] {
        let sets = [&ERRORS[..], &[("orbit.dynamics", dynamics), ("guided.downlinkEvery", 1.0)]].concat();
        let initialize = || named.initialize(0.0, &sets).unwrap();
        let mut counts = Vec::new();
        assert_cuts_change_nothing(
            initialize,
            [86_400.0, 172_800.0],
            &[600.0, 12_345.0, 43_200.0],
            |flight| {
                counts.push([flight.integer("maneuver.count"), flight.integer("dump.count")]);
            },
        );
        assert_eq!((counts[0], counts[4]), ([2, 3], [3, 4]), "{counts:?}");
    }
}

#[test]
fn the_momentum_is_the_dumps_target_at_its_time() {
    let at_s = 5000.125;
    let named = scheduled(&[dump_to(at_s, [0.5, -1.0, 2.0]), dump(9000.0)]);
    let mut flight = named.initialize(0.0, &[("start.momentum[1]", 1.0)]).unwrap();
    flight.set_elements("dump.target", &[0.0, 0.25, 0.0]);
    flight.step_to(at_s - 1e-6).unwrap();
    assert_eq!(flight.integer("dump.count"), 0);
    flight.step_to(at_s).unwrap();
    assert_eq!((flight.integer("dump.count"), flight.real("dump.lastTime")), (1, at_s));
    assert!((flight.vector("momentum.body") - Vector3::new(0.5, -1.0, 2.0)).amax() < 1e-12);
    flight.step_to(9000.0).unwrap();
    assert!((flight.vector("momentum.body") - Vector3::new(0.0, 0.25, 0.0)).amax() < 1e-12);
}

#[test]
fn a_maneuver_of_the_schedule_is_one_of_the_inputs() {
    let delta_v = [0.4, -0.1, 0.2];
    let named = scheduled(&[maneuver(7200.0, delta_v, true)]);
    let mut planned = named.initialize(0.0, &ERRORS).unwrap();
    let requested = full();
    let mut requested = requested.initialize(0.0, &ERRORS).unwrap();
    requested.step_to(7200.0).unwrap();
    requested.set("maneuver.request", 1.0);
    requested.set_elements("maneuver.deltaV", &delta_v);
    planned.step_to(7200.0).unwrap();
    for flight in [&mut planned, &mut requested] {
        flight.step_to(50_000.0).unwrap();
    }
    assert_same(&planned, &requested);
    assert_eq!(planned.integer("maneuver.count"), 1);
}

#[test]
fn one_at_the_start_happens_as_the_flight_begins_and_earlier_ones_never() {
    let named = scheduled(&[
        maneuver(-1.0, [9.0, 9.0, 9.0], true),
        maneuver(1000.0, [0.0, 1.0, 0.0], false),
        maneuver(2000.0, [0.0, 2.0, 0.0], false),
    ]);
    let mut flight = named.initialize(1000.0, &[]).unwrap();
    let first = (flight.integer("maneuver.count"), flight.real("maneuver.lastTime"));
    assert_eq!(first, (1, 1000.0));
    assert_eq!(flight.vector("deltaV"), Vector3::new(0.0, 1.0, 0.0));
    flight.step_to(3000.0).unwrap();
    assert_eq!((flight.integer("maneuver.count"), flight.real("maneuver.lastTime")), (2, 2000.0));
}

#[test]
fn a_centre_of_mass_holds_until_the_parameter_is_set_anew() {
    let named = scheduled(&[center(1000.0, [0.0, 0.02, 0.01]), center(5000.0, [0.0, 0.0, 0.03])]);
    let mut flight = named.initialize(0.0, &[]).unwrap();
    let parameter = flight.vector("spacecraft.centerOfMass");
    assert_eq!(flight.vector("centerOfMass"), parameter);
    flight.step_to(1000.0).unwrap();
    assert_eq!(flight.vector("centerOfMass"), Vector3::new(0.0, 0.02, 0.01));
    // Another input leaves it.
    flight.set("dump.target[1]", 0.5);
    let mut flight = flight.restored();
    flight.step_to(2000.0).unwrap();
    assert_eq!(flight.vector("centerOfMass"), Vector3::new(0.0, 0.02, 0.01));
    flight.set("spacecraft.centerOfMass[1]", 0.05);
    flight.step_to(3000.0).unwrap();
    let set = Vector3::new(0.05, parameter.y, parameter.z);
    assert_eq!(flight.vector("centerOfMass"), set);
    // Set back, it is the parameter still.
    flight.set("spacecraft.centerOfMass[1]", parameter.x);
    flight.step_to(4000.0).unwrap();
    assert_eq!(flight.vector("centerOfMass"), parameter);
    flight.step_to(6000.0).unwrap();
    assert_eq!(flight.vector("centerOfMass"), Vector3::new(0.0, 0.0, 0.03));
}

#[test]
fn by_torque_dumps_begin_on_schedule_and_the_rest_is_refused() {
    let named = scheduled(&[dump_to(20.25, [0.0, 0.1, 0.0])]);
    for source in [3.0, 4.0] {
        let sets = [("attitude.source", source), ("start.q[4]", 1.0), ("wheel[1].startMomentum", 0.5)];
        let initialize = || named.initialize(0.0, &sets).unwrap();
        assert_cuts_change_nothing(
            initialize,
            [20.0, 40.0, short_or_long(70.0, 200.0)],
            &[0.5, 0.37],
            |_| {},
        );
        let mut flight = initialize();
        flight.step_to(20.25).unwrap();
        assert_eq!(flight.integer("dump.count"), 0);
        flight.step_to(300.0).unwrap();
        assert_eq!((flight.integer("dump.count"), flight.real("dump.lastTime")), (1, 20.25));
        // It is the dump that a request at this time begins.
        let requested = full();
        let mut requested = requested.initialize(0.0, &sets).unwrap();
        requested.step_to(20.25).unwrap();
        requested.set("dump.target[2]", 0.1);
        requested.set("dump.request", 1.0);
        requested.step_to(300.0).unwrap();
        for name in ["momentum.body", "dump.impulse", "dump.deltaV"] {
            let apart = (flight.vector(name) - requested.vector(name)).norm();
            assert!(apart < 1e-9, "{name}: {apart:e}");
        }
        assert!(flight.vector("dump.impulse").norm() > 0.2);
    }
    let controlled = [("attitude.source", 3.0)];
    for (event, what) in
        [(maneuver(50.0, [1.0, 0.0, 0.0], false), "a maneuver"), (center(50.0, [0.0; 3]), "a centre of mass")]
    {
        let found = scheduled(&[event]).refusal(&controlled);
        assert!(
            found.contains(what)
                && found.contains("on line 1 of the timeline")
                && found.contains("a dump alone"),
            "{found}"
        );
    }
}

/// As the flight by the one timeline up to there and by the other from there on, never saved.
#[test]
fn a_state_goes_by_another_timeline_from_where_it_stands() {
    let command = |at_s: f64, azimuth_deg: f64| {
        let sun = format!("sun = {{ azimuth = \"{azimuth_deg} deg\", elevation = \"1 deg\" }}\n");
        format!("[[command]]\nat = {at_s:?}\nscenario = \"downlink\"\n{sun}")
    };
    // Unit of time: in guided flight light and momentum are known far ahead of where the state is saved.
    for (source, unit_s) in [(1.0, 600.0), (3.0, 4.0)] {
        let dump = |at: f64, size: f64| dump_to(at * unit_s, [size, 0.0, -size]);
        let past = [dump(1.0, 0.1), dump(2.0, 0.2), dump(3.0, 0.3)];
        let later = [dump(5.5, 0.1), dump(8.0, 0.4)];
        let commands = [command(0.0, 0.0), command(5.3 * unit_s, 4.0)];
        let old = scheduled(&[&commands[..1], &past].concat());
        let other = scheduled(&[&commands[..], &[dump(1.5, 0.5), dump(4.9, 0.5)], &later].concat());
        let both = scheduled(&[&commands[..], &past, &later].concat());
        let sets = [("attitude.source", source), ("command.source", 2.0)];
        let (saved_s, end_s) = (5.1 * unit_s, 7.0 * unit_s);
        let mut saved = old.initialize(0.0, &sets).unwrap();
        saved.step_to(saved_s).unwrap();
        let mut restored = saved.restored_by(&other);
        restored.step_to(end_s).unwrap();
        let mut straight = both.initialize(0.0, &sets).unwrap();
        straight.step_to(saved_s).unwrap();
        straight.step_to(end_s).unwrap();
        let [a, b] =
            [&restored, &straight].map(|it| (it.integer("dump.count"), it.vector("momentum.inertial")));
        assert_eq!((a.0, b.0), (4, 4));
        // Where the state was saved an interval of quadrature ends.
        assert!((a.1 - b.1).norm() < 1e-7 * b.1.norm(), "{source}: {} {}", a.1, b.1);
        let turned = restored.to_inertial("attitude.q").angle_to(&straight.to_inertial("attitude.q"));
        assert!(turned < 1e-6, "{source}: {turned}");
    }
    // What flight by torque does not have is refused where it comes.
    let none = NamedModel::<MomentumPlant>::with("messenger-full.toml", MESSENGER_FULL);
    let saved = none.initialize(0.0, &[("attitude.source", 3.0)]).unwrap();
    let other = scheduled(&[maneuver(1.0, [0.1, 0.0, 0.0], false)]);
    let refused = saved.restored_by(&other).step_to(2.0).unwrap_err().to_string();
    assert!(refused.contains("a maneuver"), "{refused}");
}

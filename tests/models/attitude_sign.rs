//! Quaternions keep their sign along the flight: continuous however far it turns, saved, restored, looked at by anybody at any time.

use models::MomentumPlant;
use nalgebra::Vector4;

use super::named_model::{NamedInstance, NamedModel, assert_cuts_change_nothing};

type Sets<'a> = &'a [(&'a str, f64)];

/// Low about Mercury, round in two hours, the turns to and from downlinks at a rate.
const GUIDED: Sets<'_> = &[
    ("orbit.semiMajorAxis", 3e6),
    ("orbit.eccentricity", 0.05),
    ("guided.slewRate", 3e-3),
    ("guided.downlinkEvery", 1.0),
    ("guided.downlinkStart", 3000.0),
    ("guided.downlinkEnd", 5000.0),
];
const COMMANDED: Sets<'_> = &[
    ("attitude.source", 2.0),
    ("command.rate[1]", 0.01),
    ("command.rate[2]", -0.02),
    ("command.rate[3]", 5e-3),
];
const CONTROLLED: Sets<'_> = &[
    ("attitude.source", 3.0),
    ("command.rate[1]", 4e-3),
    ("command.rate[2]", -3e-3),
    ("control.rate", 10.0),
    ("gyro.noise", 1e-6),
    ("starTracker.noise[2]", 1e-5),
];
const FREE: Sets<'_> = &[
    ("attitude.source", 4.0),
    ("start.rate[1]", 0.03),
    ("start.rate[2]", 0.004),
    ("start.rate[3]", -0.006),
    ("control.rate", 10.0),
];

/// A turn that begins and ends within a step, invisible in the rates there, is shorter.
const UNSEEN: f64 = 0.05;

fn quaternion(flight: &NamedInstance<'_, MomentumPlant>, name: &str) -> Vector4<f64> {
    flight.quaternion(name).into()
}

/// The same attitude by the quaternion of the other sign is no command.
fn command_at_half(flight: &mut NamedInstance<'_, MomentumPlant>, half_s: f64) {
    if flight.time_s() == half_s {
        let opposite = quaternion(flight, "attitude.q") * -1.0;
        flight.set_elements("command.q", opposite.iter());
    }
}

#[test]
fn quaternions_are_continuous_and_their_sign_is_the_flights() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let flights =
        [(GUIDED, 7_200.0, 20.0), (COMMANDED, 3_600.0, 10.0), (CONTROLLED, 900.0, 5.0), (FREE, 900.0, 3.0)];
    for (sets, span_s, step_s) in flights {
        let initialize = || named.initialize(0.0, sets).unwrap();
        let (mut flight, end_s) = (initialize(), 4.0 * span_s);
        let (mut turned_rad, mut least) = (0.0, 1.0_f64);
        assert!(flight.real("attitude.q[4]") >= 0.0);
        while flight.time_s() < end_s {
            let names = ["attitude.q", "estimate.q"];
            let (before, rate) =
                (names.map(|name| quaternion(&flight, name)), flight.vector("attitude.rate").norm());
            flight.step_to(flight.time_s() + step_s).unwrap();
            let most_rad = (rate + flight.vector("attitude.rate").norm()) * step_s;
            for (name, before) in names.into_iter().zip(before) {
                let moved = (quaternion(&flight, name) - before).norm();
                assert!(moved < 0.55 * most_rad + UNSEEN, "{sets:?} {name} at {}: {moved}", flight.time_s());
            }
            (turned_rad, least) = (turned_rad + 0.5 * most_rad, least.min(flight.real("attitude.q[4]")));
            command_at_half(&mut flight, 2.0 * span_s);
        }
        println!("{} rad, least scalar {least}", turned_rad);
        assert!(turned_rad > 9.0 && least < -0.3, "{sets:?}: {turned_rad} rad, {least}");
        // Looking once in a few turns, by another step or after a restore gives the same bits.
        let ends_s = (1..=4).map(|k| f64::from(k) * span_s);
        assert_cuts_change_nothing(initialize, ends_s, &[span_s / 7.0, step_s], |flight| {
            command_at_half(flight, 2.0 * span_s);
        });
    }
}

#[test]
fn an_attitude_goes_on_with_the_sign_of_its_start() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let start = [("start.q[1]", -0.6), ("start.q[4]", -0.8), ("attitude.source", 4.0)];
    let flight = named.initialize(0.0, &start).unwrap();
    assert_eq!(flight.quaternion("attitude.q"), [-0.6, 0.0, 0.0, -0.8]);
}

#[test]
fn a_command_far_from_unit_length_is_taken_and_warned_of_once() {
    let named = NamedModel::<MomentumPlant>::shipped();
    for (length, warned) in [(0.97, 0), (0.9, 1)] {
        let before = named.warnings().len();
        let sets = [("attitude.source", 2.0), ("command.q[1]", 0.6 * length), ("command.q[4]", 0.8 * length)];
        let mut flight = named.initialize(0.0, &sets).unwrap();
        for (step, sine) in [(1.0, 0.6), (2.0, 0.28)] {
            flight.set("command.q[1]", sine * length);
            flight.set("command.q[4]", (1.0_f64 - sine * sine).sqrt() * length);
            flight.step_to(step).unwrap();
            assert!((flight.real("attitude.q[1]") - sine).abs() < 1e-15);
        }
        let warnings = named.warnings()[before..].to_vec();
        assert_eq!(warnings.len(), warned, "{warnings:?}");
        assert!(warnings.iter().all(|it| it.contains("command.q") && it.contains("0.9000")), "{warnings:?}");
    }
}

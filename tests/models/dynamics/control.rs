//! The controller: slews, saturation, a failed wheel, commands of every kind.

use models::MomentumPlant;
use nalgebra::{UnitQuaternion, Vector3};

use super::super::named_model::NamedModel;
use super::{
    CONTROLLED, DARK, FREE, PlantInstance, Start, formed_momentum, inertia, initialize, set_quaternion,
    to_inertial,
};

const WHEELS: std::ops::RangeInclusive<usize> = 1..=4;

fn any_wheel(flight: &PlantInstance<'_>, what: &str) -> bool {
    WHEELS.clone().any(|k| flight.boolean(&format!("wheel[{k}].{what}")))
}

fn off(flight: &PlantInstance<'_>, attitude: &UnitQuaternion<f64>) -> f64 {
    to_inertial(flight).angle_to(attitude)
}

#[test]
fn a_slew_settles_within_its_limits() {
    let named = NamedModel::<MomentumPlant>::shipped();
    for axis in [Vector3::x(), Vector3::y(), Vector3::z(), Vector3::new(0.6, -0.64, 0.48)] {
        for allocation in [1.0, 2.0] {
            let mut flight = initialize(&named, &[CONTROLLED, DARK, &[("control.allocation", allocation)]]);
            let target = UnitQuaternion::new(axis * 60_f64.to_radians());
            set_quaternion(&mut flight, "command.q", &target);
            let (rate_limit, acceleration) =
                (flight.real("control.slewRate"), flight.real("control.slewAcceleration"));
            let (mut before, mut settled_s) = (Vector3::zeros(), None);
            for second in 1..=600 {
                flight.step_to(f64::from(second)).unwrap();
                let rate = flight.vector("attitude.rate");
                assert!(rate.norm() < 1.02 * rate_limit, "{second}: {}", rate.norm() / rate_limit);
                assert!((rate - before).norm() < 1.1 * acceleration, "{second}");
                assert!(!flight.boolean("control.saturated") && !any_wheel(&flight, "saturated"), "{second}");
                before = rate;
                // A bang-bang profile within both limits ends here.
                let time_s = 60_f64.to_radians() / rate_limit + rate_limit / acceleration;
                if off(&flight, &target) < 1e-4 {
                    settled_s.get_or_insert(f64::from(second) - time_s);
                } else if settled_s.is_some() {
                    panic!("{second}: it left the target again");
                }
            }
            let late_s = settled_s.unwrap();
            assert!((-2.0..60.0).contains(&late_s), "{late_s}");
            // As the sample before says, the slew being over.
            assert!((flight.real("control.error") - off(&flight, &target)).abs() < 1e-7);
            assert!(off(&flight, &target) < 1e-7, "{:e}", off(&flight, &target));
            assert!(flight.boolean("control.settled"));
        }
    }
}

#[test]
fn a_moving_command_is_followed() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let turning: Start<'_> =
        &[("command.rate[1]", 1e-3), ("command.rate[2]", -5e-4), ("command.rate[3]", 2e-3)];
    let mut flight = initialize(&named, &[CONTROLLED, turning]);
    let rate = Vector3::new(1e-3, -5e-4, 2e-3);
    flight.simulate_to(1_000.0, 10.0).unwrap();
    let commanded = UnitQuaternion::new(rate * 1_000.0);
    assert!(off(&flight, &commanded) < 1e-5, "{:e}", off(&flight, &commanded));
    assert!((flight.vector("attitude.rate") - rate).norm() < 1e-7);
    // The rate alone: the same rate, wherever that leads.
    flight.set("command.kind", 3.0);
    flight.simulate_to(1_300.0, 10.0).unwrap();
    assert!((flight.vector("attitude.rate") - rate).norm() < 1e-7);
    // None: it stops and stays.
    flight.set("command.kind", 0.0);
    flight.simulate_to(1_700.0, 10.0).unwrap();
    let there = to_inertial(&flight);
    flight.simulate_to(2_000.0, 10.0).unwrap();
    assert!(off(&flight, &there) < 1e-5 && flight.vector("attitude.rate").norm() < 1e-7);
}

#[test]
fn an_error_quaternion_is_turned_out_whenever_it_changes() {
    let named = NamedModel::<MomentumPlant>::shipped();
    // From the start on.
    let mut flight = initialize(&named, &[CONTROLLED, &[("command.kind", 2.0)]]);
    let expected = UnitQuaternion::new(Vector3::new(0.3, -0.2, 0.5));
    // From the commanded to the actual frame, measured anew every second as a Sun sensor would.
    for second in 1..=400 {
        let error = expected.inverse() * to_inertial(&flight);
        set_quaternion(&mut flight, "command.error", &error);
        flight.step_to(f64::from(second)).unwrap();
    }
    assert!(off(&flight, &expected) < 1e-4, "{:e}", off(&flight, &expected));
}

#[test]
fn a_forced_saturation_is_flagged_and_a_dump_recovers() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let full: Start<'_> = &[
        ("wheel[1].startMomentum", 7.9),
        ("wheel[2].startMomentum", 7.9),
        ("wheel[3].startMomentum", 7.9),
        ("wheel[4].startMomentum", 7.9),
        // No dump of its own.
        ("dump.threshold[1]", 1e3),
        ("dump.threshold[2]", 1e3),
        ("dump.threshold[3]", 1e3),
        ("torque.applied[2]", 5e-3),
    ];
    let mut flight = initialize(&named, &[CONTROLLED, DARK, full]);
    flight.simulate_to(600.0, 10.0).unwrap();
    assert!(any_wheel(&flight, "saturated"));
    // Full wheels hold nothing against the torque any more.
    assert!(off(&flight, &UnitQuaternion::identity()) > 1e-2);
    for k in WHEELS {
        assert!(flight.real(&format!("wheel[{k}].momentum")).abs() <= 8.0);
    }
    flight.set("torque.applied[2]", 0.0);
    flight.set("dump.request", 1.0);
    flight.step_to(610.0).unwrap();
    assert!(flight.boolean("dump.active") && flight.integer("dump.count") == 1);
    flight.simulate_to(2_000.0, 10.0).unwrap();
    assert!(!flight.boolean("dump.active") && !any_wheel(&flight, "saturated"));
    assert!(
        off(&flight, &UnitQuaternion::identity()) < 1e-5,
        "{}",
        off(&flight, &UnitQuaternion::identity())
    );
    // The body turned during the dump, by which the target in the body is missed.
    assert!(flight.vector("momentum.body").norm() < 0.2, "{}", flight.vector("momentum.body"));
    assert!((formed_momentum(&flight) - flight.vector("momentum.inertial")).norm() < 1e-12);
}

#[test]
fn a_dump_at_rest_reaches_its_target_without_disturbing_the_attitude() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let start: Start<'_> = &[
        ("wheel[1].startMomentum", 3.0),
        ("wheel[2].startMomentum", -2.0),
        ("dump.target[1]", 0.5),
        ("dump.target[2]", -0.25),
        ("dump.threshold[1]", 1e3),
        ("dump.threshold[2]", 1e3),
        ("dump.threshold[3]", 1e3),
    ];
    let mut flight = initialize(&named, &[CONTROLLED, DARK, start]);
    flight.step_to(10.0).unwrap();
    let before = flight.vector("momentum.body");
    flight.set("dump.request", 1.0);
    let torque = flight.real("dump.torque");
    let lasts_s = (Vector3::new(0.5, -0.25, 0.0) - before).amax() / torque;
    let mut worst = 0.0_f64;
    while flight.time_s() < 11.0 + lasts_s {
        flight.step_to(flight.time_s() + 1.0).unwrap();
        worst = worst.max(off(&flight, &UnitQuaternion::identity()));
        let active = flight.time_s() < 10.0 + lasts_s;
        assert_eq!(flight.boolean("dump.active"), active, "{} {lasts_s}", flight.time_s());
    }
    // The thrusters end between two samples: for up to one the wheels turn the body against a torque that is gone.
    let most = torque / 199.6 * 0.02 / 0.1;
    assert!(worst < most, "{worst:e}");
    let target = Vector3::new(0.5, -0.25, 0.0);
    assert!((flight.vector("momentum.body") - target).norm() < 1e-6, "{}", flight.vector("momentum.body"));
    // A threshold that is exceeded dumps by itself.
    let own: Start<'_> = &[("wheel[1].startMomentum", 7.9), ("dump.threshold[1]", 4.0)];
    let mut flight = initialize(&named, &[CONTROLLED, DARK, own]);
    assert!(flight.vector("momentum.body").x.abs() > 4.0);
    flight.simulate_to(400.0, 10.0).unwrap();
    assert_eq!(flight.integer("dump.count"), 1);
    assert!((flight.vector("momentum.body").x.abs() - 3.6).abs() < 1e-6);
}

#[test]
fn a_failed_wheel_is_survived() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let friction: Start<'_> = &[
        ("wheel[2].coulombFriction", 1e-3),
        ("wheel[2].viscousFriction", 1e-5),
        ("wheel[2].startMomentum", 2.0),
        ("wheel[1].startMomentum", 1.0),
    ];
    for allocation in [1.0, 2.0] {
        let mut flight = initialize(&named, &[CONTROLLED, friction, &[("control.allocation", allocation)]]);
        let target = UnitQuaternion::new(Vector3::new(0.5, 0.4, -0.6));
        set_quaternion(&mut flight, "command.q", &target);
        flight.simulate_to(60.0, 1.0).unwrap();
        flight.set("wheel[2].failed", 1.0);
        flight.simulate_to(1_000.0, 1.0).unwrap();
        assert_eq!(flight.real("wheel[2].torque"), 0.0);
        // A torque that changes by d a second leaves d over the integral gain: here friction that dies away at v / I.
        let slope = (1.6e-3 + 1e-3) * 1e-5 / flight.real("wheel[2].inertia");
        assert!(
            off(&flight, &target) < slope / (199.6 * 0.1 * 0.1_f64.powi(3)),
            "{:e}",
            off(&flight, &target)
        );
        // Friction has brought it to rest.
        flight.simulate_to(4_000.0, 60.0).unwrap();
        assert_eq!(flight.real("wheel[2].momentum"), 0.0);
        assert!(off(&flight, &target) < 1e-5);
        // Two are too few: nothing is left to turn with.
        flight.set("wheel[3].failed", 1.0);
        flight.simulate_to(4_010.0, 1.0).unwrap();
        assert!(flight.boolean("control.saturated"));
        assert_eq!(flight.real("wheel[1].torque"), 0.0);
    }
}

#[test]
fn friction_leaves_no_error_whether_made_up_for_or_not() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let friction: Start<'_> = &[
        ("wheel[1].coulombFriction", 2e-3),
        ("wheel[2].coulombFriction", 1e-3),
        ("wheel[3].viscousFriction", 2e-5),
        ("wheel[1].startMomentum", 1.0),
        ("wheel[3].startMomentum", -1.0),
    ];
    for compensated in [0.0, 1.0] {
        let parts: Start<'_> = &[("control.frictionCompensation", compensated), ("control.balanceTime", 0.0)];
        let mut flight = initialize(&named, &[CONTROLLED, DARK, friction, parts]);
        flight.simulate_to(2_000.0, 10.0).unwrap();
        let error = off(&flight, &UnitQuaternion::identity());
        assert!(error < 1e-6, "{compensated}: {error:e}");
    }
}

#[test]
fn free_wheels_turn_the_body_as_their_torque_says() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let mut flight = initialize(&named, &[FREE, DARK]);
    // All four alike: their sum is along Y, 4 / sqrt 3 times each.
    for k in WHEELS {
        flight.set(&format!("wheel[{k}].torqueCommand"), 0.01);
    }
    flight.simulate_to(100.0, 0.02).unwrap();
    let rotors = 4.0 / 3.0 * flight.real("wheel[1].inertia");
    let expected = -0.01 * 4.0 / 3_f64.sqrt() * 100.0 / (inertia()[(1, 1)] - rotors);
    let rate = flight.vector("attitude.rate");
    assert!((rate - Vector3::y() * expected).norm() < 1e-12 * expected.abs(), "{rate} {expected}");
    assert!(
        (flight.real("wheel[1].speed") * flight.real("wheel[1].inertia") - flight.real("wheel[1].momentum"))
            .abs()
            < 1e-12
    );
    // More than the motor gives is not given.
    flight.set("wheel[1].torqueCommand", 1.0);
    flight.step_to(100.02).unwrap();
    assert_eq!(flight.real("wheel[1].torque"), flight.real("wheel[1].maxTorque"));
}

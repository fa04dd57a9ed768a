//! The reference against rest-to-rest slews in closed form, and its limits over random commands.

use approx::assert_relative_eq;
use nalgebra::Vector3;
use std::f64::consts::PI;

use super::{random, random_attitude, random_unit};
use crate::attitude::Attitude;
use crate::attitude::control::{ControlTarget, ControllerSettings, Reference, ReferenceSample};

const DT_S: f64 = 0.02;
const LIMITS: ControllerSettings = limits(5e-3, 1e-4);

/// Settings that limit rate and acceleration of the reference, sampled every [`DT_S`].
const fn limits(slew_rate_rad_s: f64, slew_acceleration_rad_s2: f64) -> ControllerSettings {
    ControllerSettings {
        rate_hz: 1.0 / DT_S,
        bandwidth_rad_s: 1.0,
        damping: 1.0,
        integral: 0.0,
        slew_rate_rad_s,
        slew_acceleration_rad_s2,
        keeps_reference: false,
    }
}

fn hold(attitude: Attitude) -> ControlTarget {
    ControlTarget::Attitude { attitude, rate_body_rad_s: Vector3::zeros() }
}

/// Samples until the reference has settled and ten more; fails after `longest_s`.
fn simulate(
    reference: &mut Reference,
    limits: &ControllerSettings,
    target: impl Fn(f64) -> ControlTarget,
    longest_s: f64,
) -> Vec<ReferenceSample> {
    let mut samples = Vec::new();
    let mut left = 10;
    while left > 0 {
        let time_s = samples.len() as f64 * DT_S;
        assert!(time_s < longest_s, "not settled after {longest_s} s: {reference:?}");
        samples.push(reference.step(&target(time_s), limits));
        left -= i32::from(reference.is_settled);
    }
    samples
}

/// A command that turns at a constant rate.
fn turning(start: Attitude, rate: Vector3<f64>) -> impl Fn(f64) -> ControlTarget {
    move |time_s| ControlTarget::Attitude { attitude: start.propagated(rate, time_s), rate_body_rad_s: rate }
}

#[test]
fn a_rest_to_rest_slew_takes_the_time_of_the_trapezoid() {
    let axis = random_unit(1);
    for angle in [1e-4, 0.02, 0.3, 1.0, 2.0, PI] {
        let start = random_attitude(3);
        let mut reference = Reference::new(start, Vector3::zeros());
        let samples = simulate(&mut reference, &LIMITS, |_| hold(start.turned(axis * angle)), 3600.0);
        let settled_s = (samples.len() - 10) as f64 * DT_S;
        let (v, a) = (LIMITS.slew_rate_rad_s, LIMITS.slew_acceleration_rad_s2);
        let expected_s = if angle > v * v / a { angle / v + v / a } else { 2.0 * (angle / a).sqrt() };
        // The approach has a time constant of 1 s.
        assert!(settled_s >= expected_s - DT_S, "{angle}: {settled_s} {expected_s}");
        assert!(settled_s <= expected_s + 8.0, "{angle}: {settled_s} {expected_s}");
        // It turns about the eigenaxis only, and never turns back.
        for pair in samples.windows(2) {
            let along = pair[0].rate_body_rad_s.dot(&axis)
                * if angle == PI { turn_sign(&samples, &axis) } else { 1.0 };
            assert!(along >= -1e-12, "{along}");
            assert!(pair[0].rate_body_rad_s.cross(&axis).norm() < 1e-9);
            let left = pair[0].attitude.rotation_vector_to(&start.turned(axis * angle)).norm();
            let then = pair[1].attitude.rotation_vector_to(&start.turned(axis * angle)).norm();
            assert!(then <= left + 1e-12, "{left} {then}");
        }
    }
}

/// Half a turn may go either way.
fn turn_sign(samples: &[ReferenceSample], axis: &Vector3<f64>) -> f64 {
    samples[samples.len() / 2].rate_body_rad_s.dot(axis).signum()
}

#[test]
fn a_reference_that_has_caught_the_command_is_the_command() {
    let (start, rate) = (random_attitude(4), Vector3::new(1e-3, -5e-4, 8e-4));
    let target = turning(start.turned(Vector3::new(0.3, -0.8, 0.2)), rate);
    let mut reference = Reference::new(start, Vector3::zeros());
    let mut settled = simulate(&mut reference, &LIMITS, &target, 600.0).len();
    // Four powers of ten closer in 25 s, with a time constant of 1.4 s at the end.
    for _ in 0..1250 {
        reference.step(&target(settled as f64 * DT_S), &LIMITS);
        settled += 1;
    }
    for sample in settled..settled + 5000 {
        let expected = target(sample as f64 * DT_S);
        let found = reference.step(&expected, &LIMITS);
        let ControlTarget::Attitude { attitude, rate_body_rad_s } = expected else { unreachable!() };
        assert!(reference.is_settled);
        assert_eq!(found.attitude, attitude);
        assert_eq!(found.rate_body_rad_s, rate_body_rad_s);
        assert_eq!(found.acceleration_body_rad_s2, Vector3::zeros());
    }
}

#[test]
fn limits_hold_over_random_commands() {
    let mut settled = 0;
    for run in 0..60 {
        let start = random_attitude(run);
        let mut reference = Reference::new(start, Vector3::zeros());
        let rate = random(300 + run) * 1e-3;
        let mut target = turning(random_attitude(500 + run), rate);
        let mut last_relative = rate.norm();
        for sample in 0..46_000_u64 {
            if sample == 9_000 {
                // Jumps on the way.
                target = turning(random_attitude(700 + run), random(800 + run) * 1e-3);
            }
            let expected = target(sample as f64 * DT_S);
            let before = reference;
            let found = reference.step(&expected, &LIMITS);
            let acceleration = found.acceleration_body_rad_s2.norm();
            assert!(acceleration <= LIMITS.slew_acceleration_rad_s2 * (1.0 + 1e-12), "{acceleration}");
            let ControlTarget::Attitude { attitude, rate_body_rad_s } = expected else { unreachable!() };
            let command_rate = before.attitude.to_body(&attitude.to_inertial(&rate_body_rad_s));
            let relative = (before.rate_body_rad_s - command_rate).norm();
            if sample != 9_000 {
                let allowed = LIMITS.slew_rate_rad_s.max(last_relative) * (1.0 + 1e-6);
                assert!(relative <= allowed, "{run} {sample}: {relative} {allowed}");
            }
            last_relative = relative;
        }
        settled += u64::from(reference.is_settled);
    }
    // Half a turn at 5e-3 rad/s takes 678 s, and 740 s are left.
    assert!(settled == 60, "{settled} have settled");
}

#[test]
fn a_turning_command_is_approached_about_the_eigenaxis() {
    let (command, axis, rate) = (random_attitude(70), random_unit(71), random_unit(72) * 2e-3);
    let target = turning(command, rate);
    let start = command.turned(axis * -1.0);
    // At rest relative to the command.
    let mut reference = Reference::new(start, start.to_body(&command.to_inertial(&rate)));
    let mut worst: f64 = 0.0;
    for sample in simulate(&mut reference, &LIMITS, &target, 600.0).iter().enumerate() {
        let ControlTarget::Attitude { attitude, .. } = target(sample.0 as f64 * DT_S) else { unreachable!() };
        let left = attitude.rotation_vector_to(&sample.1.attitude);
        worst = worst.max(left.cross(&axis).norm());
    }
    assert!(worst < 1e-6, "{worst}");
}

#[test]
fn a_sample_goes_on_where_the_one_before_leads() {
    let start = random_attitude(8);
    let target = turning(random_attitude(9), random(10) * 1e-3);
    let mut reference = Reference::new(start, random(11) * 1e-3);
    let samples = simulate(&mut reference, &LIMITS, target, 2000.0);
    for pair in samples.windows(2) {
        let rate = pair[0].rate_body_rad_s + pair[0].acceleration_body_rad_s2 * DT_S;
        assert!((rate - pair[1].rate_body_rad_s).norm() < 1.1e-10 / DT_S);
        // Fourth-order Runge-Kutta of the kinematics under that acceleration.
        let turned = integrated(&pair[0]);
        assert!(turned.rotation_vector_to(&pair[1].attitude).norm() < 2e-10);
    }
}

fn integrated(sample: &ReferenceSample) -> Attitude {
    let steps = 8;
    let h = DT_S / f64::from(steps);
    let mut attitude = sample.attitude;
    for step in 0..steps {
        let middle = (f64::from(step) + 0.5) * h;
        attitude = attitude.propagated(sample.rate_body_rad_s + sample.acceleration_body_rad_s2 * middle, h);
    }
    attitude
}

#[test]
fn no_limits_follow_at_once_and_one_limit_alone_holds() {
    let (start, end) = (random_attitude(20), random_attitude(21));
    let none = limits(0.0, 0.0);
    let mut reference = Reference::new(start, Vector3::zeros());
    assert_eq!(reference.step(&hold(end), &none).attitude, end);
    assert!(reference.is_settled);
    let angle = start.rotation_vector_to(&end).norm();
    let rate_only = limits(0.01, 0.0);
    let mut reference = Reference::new(start, Vector3::zeros());
    let samples = simulate(&mut reference, &rate_only, |_| hold(end), 1000.0);
    let settled_s = (samples.len() - 10) as f64 * DT_S;
    assert!((settled_s - angle / 0.01).abs() <= 4.0 * DT_S, "{settled_s} {}", angle / 0.01);
    assert!(samples.iter().all(|sample| sample.rate_body_rad_s.norm() <= 0.01 * (1.0 + 1e-12)));
    let acceleration_only = limits(0.0, 1e-3);
    let mut reference = Reference::new(start, Vector3::zeros());
    let samples = simulate(&mut reference, &acceleration_only, |_| hold(end), 1000.0);
    let settled_s = (samples.len() - 10) as f64 * DT_S;
    let expected_s = 2.0 * (angle / 1e-3).sqrt();
    assert!(settled_s >= expected_s && settled_s <= expected_s + 8.0, "{settled_s} {expected_s}");
}

#[test]
fn small_jumps_of_a_command_ask_for_little_acceleration() {
    // What guidance sampled each second leaves of a command that accelerates by 1e-6 rad/s2.
    let (start, axis, acceleration) = (random_attitude(30), random_unit(31), 1e-6);
    let mut reference = Reference::new(start, Vector3::zeros());
    simulate(&mut reference, &LIMITS, |_| hold(start), 10.0);
    let (mut most, mut mean): (f64, f64) = (0.0, 0.0);
    for sample in 0..5000_u32 {
        let time_s = f64::from(sample) * DT_S;
        let (sampled_s, rate) = (time_s.floor(), axis * (acceleration * time_s.floor()));
        let angle = axis * (0.5 * acceleration * sampled_s * sampled_s) + rate * (time_s - sampled_s);
        let target = ControlTarget::Attitude { attitude: start.turned(angle), rate_body_rad_s: rate };
        let found = reference.step(&target, &LIMITS);
        assert!(reference.is_settled, "{sample}");
        if sample >= 2500 {
            most = most.max(found.acceleration_body_rad_s2.norm());
            mean += found.acceleration_body_rad_s2.dot(&axis) / 2500.0;
        }
        let exact = start.turned(axis * (0.5 * acceleration * time_s * time_s));
        assert!(found.attitude.rotation_vector_to(&exact).norm() < 2.0 * acceleration);
    }
    // A tenth of the limit; on average that of the command.
    assert!(most < 0.1 * LIMITS.slew_acceleration_rad_s2, "{most}");
    assert_relative_eq!(mean, acceleration, max_relative = 0.02);
}

#[test]
fn the_sign_of_a_quaternion_does_not_matter() {
    let q = random_attitude(40).quaternion(None);
    let [plus, minus] = [q, q.map(|x| -x)].map(|q| Attitude::from_quaternion(q).unwrap());
    let mut references = [Reference::new(Attitude::default(), Vector3::zeros()); 2];
    for _ in 0..36_000 {
        let [a, b] = [plus, minus];
        let first = references[0].step(&hold(a), &LIMITS);
        let second = references[1].step(&hold(b), &LIMITS);
        assert!((first.rate_body_rad_s - second.rate_body_rad_s).norm() < 1e-15);
    }
    assert!(references.iter().all(|reference| reference.is_settled));
}

#[test]
fn a_rate_alone_is_reached_within_the_acceleration() {
    let (start, rate) = (random_attitude(50), Vector3::new(0.01, -0.02, 0.005));
    let mut reference = Reference::new(start, Vector3::zeros());
    let target = ControlTarget::RateOnly { rate_body_rad_s: rate };
    let samples = simulate(&mut reference, &LIMITS, |_| target, 1000.0);
    let reached_s = (samples.len() - 10) as f64 * DT_S;
    assert_relative_eq!(reached_s, rate.norm() / LIMITS.slew_acceleration_rad_s2, epsilon = 1.01 * DT_S);
    // The angle of a constant acceleration and then a constant rate about one axis.
    let time_s = samples.len() as f64 * DT_S;
    let exact_s = rate.norm() / LIMITS.slew_acceleration_rad_s2;
    let expected = start.turned(rate * (time_s - 0.5 * exact_s));
    assert!(expected.rotation_vector_to(&reference.attitude).norm() < rate.norm() * DT_S * DT_S);
    assert_eq!(samples.last().unwrap().acceleration_body_rad_s2, Vector3::zeros());
    assert_relative_eq!(reference.rate_body_rad_s, rate, epsilon = 1e-17);
}

#[test]
fn a_command_that_turns_faster_than_the_slew_rate_is_caught() {
    for acceleration_rad_s2 in [1e-4, 1e-3] {
        let limits = limits(5e-3, acceleration_rad_s2);
        for number in 0..20 {
            let target = turning(random_attitude(60 + number), random_unit(number) * 0.05);
            let mut reference = Reference::new(random_attitude(90 + number), Vector3::zeros());
            // Half a turn at the rate that the acceleration allows, after the rate has been reached.
            let fastest_rad_s = limits.slew_rate_rad_s.min(0.5 * acceleration_rad_s2 / 0.05);
            simulate(&mut reference, &limits, target, 0.05 / acceleration_rad_s2 + PI / fastest_rad_s + 60.0);
        }
    }
}

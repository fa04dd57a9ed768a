//! The controller on a rigid body, against closed forms of the loop.

use approx::assert_relative_eq;
use nalgebra::{Matrix3, Vector3};

use super::rig::{DT_S, Loop, hold, inertia, settings};
use super::{random_attitude, random_unit};
use crate::attitude::Attitude;
use crate::attitude::control::{ControlTarget, ControllerSettings, ControllerState, GainError};

#[test]
fn a_slew_of_60_deg_settles_without_overshoot() {
    let (start, axis) = (random_attitude(1), random_unit(2));
    let end = start.turned(axis * 60.0_f64.to_radians());
    let mut flight = Loop::new(settings(), start, hold(end));
    let (mut settled_s, mut overshoot, mut torque_n_m): (Option<f64>, f64, f64) = (None, 0.0, 0.0);
    for sample in 0..20_000_u32 {
        let torque = flight.sample();
        torque_n_m = torque_n_m.max(torque.norm());
        flight.body.advance(&torque);
        overshoot = overshoot.max(end.rotation_vector_to(&flight.body.attitude()).dot(&axis));
        if flight.state.is_settled() && settled_s.is_none() {
            settled_s = Some(f64::from(sample) * DT_S);
        }
        if settled_s.is_some_and(|settled_s| f64::from(sample) * DT_S > settled_s + 25.0) {
            assert!(flight.state.attitude_error_rad() < 5e-9, "{}", flight.state.attitude_error_rad());
        }
    }
    // Trapezoid: angle over rate plus rate over acceleration; torque: acceleration, and rate x momentum.
    let trapezoid_s = 60.0_f64.to_radians() / 8e-3 + 80.0;
    assert!((settled_s.unwrap() - trapezoid_s - 4.0).abs() < 4.0, "{settled_s:?} {trapezoid_s}");
    assert!(overshoot < 1e-7, "{overshoot}");
    assert!(torque_n_m < 515.0 * 1e-4 + 8e-3 * 11.0, "{torque_n_m}");
    assert!(flight.error_to(&end) < 3e-10, "{}", flight.error_to(&end));
    assert!(flight.body.rate.norm() < 1e-11);
}

#[test]
fn a_turning_command_is_followed_without_lag() {
    let (start, rate) = (random_attitude(3), Vector3::new(1e-3, -6e-4, 8e-4));
    let end = start.turned(Vector3::new(0.2, 0.5, -0.1));
    let mut flight = Loop::new(settings(), start, hold(end));
    for sample in 0..15_000_u32 {
        let attitude = end.propagated(rate, f64::from(sample) * DT_S);
        flight.target = ControlTarget::Attitude { attitude, rate_body_rad_s: rate };
        flight.simulate(DT_S);
        if sample > 12_000 {
            assert!(flight.state.is_settled());
            assert!(flight.state.attitude_error_rad() < 1e-9, "{}", flight.state.attitude_error_rad());
        }
    }
}

#[test]
fn a_small_step_without_limits_answers_as_the_continuous_loop() {
    // theta'' + 2 d w theta' + w^2 theta = 0 from theta0; sampling at 50 Hz delays by half a sample, w dt / 2.
    let unlimited = ControllerSettings {
        integral: 0.0,
        slew_rate_rad_s: 0.0,
        slew_acceleration_rad_s2: 0.0,
        keeps_reference: false,
        ..settings()
    };
    let (start, axis, angle) = (random_attitude(5), random_unit(6), 1e-3);
    let (w, d) = (unlimited.bandwidth_rad_s, unlimited.damping);
    let damped = w * (1.0 - d * d).sqrt();
    // In the axes of a command that turns, the answer is the same.
    for rate in [Vector3::zeros(), axis.cross(&random_unit(7)) * 0.02] {
        let end = |time_s: f64| start.turned(axis * angle).propagated(rate, time_s);
        let mut flight = Loop::new(unlimited, start, hold(start));
        // At rest relative to the command, which sees the rate turned by the angle.
        flight.body.rate = rate - (axis * -angle).cross(&rate);
        for sample in 1..5000_u32 {
            let attitude = end(f64::from(sample - 1) * DT_S);
            flight.target = ControlTarget::Attitude { attitude, rate_body_rad_s: rate };
            flight.simulate(DT_S);
            let t = f64::from(sample) * DT_S;
            let expected =
                angle * (-d * w * t).exp() * ((damped * t).cos() + d * w / damped * (damped * t).sin());
            let found = -end(t).rotation_vector_to(&flight.body.attitude());
            assert!((found - axis * expected).norm() < angle * w * DT_S, "{t}: {found} {expected}");
        }
    }
}

#[test]
fn a_constant_disturbance_leaves_an_error_without_the_integral_and_none_with_it() {
    let attitude = random_attitude(7);
    let torque = Vector3::new(2e-3, -1e-3, 3e-3);
    for integral in [0.0, 0.1, 0.3] {
        let mut flight = Loop::new(ControllerSettings { integral, ..settings() }, attitude, hold(attitude));
        flight.body.external = torque;
        flight.simulate(600.0);
        let first = flight.error_to(&attitude);
        flight.simulate(1400.0);
        let found = attitude.rotation_vector_to(&flight.body.attitude());
        if integral == 0.0 {
            let expected = inertia().try_inverse().unwrap() * torque / 0.01;
            assert_relative_eq!(found, expected, max_relative = 1e-4);
        } else {
            // exp(-c w t) of the slowest pole.
            assert!(found.norm() < 3.0 * (-integral * 0.1 * 1400.0).exp() * first + 1e-13, "{found} {first}");
        }
    }
}

#[test]
fn a_known_torque_is_fed_forward() {
    let attitude = random_attitude(8);
    let mut flight = Loop::new(settings(), attitude, hold(attitude));
    flight.body.external = Vector3::new(0.05, -0.02, 0.03);
    for _ in 0..5000 {
        let torque = flight.sample_with(&flight.body.estimate(), &flight.body.external.clone());
        flight.body.advance(&torque);
    }
    assert!(flight.error_to(&attitude) < 1e-10, "{}", flight.error_to(&attitude));
}

#[test]
fn at_the_bound_of_stability_the_loop_turns_from_decay_to_growth() {
    for (damping, integral) in [(0.3, 0.0), (0.7, 0.0), (0.7, 0.1), (1.2, 0.5)] {
        let with = |bandwidth_rad_s| ControllerSettings {
            bandwidth_rad_s,
            damping,
            integral,
            slew_rate_rad_s: 0.0,
            slew_acceleration_rad_s2: 0.0,
            keeps_reference: false,
            ..settings()
        };
        let Err(GainError::Unstable { allowed_rad_s, .. }) = with(1e3).check() else { panic!("{damping}") };
        for (factor, is_stable) in [(0.98, true), (1.02, false)] {
            let tried = with(allowed_rad_s * factor);
            assert_eq!(tried.check().is_ok(), is_stable);
            let (start, angle) = (Attitude::default(), 1e-9);
            let mut flight = Loop::new(tried, start, hold(start.turned(Vector3::x() * angle)));
            // A body without coupling of its axes.
            flight.body.inertia = Matrix3::from_diagonal(&Vector3::new(400.0, 300.0, 500.0));
            flight.body.wheels = Vector3::zeros();
            flight.simulate(40.0);
            let error = flight.state.attitude_error_rad();
            if is_stable {
                assert!(error < 1e-3 * angle, "{tried:?} {error}");
            } else {
                assert!(error > 1e3 * angle, "{tried:?} {error}");
            }
        }
    }
}

#[test]
fn the_signs_of_quaternions_do_not_matter() {
    let (start, end) = (random_attitude(14), random_attitude(15));
    let minus =
        |attitude: &Attitude| Attitude::from_quaternion(attitude.quaternion(None).map(|x| -x)).unwrap();
    let torques = |target: Attitude, flip: bool| {
        let mut flight = Loop::new(settings(), start, hold(target));
        let mut torques = Vec::new();
        for sample in 0..3000 {
            let mut estimate = flight.body.estimate();
            if flip && sample % 2 == 0 {
                estimate.attitude = minus(&estimate.attitude);
            }
            let torque = flight.sample_with(&estimate, &Vector3::zeros());
            flight.body.advance(&torque);
            torques.push(torque);
        }
        torques
    };
    let (first, second) = (torques(end, false), torques(minus(&end), true));
    for (a, b) in first.iter().zip(&second) {
        assert!((a - b).norm() < 1e-12, "{a} {b}");
    }
}

#[test]
fn a_restored_controller_goes_on_to_the_bit() {
    let (start, end) = (random_attitude(16), random_attitude(17));
    let mut flight = Loop::new(settings(), start, hold(end));
    flight.simulate(50.0);
    let mut restored: ControllerState = toml::from_str(&toml::to_string(&flight.state).unwrap()).unwrap();
    let inertia = inertia();
    for _ in 0..1000 {
        let estimate = flight.body.estimate();
        let wheels = flight.body.wheels;
        let torque = flight.sample();
        let settings = settings();
        let other = restored.sample(&settings, &inertia, &hold(end), &estimate, &wheels, &Vector3::zeros());
        assert_eq!(torque, other);
        flight.body.advance(&torque);
    }
}

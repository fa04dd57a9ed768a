//! The controller where torque, rate or inertial attitude are missing.

use nalgebra::Vector3;

use super::rig::{Loop, hold, settings};
use super::{random_attitude, random_unit};
use crate::attitude::Attitude;
use crate::attitude::control::{ControlTarget, ControllerSettings, Estimate};

#[test]
fn torque_that_is_missing_winds_nothing_up() {
    // A disturbance above what the wheels can give, for a minute; then it ends.
    let attitude = random_attitude(9);
    let slow = ControllerSettings { slew_acceleration_rad_s2: 2e-5, ..settings() };
    let mut flight = Loop::new(slow, attitude, hold(attitude));
    flight.body.wheels = Vector3::zeros();
    let greatest_n_m = 0.02;
    let direction = random_unit(10);
    let (mut overshoot, mut most): (f64, f64) = (0.0, 0.0);
    for sample in 0..40_000_u32 {
        flight.body.external = if sample < 3000 { direction * 0.04 } else { Vector3::zeros() };
        let mut torque = flight.sample();
        if torque.norm() > greatest_n_m {
            torque *= greatest_n_m / torque.norm();
            flight.state.limited(&torque);
        }
        flight.body.advance(&torque);
        let along = attitude.rotation_vector_to(&flight.body.attitude()).dot(&direction);
        overshoot = overshoot.max(-along);
        most = most.max(along);
    }
    assert!(most > 0.05, "{most}");
    assert!(overshoot < 0.15 * most, "{overshoot} {most}");
    assert!(flight.error_to(&attitude) < 1e-6, "{}", flight.error_to(&attitude));
}

#[test]
fn the_integral_does_not_grow_toward_torque_that_is_missing() {
    // Without a slew acceleration nothing else bounds the integral.
    let unlimited = ControllerSettings {
        integral: 0.5,
        slew_rate_rad_s: 0.0,
        slew_acceleration_rad_s2: 0.0,
        keeps_reference: false,
        ..settings()
    };
    let (attitude, direction) = (random_attitude(20), random_unit(21));
    let overshoot = |is_configured: bool| {
        let mut flight = Loop::new(unlimited, attitude, hold(attitude));
        flight.body.wheels = Vector3::zeros();
        let mut overshoot: f64 = 0.0;
        for sample in 0..20_000_u32 {
            flight.body.external = if sample < 1500 { direction * 0.04 } else { Vector3::zeros() };
            let mut torque = flight.sample();
            if torque.norm() > 0.03 {
                torque *= 0.03 / torque.norm();
                if is_configured {
                    flight.state.limited(&torque);
                }
            }
            flight.body.advance(&torque);
            let along = attitude.rotation_vector_to(&flight.body.attitude()).dot(&direction);
            overshoot = overshoot.max(-along);
        }
        overshoot
    };
    let (reported, untold) = (overshoot(true), overshoot(false));
    assert!(reported < 0.5 * untold, "{reported} {untold}");
}

#[test]
fn a_rate_alone_is_reached_and_held_against_a_disturbance() {
    let (start, rate) = (random_attitude(11), Vector3::new(3e-3, -1e-3, 2e-3));
    let mut flight = Loop::new(settings(), start, ControlTarget::RateOnly { rate_body_rad_s: rate });
    flight.body.external = Vector3::new(1e-3, 2e-3, -1e-3);
    let mut jump = Attitude::default();
    for sample in 0..50_000_u32 {
        // The attitude is not known in EME2000 and may jump: it must not matter.
        if sample % 1000 == 0 {
            jump = random_attitude(u64::from(sample));
        }
        let estimate = Estimate {
            attitude: jump.then(&flight.body.attitude()),
            is_valid: false,
            ..flight.body.estimate()
        };
        let torque = flight.sample_with(&estimate, &Vector3::zeros());
        assert!(torque.norm() < 0.12, "{torque}");
        flight.body.advance(&torque);
    }
    assert!((flight.body.rate - rate).norm() < 1e-8, "{}", flight.body.rate - rate);
    assert!(flight.state.is_settled());
    // An attitude is then taken up from where the body is.
    let end = flight.body.attitude().turned(Vector3::new(0.3, 0.1, -0.2));
    flight.target = hold(end);
    flight.body.external = Vector3::zeros();
    for _ in 0..60_000 {
        let torque = flight.sample();
        assert!(torque.norm() < 0.15, "{torque}");
        flight.body.advance(&torque);
    }
    assert!(flight.error_to(&end) < 1e-6);
}

#[test]
fn without_a_rate_there_is_no_torque_and_control_is_taken_up_again() {
    let attitude = random_attitude(12);
    let mut flight = Loop::new(settings(), attitude, hold(attitude));
    flight.body.external = Vector3::new(2e-3, 0.0, -1e-3);
    flight.simulate(1000.0);
    for _ in 0..3000 {
        let estimate = Estimate { rate_body_rad_s: None, is_valid: false, ..flight.body.estimate() };
        let torque = flight.sample_with(&estimate, &Vector3::zeros());
        assert_eq!(torque, Vector3::zeros());
        flight.body.advance(&torque);
    }
    assert!(flight.error_to(&attitude) > 1e-3);
    // It begins from rest relative to where the body is: no more than the slew acceleration and the held disturbance.
    assert!(flight.sample().norm() < 520.0 * 1e-4 + 5e-3);
    for _ in 0..60_000 {
        let torque = flight.sample();
        assert!(torque.norm() < 0.1, "{torque}");
        flight.body.advance(&torque);
    }
    assert!(flight.error_to(&attitude) < 1e-7, "{}", flight.error_to(&attitude));
}

#[test]
fn a_regained_attitude_that_jumps_is_slewed_to_within_the_limits() {
    let attitude = random_attitude(13);
    let mut flight = Loop::new(settings(), attitude, hold(attitude));
    let drift = Attitude::default().turned(Vector3::new(0.05, -0.1, 0.02));
    for sample in 0..20_000_u32 {
        let is_valid = sample > 2000;
        let mut estimate = Estimate { is_valid, ..flight.body.estimate() };
        if !is_valid {
            estimate.attitude = drift.then(&estimate.attitude);
        }
        let torque = flight.sample_with(&estimate, &Vector3::zeros());
        assert!(torque.norm() < 0.15, "{sample} {torque}");
        flight.body.advance(&torque);
    }
    assert!(flight.error_to(&attitude) < 1e-7);
}

//! Excesses sample by sample, and what the monitor makes of them.
use crate::guidance::tests::geometry::nearest_zone;
use nalgebra::{Rotation3, Vector3};

use super::*;
use crate::bodies::Body;
use crate::guidance::constraints::hot_pole::HotPole;
use crate::guidance::tests::orbit::about_mercury;

const MONITOR: Monitor = Monitor { margin_rad: 0.1, persistence_s: 3.0 };

/// At which samples, a second apart, the monitor trips.
fn trips(excesses_rad: &[f64]) -> Vec<usize> {
    let mut state = MonitorState::default();
    let mut tripped = Vec::new();
    for (second, excess_rad) in excesses_rad.iter().enumerate() {
        if MONITOR.trips(&mut state, second as f64, *excess_rad) {
            tripped.push(second);
        }
    }
    tripped
}

#[test]
fn it_trips_when_a_violation_has_lasted() {
    assert_eq!(trips(&[-1.0, 0.05, 0.1, 0.1, 0.1, 0.1]), [0_usize; 0]);
    assert_eq!(trips(&[0.0, 0.2, 0.2, 0.2, 0.0, 0.2, 0.2, 0.2]), [0_usize; 0]);
    assert_eq!(trips(&[0.0, 0.2, 0.3, 0.2, 0.2, 0.0]), [4]);
    assert_eq!(trips(&[f64::NAN, f64::NEG_INFINITY, f64::NAN, 0.0]), [0_usize; 0]);
}

#[test]
fn a_safing_turn_that_makes_progress_is_left_alone() {
    assert_eq!(trips(&[2.0, 2.0, 2.0, 2.0, 1.9, 1.7, 1.4, 1.0, 0.5, 0.2, 0.0, 0.0]), [3]);
    assert_eq!(trips(&[2.0, 2.0, 2.0, 2.0, 1.9, 1.9, 2.1, 1.9, 1.9]), [3, 7]);
    assert_eq!(trips(&[2.0, 2.0, 2.0, 2.0, 2.0, 2.0, 2.0]), [3, 6]);
    // A new violation counts from its own begin.
    assert_eq!(trips(&[2.0, 2.0, 2.0, 2.0, 0.0, 2.0, 1.0, 0.5, 0.4]), [3, 8]);
}

#[test]
fn sun_and_hot_pole_are_watched_in_the_body_frame() {
    let zone = nearest_zone(0.3, 0.2);
    let cone = HotPole { altitude_m: 1e6, angle_rad: 0.5, cone_rad: 1.0 };
    let radius_m = Body::Mercury.data().radius_m;
    let around = |height_m: f64| {
        about_mercury(Vector3::x() * (radius_m + height_m), Vector3::x() * 5e10, Vector3::y() * 1e11)
    };
    // -Y at the Sun (+x), then turned by an angle about the body's own axis.
    let facing = Rotation3::from_axis_angle(&Vector3::z_axis(), std::f64::consts::FRAC_PI_2);
    let turned = |axis: Vector3<f64>, angle_rad: f64| {
        Attitude::from_rotation(&(facing * Rotation3::from_scaled_axis(axis * angle_rad)))
    };
    let excess_rad = |constraints: Constraints, axis, angle_rad, height_m| {
        excess(&constraints, &turned(axis, angle_rad), &around(height_m)).greatest_rad()
    };
    let sun_only = Constraints { keep_in: Some(zone), hot_pole: None };
    let both = Constraints { keep_in: Some(zone), hot_pole: Some(cone) };
    let close = |found: f64, expected: f64| assert!((found - expected).abs() < 1e-12, "{found} {expected}");
    close(excess_rad(sun_only, Vector3::z(), 0.0, 1e5), -0.2);
    close(excess_rad(sun_only, Vector3::z(), 0.5, 1e5), 0.2);
    close(excess_rad(sun_only, Vector3::x(), -0.5, 1e5), 0.3);
    // -Z is a right angle from the planet (at -x), less by the turn that raises the Sun's elevation away.
    close(excess_rad(both, Vector3::x(), 0.0, 1e5), -0.2);
    let toward = std::f64::consts::FRAC_PI_2 - 1.3;
    close(
        excess_rad(Constraints { keep_in: None, ..both }, Vector3::x(), 1.3, 1e5).max(1.0 - toward),
        1.0 - toward,
    );
    assert!(excess_rad(Constraints { keep_in: None, ..both }, Vector3::x(), 1.3, 2e6) == f64::NEG_INFINITY);
    assert!(excess_rad(Constraints::default(), Vector3::x(), 1.3, 1e5) == f64::NEG_INFINITY);
}

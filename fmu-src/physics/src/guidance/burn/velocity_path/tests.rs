//! Lengths against closed forms, points and turns against differences.
use approx::assert_relative_eq;

use super::*;
use crate::guidance::tests::geometry::Random;

/// A powered turn: the direction changes by less than a right angle.
fn turn(random: &mut Random) -> VelocityPath {
    let along = random.direction() * random.within(1.0, 900.0);
    let mut bent = || random.direction() * (0.2 * along.norm());
    VelocityPath::cubic([along, bent(), bent() * 0.5]).unwrap()
}

#[test]
fn a_straight_path_is_as_long_as_its_delta_v() {
    let delta_v = Vector3::new(3.0, -4.0, 12.0);
    let path = VelocityPath::linear(delta_v).unwrap();
    assert_relative_eq!(path.length_m_s(), 13.0, max_relative = 1e-15);
    for length_m_s in [-2.0, 0.0, 0.1, 6.5, 13.0, 20.0] {
        let point = path.point(length_m_s);
        assert_relative_eq!(point.velocity_m_s, delta_v * (length_m_s.max(0.0) / 13.0), epsilon = 1e-14);
        assert_relative_eq!(point.tangent, delta_v / 13.0, epsilon = 1e-15);
        assert_eq!(point.curvature_s_m, Vector3::zeros());
    }
    assert!(VelocityPath::linear(Vector3::zeros()).is_none());
    assert!(VelocityPath::linear(Vector3::repeat(f64::INFINITY)).is_none());
}

#[test]
fn the_length_of_a_parabola_is_its_closed_form() {
    // y = b s^2 over x = a s: with q = 2 b / a, (a/2) (sqrt(1 + q^2) + asinh(q)/q).
    let rotation = nalgebra::Rotation3::from_scaled_axis(Vector3::new(0.3, -1.0, 0.4));
    for (a, b) in [(10.0, 1.0), (10.0, 3.0), (850.0, 250.0)] {
        let coefficients = [rotation * Vector3::x() * a, rotation * Vector3::y() * b, Vector3::zeros()];
        let path = VelocityPath::cubic(coefficients).unwrap();
        let ratio: f64 = 2.0 * b / a;
        let expected = 0.5 * a * ((1.0 + ratio * ratio).sqrt() + ratio.asinh() / ratio);
        assert_relative_eq!(path.length_m_s(), expected, max_relative = 1e-12);
    }
    // A straight line run through unevenly is no longer for that.
    let uneven = [Vector3::x() * 2.0, Vector3::x() * 3.0, Vector3::x() * 4.0];
    assert_relative_eq!(VelocityPath::cubic(uneven).unwrap().length_m_s(), 9.0, max_relative = 1e-14);
}

#[test]
fn a_point_lies_at_its_length_along_the_chords() {
    let mut random = Random(5);
    for _ in 0..20 {
        let path = turn(&mut random);
        let whole = path.length_m_s();
        let count = 2000;
        let points: Vec<_> =
            (0..=count).map(|k| path.point(whole * f64::from(k) / f64::from(count))).collect();
        let end: Vector3<f64> = path.coefficients_m_s.iter().sum();
        assert_relative_eq!(points[count as usize].velocity_m_s, end, max_relative = 1e-14);
        let mut walked = 0.0;
        for (before, after) in points.iter().zip(&points[1..]) {
            let chord = (after.velocity_m_s - before.velocity_m_s).norm();
            // A chord is shorter by less than a part in 24 of the square of its turn.
            let turn_rad = before.tangent.angle(&after.tangent);
            let part = whole / f64::from(count);
            assert!((chord / part - 1.0).abs() < turn_rad * turn_rad / 20.0 + 1e-9, "{chord} {part}");
            walked += chord;
        }
        assert_relative_eq!(walked, whole, max_relative = 1e-6);
    }
}

#[test]
fn tangent_and_turn_are_derivatives_by_length() {
    let mut random = Random(9);
    for _ in 0..50 {
        let path = turn(&mut random);
        let (at, step) = (random.within(0.01, 0.99) * path.length_m_s(), path.length_m_s() * 1e-4);
        let [before, here, after] = [-step, 0.0, step].map(|by| path.point(at + by));
        let slope = (after.velocity_m_s - before.velocity_m_s) / (2.0 * step);
        assert_relative_eq!(slope, here.tangent, epsilon = 1e-7);
        let turn = (after.tangent - before.tangent) / (2.0 * step);
        assert_relative_eq!(turn, here.curvature_s_m, epsilon = 1e-6 / path.length_m_s());
        assert_relative_eq!(here.tangent.norm(), 1.0, epsilon = 1e-14);
    }
}

#[test]
fn a_profile_has_to_end_at_the_delta_v() {
    let zero = Vector3::zeros();
    let profile = [Vector3::x() * 3.0, Vector3::y(), Vector3::y()];
    let end = Vector3::new(3.0, 2.0, 0.0);
    let straight = VelocityPath::of_burn(end, [zero; 3]).unwrap().unwrap();
    assert_eq!(straight, VelocityPath::linear(end).unwrap());
    for delta_v in [zero, end] {
        let path = VelocityPath::of_burn(delta_v, profile).unwrap().unwrap();
        assert_eq!(path, VelocityPath::cubic(profile).unwrap());
    }
    let error = VelocityPath::of_burn(end * 1.01, profile).unwrap_err();
    assert!(error.to_string().contains("(3, 2, 0) m/s"), "{error}");
    assert_eq!(VelocityPath::of_burn(zero, [zero; 3]), Ok(None));
}

#[test]
fn a_path_that_begins_or_ends_at_rest_has_a_direction_there() {
    let slow_start = VelocityPath::cubic([Vector3::zeros(), Vector3::x() * 3.0, Vector3::y()]).unwrap();
    assert_relative_eq!(slow_start.point(0.0).tangent, Vector3::x(), epsilon = 1e-15);
    let slow_end = VelocityPath::cubic([Vector3::x() * 2.0, -Vector3::x(), Vector3::zeros()]).unwrap();
    assert_relative_eq!(slow_end.point(1.0).tangent, Vector3::x(), epsilon = 1e-15);
    let cubic = VelocityPath::cubic([Vector3::zeros(), Vector3::zeros(), Vector3::z()]).unwrap();
    assert_relative_eq!(cubic.point(0.0).tangent, Vector3::z(), epsilon = 1e-15);
    assert_relative_eq!(cubic.point(0.3).velocity_m_s, Vector3::z() * 0.3, epsilon = 1e-14);
}

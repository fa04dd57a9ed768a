//! Against eqs 8 to 16 as printed and corrected, against differences of the attitude, and in degenerate geometry.
use super::*;
use crate::guidance::geometry::moving::{matrix_value, moving, rate, value};
use approx::assert_relative_eq;
use nalgebra::Matrix3;

fn vectors(t: f64) -> PointingVectors {
    let at = |k: f64| {
        let (s, c) = (k * t + k).sin_cos();
        moving(
            Vector3::new(2.0 + s, c * k, 0.5 - s * c),
            Vector3::new(k * c, -s * k * k, -k * (c * c - s * s)),
        )
    };
    PointingVectors {
        boresight_body: at(0.3),
        aimpoint: at(1.1) * Moving::from_re(1e9),
        body_roll: at(-0.8),
        external_roll: at(2.3),
    }
}

/// Eqs 8 to 10, and 11 to 13: components along the prime axes.
fn printed_rate(a: &MovingVector, e: &MovingVector) -> Vector3<f64> {
    let (a, a_dot, e, e_dot) = (value(a), rate(a), value(e), rate(e));
    let normal = a.cross(&e);
    let across = normal.cross(&a);
    let turn = a.cross(&a_dot).cross(&a);
    Vector3::new(
        -across.dot(&(a.cross(&e_dot) + a_dot.cross(&e))) / (normal.norm_squared() * a.norm()),
        -normal.dot(&turn) / (normal.norm() * a.norm().powi(3)),
        across.dot(&turn) / (normal.norm() * a.norm().powi(4)),
    )
}

#[test]
fn the_rate_is_the_papers_in_prime_axes() {
    for i in 0..100 {
        let vectors = vectors(f64::from(i) * 0.17);
        let frame = vectors.pointing().unwrap().frame();
        let body_from_prime = {
            let x = value(&vectors.boresight_body).normalize();
            let z = x.cross(&value(&vectors.body_roll)).normalize();
            Matrix3::from_columns(&[x, z.cross(&x), z])
        };
        let prime = printed_rate(&vectors.aimpoint, &vectors.external_roll)
            - printed_rate(&vectors.boresight_body, &vectors.body_roll);
        assert_relative_eq!(frame.rate_body_rad_s, body_from_prime * prime, epsilon = 1e-12);
    }
}

#[test]
fn the_rate_is_the_derivative_of_the_attitude() {
    let step = 1e-4;
    let matrix = |t: f64| matrix_value(&vectors(t).pointing().unwrap().inertial_from_body);
    for i in 0..50 {
        let t = f64::from(i) * 0.31;
        let slope = (matrix(t - 2.0 * step) - matrix(t + 2.0 * step)
            + (matrix(t + step) - matrix(t - step)) * 8.0)
            / (12.0 * step);
        let skew = matrix(t).transpose() * slope;
        let expected = Vector3::new(skew[(2, 1)], skew[(0, 2)], skew[(1, 0)]);
        let found = vectors(t).pointing().unwrap().frame().rate_body_rad_s;
        assert_relative_eq!(found, expected, epsilon = 1e-9, max_relative = 1e-9);
    }
}

#[test]
fn the_boresight_lies_on_the_aimpoint_and_the_roll_vector_in_its_half_plane() {
    for i in 0..100 {
        let vectors = vectors(f64::from(i) * 0.13);
        let to_inertial = vectors.pointing().unwrap().frame().inertial_from_body;
        let boresight = to_inertial * value(&vectors.boresight_body).normalize();
        let aimpoint = value(&vectors.aimpoint).normalize();
        assert!(boresight.cross(&aimpoint).norm() < 1e-14 && boresight.dot(&aimpoint) > 0.0);
        let roll = to_inertial * value(&vectors.body_roll);
        let external = value(&vectors.external_roll);
        let normal = aimpoint.cross(&external).normalize();
        assert!(roll.dot(&normal).abs() < 1e-14 * roll.norm() && aimpoint.cross(&roll).dot(&normal) > 0.0);
    }
}

#[test]
fn degenerate_geometry_has_a_fallback_and_no_direction_no_command() {
    let some = vectors(1.0);
    for degenerate in [
        PointingVectors { external_roll: some.aimpoint, ..some },
        PointingVectors { external_roll: MovingVector::zeros(), ..some },
        PointingVectors { body_roll: -some.boresight_body, ..some },
        PointingVectors { aimpoint: fixed(Vector3::z()), external_roll: fixed(Vector3::z()), ..some },
        PointingVectors { boresight_body: fixed(-Vector3::y()), body_roll: fixed(Vector3::y()), ..some },
    ] {
        let pointing = degenerate.pointing().unwrap();
        assert!(pointing.degenerate);
        let matrix = matrix_value(&pointing.inertial_from_body);
        assert_relative_eq!(matrix * matrix.transpose(), Matrix3::identity(), epsilon = 1e-14);
        assert_relative_eq!(matrix.determinant(), 1.0, epsilon = 1e-14);
        assert!(pointing.frame().rate_body_rad_s.iter().all(|x| x.is_finite()));
    }
    assert!(PointingVectors { aimpoint: MovingVector::zeros(), ..some }.pointing().is_none());
    assert!(PointingVectors { boresight_body: MovingVector::zeros(), ..some }.pointing().is_none());
    assert!(!some.pointing().unwrap().degenerate);
}

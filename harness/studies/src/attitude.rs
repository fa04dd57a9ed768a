//! Attitudes as scalar-last quaternions from EME2000 to the body frame, and angles that stay exact when they are small.

use nalgebra::{Quaternion, Vector3};

/// Three components.
pub(crate) type Vector = Vector3<f64>;

/// A unit quaternion of a passive rotation, as the FMUs have it.
pub(crate) type Attitude = Quaternion<f64>;

/// v / |v|, by the norm's reciprocal.
pub(crate) fn unit(v: &Vector) -> Vector {
    v * (1.0 / v.norm())
}

/// Angle between two vectors, in rad.
pub(crate) fn angle_rad(a: &Vector, b: &Vector) -> f64 {
    a.cross(b).norm().atan2(a.dot(b))
}

/// The part of v across the unit vector `axis`.
pub(crate) fn across(v: &Vector, axis: &Vector) -> Vector {
    v - axis * v.dot(axis)
}

/// Body components of an inertial vector.
pub(crate) fn to_body(q: &Attitude, v: &Vector) -> Vector {
    let axis = q.imag();
    let t = axis.cross(v) * 2.0;
    v - t * q.scalar() + axis.cross(&t)
}

/// Inertial components of a body vector.
pub(crate) fn to_inertial(q: &Attitude, v: &Vector) -> Vector {
    to_body(&q.conjugate(), v)
}

/// The attitude `q` after `duration_s` at a constant body rate, in closed form.
pub(crate) fn rotated(q: &Attitude, rate_rad_s: &Vector, duration_s: f64) -> Attitude {
    let rate = rate_rad_s.norm();
    if rate == 0.0 {
        return *q;
    }
    let (sine, cosine) = (0.5 * rate * duration_s).sin_cos();
    product(q, &Quaternion::from_parts(cosine, rate_rad_s * (sine / rate)))
}

/// The attitude that `a` and then `b`, of the body, lead to.
fn product(a: &Attitude, b: &Attitude) -> Attitude {
    let (v, w) = (a.imag(), b.imag());
    let imaginary = v * b.scalar() + w * a.scalar() + v.cross(&w);
    Quaternion::from_parts(b.scalar() * a.scalar() - w.dot(&v), imaginary)
}

/// The rotation that turns a body from one attitude into another, at most half a turn, in body components, in rad.
pub(crate) fn rotation_vector(from: &Attitude, to: &Attitude) -> Vector {
    let between = product(&from.conjugate(), to);
    let axis = if between.scalar() < 0.0 { -between.imag() } else { between.imag() };
    let sine = axis.norm();
    if sine == 0.0 { axis } else { axis * (2.0 * sine.atan2(between.scalar().abs()) / sine) }
}

/// Azimuth from -Y toward +X and elevation toward -Z of a body direction, in deg; azimuths from -90 to 270 deg, so that
/// neither -Y nor +Y is at a jump.
pub(crate) fn body_angles_deg(direction: &Vector) -> [f64; 2] {
    let azimuth_deg = direction.x.atan2(-direction.y).to_degrees();
    let turns = if azimuth_deg < -90.0 { 360.0 } else { 0.0 };
    [azimuth_deg + turns, (-direction.z).atan2(direction.x.hypot(direction.y)).to_degrees()]
}

/// The body direction of an azimuth and an elevation, in rad.
pub(crate) fn body_direction(azimuth_rad: f64, elevation_rad: f64) -> Vector {
    let ((sin_a, cos_a), (sin_e, cos_e)) = (azimuth_rad.sin_cos(), elevation_rad.sin_cos());
    Vector::new(cos_e * sin_a, -cos_e * cos_a, -sin_e)
}

#[cfg(test)]
mod tests {
    //! A turn about one axis by a known angle, there and back.
    use super::*;

    #[test]
    fn a_body_that_turns_about_z_sees_x_go_toward_minus_y() {
        let rate_rad_s = Vector::new(0.0, 0.0, 0.1);
        let q = rotated(&Quaternion::identity(), &rate_rad_s, 5.0);
        let seen = to_body(&q, &Vector::x());
        let expected = Vector::new(0.5f64.cos(), -(0.5f64.sin()), 0.0);
        assert!((seen - expected).norm() < 1e-15, "{seen:?}");
        assert!((to_inertial(&q, &seen) - Vector::x()).norm() < 1e-15);
        let back = rotated(&q, &rate_rad_s, -5.0);
        assert!((back.w - 1.0).abs() < 1e-15 && back.k.abs() < 1e-15);
        assert!((angle_rad(&Vector::x(), &seen) - 0.5).abs() < 1e-15);
    }

    #[test]
    fn the_rotation_between_two_attitudes_is_the_turn_that_was_made() {
        let from = rotated(&Quaternion::identity(), &Vector::new(0.3, -0.2, 0.7), 1.0);
        for turn in [[0.0, 2.5, 0.0], [1e-9, -2e-9, 0.0], [0.4, 0.5, -0.6]].map(Vector::from) {
            let found = rotation_vector(&from, &-rotated(&from, &turn, 1.0));
            assert!((found - turn).norm() < 1e-15, "{found:?}");
        }
        // More than half a turn is less the other way.
        let found = rotation_vector(&from, &rotated(&from, &Vector::new(4.0, 0.0, 0.0), 1.0));
        assert!((found.x - (4.0 - 2.0 * std::f64::consts::PI)).abs() < 1e-14, "{found:?}");
    }
}

//! Vectors of three numbers and what scalar-last quaternions do to them.

/// Three components.
pub(crate) type Vector = [f64; 3];

/// a + b.
pub(crate) fn sum(a: &Vector, b: &Vector) -> Vector {
    [0, 1, 2].map(|i| a[i] + b[i])
}

/// a - b.
pub(crate) fn difference(a: &Vector, b: &Vector) -> Vector {
    [0, 1, 2].map(|i| a[i] - b[i])
}

/// factor v.
pub(crate) fn scaled(v: &Vector, factor: f64) -> Vector {
    v.map(|x| factor * x)
}

/// a . b.
pub(crate) fn dot(a: &Vector, b: &Vector) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// a x b.
pub(crate) fn cross(a: &Vector, b: &Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// |v|.
pub(crate) fn norm(v: &Vector) -> f64 {
    dot(v, v).sqrt()
}

/// v / |v|.
pub(crate) fn unit(v: &Vector) -> Vector {
    scaled(v, 1.0 / norm(v))
}

/// Angle between two vectors, in rad; exact for small ones too.
pub(crate) fn angle_rad(a: &Vector, b: &Vector) -> f64 {
    norm(&cross(a, b)).atan2(dot(a, b))
}

/// The part of v across the unit vector `axis`.
pub(crate) fn across(v: &Vector, axis: &Vector) -> Vector {
    difference(v, &scaled(axis, dot(v, axis)))
}

/// Components in the frame a scalar-last quaternion leads to: passive rotation.
pub(crate) fn turn(q: &[f64; 4], v: &Vector) -> Vector {
    let axis = [q[0], q[1], q[2]];
    let t = scaled(&cross(&axis, v), 2.0);
    let tt = cross(&axis, &t);
    [0, 1, 2].map(|i| v[i] - q[3] * t[i] + tt[i])
}

/// Components in the frame a scalar-last quaternion comes from.
pub(crate) fn turn_back(q: &[f64; 4], v: &Vector) -> Vector {
    turn(&[-q[0], -q[1], -q[2], q[3]], v)
}

/// The attitude `q` after `duration_s` at a constant body rate, in closed form.
pub(crate) fn rotated(q: &[f64; 4], rate_rad_s: &Vector, duration_s: f64) -> [f64; 4] {
    let rate = norm(rate_rad_s);
    if rate == 0.0 {
        return *q;
    }
    let (sine, cosine) = (0.5 * rate * duration_s).sin_cos();
    let [x, y, z] = scaled(rate_rad_s, sine / rate);
    product(q, &[x, y, z, cosine])
}

/// The attitude that `a` and then `b`, of the body, lead to.
fn product(a: &[f64; 4], b: &[f64; 4]) -> [f64; 4] {
    let ([v, w], [a_scalar, b_scalar]) = ([a, b].map(|q| [q[0], q[1], q[2]]), [a[3], b[3]]);
    let vw = cross(&v, &w);
    let [x, y, z] = [0, 1, 2].map(|i| b_scalar * v[i] + w[i] * a_scalar + vw[i]);
    [x, y, z, b_scalar * a_scalar - dot(&w, &v)]
}

/// The rotation that turns a body from one attitude into another, at most half a turn, in body components, in rad.
pub(crate) fn rotation_vector(from: &[f64; 4], to: &[f64; 4]) -> Vector {
    let [x, y, z, scalar] = product(&[-from[0], -from[1], -from[2], from[3]], to);
    let axis = if scalar < 0.0 { [-x, -y, -z] } else { [x, y, z] };
    let sine = norm(&axis);
    if sine == 0.0 { axis } else { scaled(&axis, 2.0 * sine.atan2(scalar.abs()) / sine) }
}

/// Azimuth from -Y toward +X and elevation toward -Z of a body direction, in deg; azimuths from -90 to 270 deg, so that
/// neither -Y nor +Y is at a jump.
pub(crate) fn body_angles_deg([x, y, z]: &Vector) -> [f64; 2] {
    let azimuth_deg = x.atan2(-y).to_degrees();
    let turns = if azimuth_deg < -90.0 { 360.0 } else { 0.0 };
    [azimuth_deg + turns, (-z).atan2(x.hypot(*y)).to_degrees()]
}

#[cfg(test)]
mod tests {
    //! A turn about one axis by a known angle, there and back.
    use super::*;

    #[test]
    fn a_body_that_turns_about_z_sees_x_go_toward_minus_y() {
        let q = rotated(&[0.0, 0.0, 0.0, 1.0], &[0.0, 0.0, 0.1], 5.0);
        let seen = turn(&q, &[1.0, 0.0, 0.0]);
        let expected = [0.5f64.cos(), -(0.5f64.sin()), 0.0];
        assert!(norm(&difference(&seen, &expected)) < 1e-15, "{seen:?}");
        assert!(norm(&difference(&turn_back(&q, &seen), &[1.0, 0.0, 0.0])) < 1e-15);
        let back = rotated(&q, &[0.0, 0.0, 0.1], -5.0);
        assert!((back[3] - 1.0).abs() < 1e-15 && back[2].abs() < 1e-15);
        assert!((angle_rad(&[1.0, 0.0, 0.0], &seen) - 0.5).abs() < 1e-15);
    }

    #[test]
    fn the_rotation_between_two_attitudes_is_the_turn_that_was_made() {
        let from = rotated(&[0.0, 0.0, 0.0, 1.0], &[0.3, -0.2, 0.7], 1.0);
        for turn in [[0.0, 2.5, 0.0], [1e-9, -2e-9, 0.0], [0.4, 0.5, -0.6]] {
            let found = rotation_vector(&from, &rotated(&from, &turn, 1.0).map(|x| -x));
            assert!(norm(&difference(&found, &turn)) < 1e-15, "{found:?}");
        }
        // More than half a turn is less the other way.
        let found = rotation_vector(&from, &rotated(&from, &[4.0, 0.0, 0.0], 1.0));
        assert!((found[0] - (4.0 - 2.0 * std::f64::consts::PI)).abs() < 1e-14, "{found:?}");
    }
}

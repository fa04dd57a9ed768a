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
    let w = scaled(rate_rad_s, sine / rate);
    let v = [q[0], q[1], q[2]];
    let vw = cross(&v, &w);
    let [x, y, z] = [0, 1, 2].map(|i| cosine * v[i] + w[i] * q[3] + vw[i]);
    [x, y, z, cosine * q[3] - dot(&w, &v)]
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
}

//! Principal moments and axes of an inertia tensor, by Jacobi's rotations.
//!
//! Each rotation about one axis makes one product of inertia 0; the others converge quadratically (Golub and Van Loan,
//! "Matrix Computations", section 8.5). Moments of axes that nearly coincide with the body's keep their relative accuracy.

use nalgebra::{Matrix3, Vector3};

use super::quaternion::Quaternion;

/// Sweeps over the three products; five are enough for any tensor.
const SWEEPS: usize = 12;

/// Moments about the principal axes, in kg m2, and those axes as an attitude in the body frame.
///
/// The third axis is the one nearest to the body's third, the first that of the others nearest to the body's first; both
/// point to its side.
pub(super) fn principal_axes(tensor_body_kg_m2: &Matrix3<f64>) -> ([f64; 3], Quaternion) {
    let mut tensor = *tensor_body_kg_m2;
    let mut axes = Matrix3::identity();
    for _ in 0..SWEEPS {
        for (p, q) in [(0, 1), (0, 2), (1, 2)] {
            rotate(&mut tensor, &mut axes, p, q);
        }
    }
    let along = |body_axis: usize, k: usize| axes[(body_axis, k)].abs();
    let nearest = |body_axis: usize, one: usize, other: usize| {
        if along(body_axis, other) > along(body_axis, one) { other } else { one }
    };
    let third = nearest(2, 2, nearest(2, 0, 1));
    let [one, other] = [[1, 2], [0, 2], [0, 1]][third];
    let first = nearest(0, one, other);
    let second = 3 - third - first;
    let toward = |body_axis: usize, k: usize| -> Vector3<f64> {
        let axis: Vector3<f64> = axes.column(k).into();
        if axis[body_axis] < 0.0 { -axis } else { axis }
    };
    let (x, z) = (toward(0, first), toward(2, third));
    let moments = [first, second, third].map(|k| tensor[(k, k)]);
    (moments, quaternion(&Matrix3::from_columns(&[x, z.cross(&x), z])))
}

/// Makes the product of axes `p` and `q` 0.
fn rotate(tensor: &mut Matrix3<f64>, axes: &mut Matrix3<f64>, p: usize, q: usize) {
    let product = tensor[(p, q)];
    if product == 0.0 {
        return;
    }
    // The smaller of both angles: tan(2 angle) = 2 product / (J_qq - J_pp).
    let half_cotangent = (tensor[(q, q)] - tensor[(p, p)]) / (2.0 * product);
    let tangent = if half_cotangent >= 0.0 { 1.0 } else { -1.0 }
        / (half_cotangent.abs() + libm::hypot(1.0, half_cotangent));
    let cosine = libm::hypot(1.0, tangent).recip();
    let sine = tangent * cosine;
    tensor[(p, p)] -= tangent * product;
    tensor[(q, q)] += tangent * product;
    (tensor[(p, q)], tensor[(q, p)]) = (0.0, 0.0);
    let r = 3 - p - q;
    let (rp, rq) = (tensor[(r, p)], tensor[(r, q)]);
    let (new_rp, new_rq) = (cosine * rp - sine * rq, sine * rp + cosine * rq);
    (tensor[(r, p)], tensor[(p, r)]) = (new_rp, new_rp);
    (tensor[(r, q)], tensor[(q, r)]) = (new_rq, new_rq);
    for i in 0..3 {
        let (ip, iq) = (axes[(i, p)], axes[(i, q)]);
        axes[(i, p)] = cosine * ip - sine * iq;
        axes[(i, q)] = sine * ip + cosine * iq;
    }
}

/// The attitude whose axes are the columns of a rotation matrix: the greatest component first, so that nothing cancels.
fn quaternion(m: &Matrix3<f64>) -> Quaternion {
    let trace = m.trace();
    let diagonal = [m[(0, 0)], m[(1, 1)], m[(2, 2)]];
    let largest = (0..3).fold(3, |best, i| {
        let least = if best == 3 { trace } else { diagonal[best] };
        if diagonal[i] > least { i } else { best }
    });
    if largest == 3 {
        let parts = [m[(2, 1)] - m[(1, 2)], m[(0, 2)] - m[(2, 0)], m[(1, 0)] - m[(0, 1)], 1.0 + trace];
        return Quaternion(parts).normalized();
    }
    let (i, j, k) = (largest, (largest + 1) % 3, (largest + 2) % 3);
    let mut parts = [0.0; 4];
    parts[i] = 1.0 + 2.0 * diagonal[i] - trace;
    parts[j] = m[(i, j)] + m[(j, i)];
    parts[k] = m[(i, k)] + m[(k, i)];
    parts[3] = m[(k, j)] - m[(j, k)];
    Quaternion(parts).normalized()
}

#[cfg(test)]
mod tests {
    //! Tensors put together from moments and turned axes give both back.
    use super::*;
    use approx::assert_relative_eq;
    use nalgebra::Rotation3;

    #[test]
    fn a_turned_body_gives_back_its_moments_and_axes() {
        let moments = Vector3::new(210.0, 260.0, 353.0);
        for angle_rad in [0.0, 1e-9, 1e-3, 0.2, 0.7] {
            for axis in [Vector3::x(), Vector3::new(0.3, -0.8, 0.5), Vector3::new(-0.6, 0.1, 0.7)] {
                let turned = Rotation3::new(axis.normalize() * angle_rad);
                let tensor = turned * Matrix3::from_diagonal(&moments) * turned.inverse();
                let (found, axes) = principal_axes(&tensor);
                assert_relative_eq!(Vector3::from(found), moments, max_relative = 1e-14);
                for (k, unit) in [Vector3::x(), Vector3::y(), Vector3::z()].iter().enumerate() {
                    let expected: Vector3<f64> = turned.matrix().column(k).into();
                    assert_relative_eq!(axes.inertial_from_body(unit), expected, epsilon = 2e-14);
                }
            }
        }
    }

    #[test]
    fn the_third_axis_is_the_one_nearest_to_z_whatever_its_moment() {
        for moments in [[350.0, 200.0, 210.0], [200.0, 350.0, 210.0], [210.0, 200.0, 350.0]] {
            let turned = Rotation3::new(Vector3::new(0.4, -0.5, 0.3));
            let diagonal = Matrix3::from_diagonal(&Vector3::from(moments));
            let (found, axes) = principal_axes(&(turned * diagonal * turned.inverse()));
            assert_relative_eq!(Vector3::from(found), Vector3::from(moments), max_relative = 1e-14);
            assert_relative_eq!(axes.spin_axis_inertial(), turned * Vector3::z(), epsilon = 1e-14);
        }
    }
}

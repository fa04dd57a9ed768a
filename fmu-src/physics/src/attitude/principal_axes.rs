//! Principal moments and axes of an inertia tensor.

use nalgebra::{Matrix3, Rotation3, SymmetricEigen, Vector3};

use super::quaternion::Quaternion;
use super::rotation::Attitude;

/// Moments about the principal axes, in kg m2, and those axes as an attitude in the body frame.
///
/// The third axis is the one nearest to the body's third, the first that of the others nearest to the body's first; both
/// point to its side.
pub(super) fn principal_axes(tensor_body_kg_m2: &Matrix3<f64>) -> ([f64; 3], Quaternion) {
    let SymmetricEigen { eigenvalues, eigenvectors: axes } = SymmetricEigen::new(*tensor_body_kg_m2);
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
    let moments = [first, second, third].map(|k| eigenvalues[k]);
    let body_axes = Rotation3::from_matrix_unchecked(Matrix3::from_columns(&[x, z.cross(&x), z]));
    (moments, Attitude::from_rotation(&body_axes).unit_quaternion())
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

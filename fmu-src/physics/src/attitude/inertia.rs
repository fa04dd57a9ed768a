//! Moments and products of inertia of a rigid body, and its principal axes.
//!
//! The tensor in body axes is J = [[J1, P12, P13], [P12, J2, P23], [P13, P23, J3]] with P_ij = -integral of x_i x_j dm: its
//! elements, as `spacecraft.inertia[i,j]` of a three-axis spacecraft has them.

use nalgebra::{Matrix3, Rotation3, SymmetricEigen, Vector3};
use serde::{Deserialize, Serialize};

use super::quaternion::Quaternion;
use super::rotation::Attitude;

use crate::math;

/// Moments that differ by less than this (relative) count as equal: the body is axisymmetric.
const AXISYMMETRY: f64 = 1e-13;

/// Principal moments of inertia about the centre of mass and where their axes lie in the body; the third principal axis, the
/// one nearest to the body's third, is the axis of spin.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Inertia {
    principal_kg_m2: [f64; 3],
    /// The principal axes as an attitude in the body frame; `None` where they are the body's.
    axes: Option<Quaternion>,
}

/// Why three numbers are no moments of inertia.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum InertiaError {
    /// A moment is not a positive finite number.
    #[error("inertia[{index}] is {value} kg m2; a moment of inertia is a positive finite number")]
    NotPositive {
        /// 1-based.
        index: usize,
        /// Value found, in kg m2.
        value: f64,
    },
    /// No distribution of mass has these moments.
    #[error(
        "inertia[{index}] is {value} kg m2, more than the sum {sum:.6} kg m2 of the other two: no distribution of mass \
         has that (triangle inequality)"
    )]
    Triangle {
        /// 1-based.
        index: usize,
        /// Value found, in kg m2.
        value: f64,
        /// Sum of the other two.
        sum: f64,
    },
    /// A product of inertia is not finite.
    #[error("productsOfInertia[{index}] is {value} kg m2; a product of inertia is a finite number")]
    Product {
        /// 1-based.
        index: usize,
        /// Value found, in kg m2.
        value: f64,
    },
    /// Moments and products together are those of no body.
    #[error(
        "inertia {diagonal:?} with productsOfInertia {products:?} has the principal moments {principal:?} kg m2; principal \
         moments are positive, and none is greater than the sum of the other two (triangle inequality)"
    )]
    Tensor {
        /// Moments about the body axes, in kg m2.
        diagonal: [f64; 3],
        /// Products 12, 13, 23, in kg m2.
        products: [f64; 3],
        /// In kg m2.
        principal: [f64; 3],
    },
}

impl Inertia {
    /// Checks the moments: positive, finite, none greater than the sum of the other two.
    pub fn new(principal_kg_m2: [f64; 3]) -> Result<Self, InertiaError> {
        check_positive(&principal_kg_m2)?;
        for (i, &value) in principal_kg_m2.iter().enumerate() {
            let sum = principal_kg_m2.iter().sum::<f64>() - value;
            if value > sum {
                return Err(InertiaError::Triangle { index: i + 1, value, sum });
            }
        }
        Ok(Self { principal_kg_m2, axes: None })
    }

    /// A body with moments about its axes and products 12, 13, 23, in kg m2.
    ///
    /// # Errors
    /// Numbers that are not finite, or a tensor that no distribution of mass has.
    pub fn with_products(diagonal_kg_m2: [f64; 3], products_kg_m2: [f64; 3]) -> Result<Self, InertiaError> {
        if products_kg_m2 == [0.0; 3] {
            return Self::new(diagonal_kg_m2);
        }
        check_positive(&diagonal_kg_m2)?;
        if let Some(i) = products_kg_m2.iter().position(|value| !value.is_finite()) {
            return Err(InertiaError::Product { index: i + 1, value: products_kg_m2[i] });
        }
        let ([j1, j2, j3], [p12, p13, p23]) = (diagonal_kg_m2, products_kg_m2);
        let (principal, axes) = principal_axes(&Matrix3::new(j1, p12, p13, p12, j2, p23, p13, p23, j3));
        let (diagonal, products) = (diagonal_kg_m2, products_kg_m2);
        let refused = |_| InertiaError::Tensor { diagonal, products, principal };
        Ok(Self { axes: Some(axes), ..Self::new(principal).map_err(refused)? })
    }

    /// Whether decoded numbers can be some.
    pub fn is_valid(&self) -> bool {
        let is_unit = |it: Quaternion| (it.0.iter().map(|c| c * c).sum::<f64>() - 1.0).abs() < 1e-12;
        Self::new(self.principal_kg_m2).is_ok() && self.axes.is_none_or(is_unit)
    }

    /// Components along the principal axes of a vector in body components.
    #[inline]
    pub fn principal_from_body(&self, v_body: &Vector3<f64>) -> Vector3<f64> {
        self.axes.map_or(*v_body, |axes| axes.body_from_inertial(v_body))
    }

    /// Body components of a vector along the principal axes.
    #[inline]
    pub fn body_from_principal(&self, v_principal: &Vector3<f64>) -> Vector3<f64> {
        self.axes.map_or(*v_principal, |axes| axes.inertial_from_body(v_principal))
    }

    /// Attitude of the principal axes of a body in this attitude.
    #[inline]
    pub fn principal_attitude(&self, body: Quaternion) -> Quaternion {
        self.axes.map_or(body, |axes| body.after(axes))
    }

    /// Attitude of the body whose principal axes have this attitude.
    #[inline]
    pub fn body_attitude(&self, principal: Quaternion) -> Quaternion {
        self.axes.map_or(principal, |Quaternion([x, y, z, w])| principal.after(Quaternion([-x, -y, -z, w])))
    }

    /// The third principal axis, body components.
    pub fn spin_axis_body(&self) -> Vector3<f64> {
        self.body_from_principal(&Vector3::z())
    }

    /// Components of a vector, given in body components, along the body's first and second axis made perpendicular to the third
    /// principal axis, and along that: azimuths of spin and nutation count in this frame.
    pub fn spin_frame_from_body(&self, v_body: &Vector3<f64>) -> Vector3<f64> {
        self.axes.map_or(*v_body, |_| self.spin_frame_body().tr_mul(v_body))
    }

    /// Body components of a vector given along the axes of [`Self::spin_frame_from_body`].
    pub fn body_from_spin_frame(&self, v: &Vector3<f64>) -> Vector3<f64> {
        self.axes.map_or(*v, |_| self.spin_frame_body() * v)
    }

    /// The axes of that frame as columns.
    fn spin_frame_body(&self) -> Matrix3<f64> {
        let axis = self.spin_axis_body();
        let first = (Vector3::x() - axis * axis.x).normalize();
        Matrix3::from_columns(&[first, axis.cross(&first), axis])
    }

    /// Angle between the body's third axis and the third principal axis, in rad (Wertz: coning).
    pub fn coning_rad(&self) -> f64 {
        let axis = self.spin_axis_body();
        math::atan2(math::hypot(axis.x, axis.y), axis.z)
    }

    /// Angular rate J^-1 h of the momentum `momentum_body`, body components, in rad/s.
    #[inline]
    pub fn rate_rad_s(&self, momentum_body: &Vector3<f64>) -> Vector3<f64> {
        let [i1, i2, i3] = self.principal_kg_m2;
        let h = self.principal_from_body(momentum_body);
        self.body_from_principal(&Vector3::new(h.x / i1, h.y / i2, h.z / i3))
    }

    /// An axisymmetric body of spin inertia I3 and ratio I3/I_T.
    pub fn axisymmetric(spin_kg_m2: f64, ratio: f64) -> Result<Self, InertiaError> {
        let transverse = spin_kg_m2 / ratio;
        Self::new([transverse, transverse, spin_kg_m2])
    }

    /// I1, I2, I3.
    pub fn principal_kg_m2(&self) -> [f64; 3] {
        self.principal_kg_m2
    }

    /// I3.
    pub fn spin_kg_m2(&self) -> f64 {
        self.principal_kg_m2[2]
    }

    /// I3/I_T with I_T = sqrt(I1 I2), paper 002 after eq 11.
    pub fn ratio(&self) -> f64 {
        self.spin_kg_m2() / (self.principal_kg_m2[0] * self.principal_kg_m2[1]).sqrt()
    }

    /// Whether I1 = I2.
    pub fn is_axisymmetric(&self) -> bool {
        let [i1, i2, _] = self.principal_kg_m2;
        (i1 - i2).abs() <= AXISYMMETRY * i1.max(i2)
    }

    /// Whether the spin axis is the axis of greatest inertia, about which a body that dissipates energy is stable.
    pub fn spins_about_major_axis(&self) -> bool {
        let [i1, i2, i3] = self.principal_kg_m2;
        i3 > i1 && i3 > i2
    }

    /// lambda / Omega for small nutation: the rate at which the transverse rate turns in the body, per spin rate.
    ///
    /// r - 1 for an axisymmetric body, +-sqrt((I3/I1 - 1)(I3/I2 - 1)) in general (negative about the minor axis);
    /// `None` about the intermediate axis, where nutation does not oscillate. `sqrt(I1 I2)` in place of I_T is not
    /// the right mean for a triaxial body.
    pub fn body_nutation_ratio(&self) -> Option<f64> {
        let [i1, i2, i3] = self.principal_kg_m2;
        if self.is_axisymmetric() {
            return Some(i3 / i1 - 1.0);
        }
        let (a, b) = (i3 / i1 - 1.0, i3 / i2 - 1.0);
        (a * b > 0.0).then(|| (a * b).sqrt().copysign(a))
    }

    /// Inertial nutation rate over spin rate: I3/I_T for an axisymmetric body, 1 + sqrt(...) in general (eq 11).
    pub fn inertial_nutation_ratio(&self) -> Option<f64> {
        self.body_nutation_ratio().map(|ratio| 1.0 + ratio)
    }
}

fn check_positive(moments_kg_m2: &[f64; 3]) -> Result<(), InertiaError> {
    let bad = moments_kg_m2.iter().position(|moment| !(moment.is_finite() && *moment > 0.0));
    bad.map_or(Ok(()), |i| Err(InertiaError::NotPositive { index: i + 1, value: moments_kg_m2[i] }))
}

/// Moments about the principal axes, in kg m2, and those axes as an attitude in the body frame.
///
/// The third axis is the one nearest to the body's third, the first that of the others nearest to the body's first; both
/// point to its side.
fn principal_axes(tensor_body_kg_m2: &Matrix3<f64>) -> ([f64; 3], Quaternion) {
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

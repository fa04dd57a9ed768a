//! The attitude: a rotation between the inertial and the body frame, and its motion under a constant rate.

use core::ops::RangeInclusive;

use nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector3};
use serde::{Deserialize, Serialize};

use super::quaternion::Quaternion;

/// Orientation of the body frame in EME2000.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Attitude {
    quaternion: Quaternion,
}

/// Four numbers that are no rotation.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("quaternion [{}, {}, {}, {}] has norm {norm}, needed is {allowed}", .found[0], .found[1], .found[2], .found[3])]
pub struct QuaternionError {
    /// Quaternion found, scalar last.
    pub found: [f64; 4],
    /// Its norm.
    pub norm: f64,
    /// Allowed norm.
    pub allowed: &'static str,
}

impl Attitude {
    /// From a scalar-last quaternion (EME2000 to body); its norm may be off by 1e-3 and is restored to 1.
    pub fn from_quaternion(q: [f64; 4]) -> Result<Self, QuaternionError> {
        Self::restored(q, 0.999..=1.001, "1 (within 1e-3)")
    }

    /// Returns the norm of four numbers where it differs from 1 by more than `tolerance`.
    pub fn norm_if_far_from_unit(q: [f64; 4], tolerance: f64) -> Option<f64> {
        let norm = q.iter().map(|component| component * component).sum::<f64>().sqrt();
        ((norm - 1.0).abs() > tolerance).then_some(norm)
    }

    /// From four numbers that point along a scalar-last quaternion (EME2000 to body), as masters make them that
    /// interpolate component by component; a norm of 0.1 to 10 is restored to 1.
    pub fn along_quaternion(q: [f64; 4]) -> Result<Self, QuaternionError> {
        Self::restored(q, 0.1..=10.0, "0.1 to 10 (it is then restored to 1)")
    }

    fn restored(
        q: [f64; 4],
        norms: RangeInclusive<f64>,
        allowed: &'static str,
    ) -> Result<Self, QuaternionError> {
        let norm = q.iter().map(|x| x * x).sum::<f64>().sqrt();
        if !norms.contains(&norm) {
            return Err(QuaternionError { found: q, norm, allowed });
        }
        Ok(Self { quaternion: Quaternion(q.map(|x| x / norm)) })
    }

    /// From a quaternion of norm 1.
    pub fn from_unit(quaternion: Quaternion) -> Self {
        Self { quaternion }
    }

    /// The quaternion, of norm 1 within rounding.
    pub fn unit_quaternion(&self) -> Quaternion {
        self.quaternion
    }

    /// From the body axes as columns in inertial components.
    pub fn from_rotation(inertial_from_body: &Rotation3<f64>) -> Self {
        Self::from_unit_quaternion(&UnitQuaternion::from_rotation_matrix(inertial_from_body))
    }

    /// Scalar-last quaternion (EME2000 to body), of the two signs the one nearest to `near`.
    pub fn quaternion(&self, near: Option<[f64; 4]>) -> [f64; 4] {
        let q = self.quaternion.0;
        let along = near.map_or(q[3], |near| q.iter().zip(near).map(|(a, b)| a * b).sum());
        let sign = if along < 0.0 { -1.0 } else { 1.0 };
        q.map(|x| sign * x)
    }

    /// The same attitude, of the two signs of its quaternion with the one nearer to `near`.
    #[must_use]
    pub fn continuing(&self, near: &Quaternion) -> Self {
        Self { quaternion: Quaternion(self.quaternion(Some(near.0))) }
    }

    /// How the quaternion changes at a body rate in rad/s, per second: q (w, 0) / 2.
    pub fn quaternion_rate(&self, rate_body_rad_s: &Vector3<f64>) -> [f64; 4] {
        let [x, y, z] = (rate_body_rad_s * 0.5).into();
        self.quaternion.after(Quaternion([x, y, z, 0.0])).0
    }

    /// Matrix that takes body components to inertial components.
    pub fn inertial_from_body(&self) -> Rotation3<f64> {
        self.unit().to_rotation_matrix()
    }

    /// The attitude after `duration_s` at the constant body rate `rate_body_rad_s`.
    pub fn propagated(&self, rate_body_rad_s: Vector3<f64>, duration_s: f64) -> Self {
        self.turned(rate_body_rad_s * duration_s)
    }

    /// The attitude after a rotation by the body-fixed vector `angle_body_rad`.
    pub fn turned(&self, angle_body_rad: Vector3<f64>) -> Self {
        Self::from_unit_quaternion(&(self.unit() * UnitQuaternion::from_scaled_axis(angle_body_rad)))
    }

    /// The opposite rotation: from the body frame to the inertial one.
    pub fn inverse(&self) -> Self {
        Self::from_unit_quaternion(&self.unit().inverse())
    }

    /// A vector's inertial components from those in the body frame.
    pub fn to_inertial(&self, body: &Vector3<f64>) -> Vector3<f64> {
        self.inertial_from_body() * body
    }

    /// Whether it is a rotation: every number finite, the norm 1 within rounding.
    pub fn is_rotation(&self) -> bool {
        (self.unit().coords.norm() - 1.0).abs() < 1e-9
    }

    /// The attitude after the rotation `by` (from this body frame to the new one).
    pub fn then(&self, by: &Self) -> Self {
        Self::from_unit_quaternion(&(self.unit() * by.unit()))
    }

    /// A vector's body components from those in the inertial frame.
    pub fn to_body(&self, inertial: &Vector3<f64>) -> Vector3<f64> {
        self.quaternion.body_from_inertial(inertial)
    }

    /// The rotation vector, at most pi long, that turns this attitude into `other`, in rad; its components are the
    /// same in both frames.
    pub fn rotation_vector_to(&self, other: &Self) -> Vector3<f64> {
        (self.unit().inverse() * other.unit()).scaled_axis()
    }

    /// The same attitude with norm 1 to rounding, after many compositions.
    #[must_use]
    pub fn normalized(&self) -> Self {
        Self { quaternion: self.quaternion.normalized() }
    }

    fn from_unit_quaternion(inertial_from_body: &UnitQuaternion<f64>) -> Self {
        let q = inertial_from_body.coords;
        Self { quaternion: Quaternion([q.x, q.y, q.z, q.w]) }
    }

    fn unit(&self) -> UnitQuaternion<f64> {
        let [x, y, z, w] = self.quaternion.0;
        UnitQuaternion::new_unchecked(nalgebra::Quaternion::new(w, x, y, z))
    }
}

/// Rotation vector, in rad, that carries `from` onto `to`, in components of `to`.
pub(crate) fn rotation_vector(from: &Rotation3<f64>, to: &Rotation3<f64>) -> Vector3<f64> {
    let relative: Matrix3<f64> = from.matrix().transpose() * to.matrix();
    UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(relative)).scaled_axis()
}

#[cfg(test)]
mod tests {
    //! A rotation about one axis is known in closed form, and a passive rotation shows fixed vectors backwards.
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn passive_quaternion_of_a_quarter_turn_about_z() {
        // Wertz (12-13a): C(q) of a +90 deg turn about z takes inertial x to body -y.
        let half = std::f64::consts::FRAC_PI_4;
        let attitude = Attitude::from_quaternion([0.0, 0.0, half.sin(), half.cos()]).unwrap();
        let body = attitude.inertial_from_body().inverse() * Vector3::x();
        assert_relative_eq!(body, -Vector3::y(), epsilon = 1e-15);
    }

    #[test]
    fn constant_rate_turns_about_the_rate_axis() {
        let axis = Vector3::new(0.6, 0.0, 0.8);
        let attitude = Attitude::default().propagated(axis * 0.01, 100.0);
        let q = attitude.quaternion(None);
        let expected = axis * 0.5f64.sin();
        assert_relative_eq!(Vector3::new(q[0], q[1], q[2]), expected, epsilon = 1e-15);
        assert_relative_eq!(q[3], 0.5f64.cos(), epsilon = 1e-15);
    }

    #[test]
    fn cutting_a_constant_rate_motion_changes_nothing() {
        let rate = Vector3::new(1e-3, -2e-3, 3e-3);
        let start = Attitude::from_quaternion([0.5, -0.5, 0.5, 0.5]).unwrap();
        let whole = start.propagated(rate, 700.0).quaternion(None);
        let cut = start.propagated(rate, 300.0).propagated(rate, 400.0).quaternion(Some(whole));
        for (a, b) in whole.iter().zip(cut) {
            assert_relative_eq!(*a, b, epsilon = 1e-14);
        }
    }

    #[test]
    fn what_is_no_rotation_is_refused() {
        assert!(Attitude::from_quaternion([0.0; 4]).is_err());
        assert!(Attitude::from_quaternion([f64::NAN, 0.0, 0.0, 1.0]).is_err());
        let error = Attitude::from_quaternion([0.0, 0.0, 0.0, 2.0]).unwrap_err();
        assert!(error.to_string().contains("norm 2"));
    }
}

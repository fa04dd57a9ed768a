//! State of a rigid body: attitude and angular momentum, and what follows from them with its inertia.
//!
//! Equations: w = J^-1 h in body components, nutation angle atan2(sqrt(h1^2 + h2^2), h3) about the principal
//! axes (Wertz).

use nalgebra::Vector3;

use super::inertia::Inertia;
use super::quaternion::Quaternion;

use crate::math;

/// Attitude and angular momentum of a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RigidBodyState {
    /// EME2000 to body.
    pub attitude: Quaternion,
    /// Angular momentum in inertial components, in N m s.
    pub momentum_inertial: Vector3<f64>,
    /// Angular momentum in body components, in N m s.
    pub momentum_body: Vector3<f64>,
}

impl RigidBodyState {
    /// Angular rate J^-1 h, body components, in rad/s.
    #[inline]
    pub fn rate_rad_s(&self, inertia: &Inertia) -> Vector3<f64> {
        inertia.rate_rad_s(&self.momentum_body)
    }

    /// Angle from the momentum to the third principal axis by atan2, 0..pi, in rad.
    #[inline]
    pub fn nutation_rad(&self, inertia: &Inertia) -> f64 {
        let h = inertia.principal_from_body(&self.momentum_body);
        math::atan2(math::hypot(h.x, h.y), h.z)
    }
}

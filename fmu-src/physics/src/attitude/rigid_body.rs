//! State of a rigid body: attitude and angular momentum, and what follows from them with its inertia.
//!
//! Equations: w = J^-1 h in body components, E = w.h / 2, nutation angle atan2(sqrt(hx^2 + hy^2), hz).

use nalgebra::Vector3;

use super::inertia::Inertia;
use super::quaternion::Quaternion;

/// Where the body is and how it turns.
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
        let [i1, i2, i3] = inertia.principal_kg_m2();
        Vector3::new(self.momentum_body.x / i1, self.momentum_body.y / i2, self.momentum_body.z / i3)
    }

    /// Angle from the momentum to the spin axis by atan2, 0..pi, in rad.
    #[inline]
    pub fn nutation_rad(&self) -> f64 {
        libm::hypot(self.momentum_body.x, self.momentum_body.y).atan2(self.momentum_body.z)
    }

    /// Rotational kinetic energy in J.
    pub fn energy_j(&self, inertia: &Inertia) -> f64 {
        0.5 * self.rate_rad_s(inertia).dot(&self.momentum_body)
    }
}

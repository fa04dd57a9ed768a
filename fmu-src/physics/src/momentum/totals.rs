//! Totals of momentum and delta-v: what is integrated over time, and in which convention.

use nalgebra::{Rotation3, SVector, Vector3};
use serde::{Deserialize, Serialize};

use crate::attitude::MovingFrame;
use crate::enumeration::enumeration;

/// Sampled quantities that are integrated: torque (inertial), torque (body), acceleration (inertial).
pub(super) const RATES: usize = 9;

enumeration! {
    /// Meaning of "system momentum in the body frame".
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum Convention {
        /// Physical: the inertial total shown in body components.
        // dH/dt + w x H = T.
        1 => Inertial,
        /// Paper 000: each body component of torque integrated on its own.
        2 => BodyIntegral,
    }
}

/// Integrals over time.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Totals {
    /// Angular momentum of the whole spacecraft in the inertial frame, in N m s: dH/dt = T.
    pub momentum_inertial_n_m_s: Vector3<f64>,
    /// Integral of the body components of torque, in N m s (paper 000's eq 13, read component by component).
    pub torque_integral_body_n_m_s: Vector3<f64>,
    /// Velocity change by non-gravitational forces, inertial frame, in m/s.
    pub delta_v_inertial_m_s: Vector3<f64>,
}

impl Convention {
    /// Rate of the system momentum in the body frame, in N m, under a torque and at a body rate.
    pub fn momentum_rate_body_n_m(
        self,
        momentum_body_n_m_s: &Vector3<f64>,
        torque_body_n_m: &Vector3<f64>,
        rate_body_rad_s: &Vector3<f64>,
    ) -> Vector3<f64> {
        match self {
            Self::BodyIntegral => *torque_body_n_m,
            Self::Inertial => torque_body_n_m - rate_body_rad_s.cross(momentum_body_n_m_s),
        }
    }
}

impl Totals {
    /// At the start of a flight, with system momentum in the body frame, in N m s, in any convention.
    pub fn at_start(momentum_body_n_m_s: Vector3<f64>, inertial_from_body: &Rotation3<f64>) -> Self {
        Self {
            momentum_inertial_n_m_s: inertial_from_body * momentum_body_n_m_s,
            torque_integral_body_n_m_s: momentum_body_n_m_s,
            ..Self::default()
        }
    }

    /// Returns the momentum of ideal wheels, body frame, in N m s: the system's less the body's and its panels' own, J w + h_p.
    pub fn wheels_body_n_m_s(
        &self,
        structure_body_n_m_s: &Vector3<f64>,
        frame: &MovingFrame,
    ) -> Vector3<f64> {
        self.momentum_body_n_m_s(Convention::Inertial, &frame.inertial_from_body) - structure_body_n_m_s
    }

    /// Rate of the same under an external torque (body frame, N m), in N m: what wheels that follow ideally take up,
    /// T - w x H - d/dt (J w + h_p).
    pub fn wheels_rate_body_n_m(
        &self,
        structure_rate_body_n_m: &Vector3<f64>,
        frame: &MovingFrame,
        torque_body_n_m: &Vector3<f64>,
    ) -> Vector3<f64> {
        let system = self.momentum_body_n_m_s(Convention::Inertial, &frame.inertial_from_body);
        let rate_body_rad_s = &frame.rate_body_rad_s;
        Convention::Inertial.momentum_rate_body_n_m(&system, torque_body_n_m, rate_body_rad_s)
            - structure_rate_body_n_m
    }

    /// System momentum in the body frame by `convention`, in N m s.
    pub fn momentum_body_n_m_s(
        &self,
        convention: Convention,
        inertial_from_body: &Rotation3<f64>,
    ) -> Vector3<f64> {
        match convention {
            Convention::Inertial => inertial_from_body.inverse() * self.momentum_inertial_n_m_s,
            Convention::BodyIntegral => self.torque_integral_body_n_m_s,
        }
    }

    /// Whether every number is finite.
    pub fn is_finite(&self) -> bool {
        self.to_vector().iter().all(|x| x.is_finite())
    }

    pub(super) fn to_vector(self) -> SVector<f64, RATES> {
        pack(self.momentum_inertial_n_m_s, self.torque_integral_body_n_m_s, self.delta_v_inertial_m_s)
    }

    pub(super) fn from_vector(v: &SVector<f64, RATES>) -> Self {
        Self {
            momentum_inertial_n_m_s: Vector3::new(v[0], v[1], v[2]),
            torque_integral_body_n_m_s: Vector3::new(v[3], v[4], v[5]),
            delta_v_inertial_m_s: Vector3::new(v[6], v[7], v[8]),
        }
    }
}

pub(super) fn pack(a: Vector3<f64>, b: Vector3<f64>, c: Vector3<f64>) -> SVector<f64, RATES> {
    SVector::from([a.x, a.y, a.z, b.x, b.y, b.z, c.x, c.y, c.z])
}

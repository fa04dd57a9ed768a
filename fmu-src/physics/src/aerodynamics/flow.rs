//! Free molecular flow about the spacecraft: incident mass and momentum flux on a face.
//!
//! Equation: on a face with the normal n that moves at V through a Maxwellian gas of density rho and most probable speed
//! c = sqrt(2 R T / M), the incident mass and normal momentum (per area and time) are, with x = n.V / c,
//! rho c / (2 sqrt(pi)) [e^(-x^2) + sqrt(pi) x (1 + erf x)] and
//! rho c^2 / (2 sqrt(pi)) [x e^(-x^2) + sqrt(pi) (1/2 + x^2) (1 + erf x)]; tangential momentum is mass times tangential velocity.
//! Method: the brackets are sqrt(pi) i1(-x) and 2 sqrt(pi) i2(-x), repeated integrals of erfc, which keep their digits on faces that
//! look away from the flow, where both brackets cancel; each is the slope of the next.
//! Reference: Schaaf and Chambre, Flow of Rarefied Gases, 1961, section 8; Sentman, Free molecule flow theory and its application
//! to the determination of aerodynamic forces, LMSC-448514, 1961.

use core::f64::consts::PI;

use nalgebra::Vector3;

use crate::constants::GAS_CONSTANT_J_MOL_K;
use crate::numerics::error_function::repeated_erfc;
use crate::numerics::scalar::Scalar;

/// Air about the spacecraft: one gas of mean molar mass.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AirFlow<T: Scalar> {
    /// Density, in kg/m3.
    pub density_kg_m3: T,
    /// Kinetic temperature, in K.
    pub temperature_k: T,
    /// Molar mass, in kg/mol.
    pub molar_mass_kg_mol: T,
    /// Velocity of the spacecraft relative to the air, body frame, in m/s.
    pub velocity_body_m_s: Vector3<T>,
}

impl<T: Scalar> AirFlow<T> {
    /// Unit vector against the flow; `None` at rest.
    pub(super) fn upstream(&self) -> Option<Vector3<T>> {
        let speed_m_s = self.velocity_body_m_s.dot(&self.velocity_body_m_s).sqrt();
        (speed_m_s.value() > 0.0).then(|| self.velocity_body_m_s / speed_m_s)
    }

    /// 2 R T / M, the square of the most probable speed, at this temperature, in m2/s2.
    pub(super) fn speed_squared(&self, temperature_k: T) -> T {
        temperature_k / self.molar_mass_kg_mol * (2.0 * GAS_CONSTANT_J_MOL_K)
    }
}

/// Incident flux on a face, per area.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct IncidentFlow<T: Scalar> {
    /// Mass, in kg/m2/s.
    pub mass_flux_kg_m2_s: T,
    /// Normal momentum, in Pa.
    pub pressure_pa: T,
}

impl<T: Scalar> IncidentFlow<T> {
    /// Flux on a face with this velocity along its outward normal; `thermal_m_s` is the most probable speed.
    pub(super) fn new(density_kg_m3: T, thermal_m_s: T, normal_m_s: T) -> Self {
        let speed_ratio = normal_m_s / thermal_m_s;
        let root = PI.sqrt();
        let [i0, i1, i2] = repeated_erfc(-speed_ratio.value());
        let mass = speed_ratio.chain(root * i1, || root * i0);
        let momentum = speed_ratio.chain(2.0 * root * i2, || 2.0 * root * i1);
        let mass_scale = density_kg_m3 * thermal_m_s * (0.5 / root);
        Self { mass_flux_kg_m2_s: mass * mass_scale, pressure_pa: momentum * mass_scale * thermal_m_s }
    }
}

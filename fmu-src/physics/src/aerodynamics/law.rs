//! Gas-surface interaction laws: drag coefficient, Sentman, Schaaf and Chambre.
//!
//! Equation: with p and m the incident normal momentum and mass (per area and time, [`super::flow`]), V the velocity relative to
//! the air, V_t its tangential part, and q(T) = m sqrt(pi) / 2 sqrt(2 R T / M) the pressure of the same mass re-emitted diffusely
//! at the temperature T:
//! dragCoefficient: F/A = -1/2 rho C_D (n.V) V where n.V > 0;
//! sentman: F/A = -[p + q(T_r)] n - m V_t, all molecules re-emitted diffusely with T_r = (1 - alpha) T_i + alpha T_w;
//! schaafChambre: F/A = -[(2 - sigma_n) p + sigma_n q(T_w)] n - sigma_t m V_t.
//! The temperature equivalent to the incident energy is T_i = M V^2 / (4 R) by the mean energy 2 k T of effusing molecules
//! (effusive), or M V^2 / (3 R) by the mean 3/2 k T in a gas at rest (moe).
//! Reference: Sentman, LMSC-448514, 1961; Schaaf and Chambre, Flow of Rarefied Gases, 1961, section 8; Koppenwallner, Satellite
//! aerodynamics and determination of thermospheric density and wind, RGD 26, 2009, and Doornbos, Thermospheric density and wind
//! determination from satellite dynamics, 2011, section 3.3 (effusive); Moe and Moe, Gas-surface interactions and satellite drag
//! coefficients, Planet. Space Sci. 53, 2005 (moe).

use core::f64::consts::PI;

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::flow::{AirFlow, IncidentFlow};
use crate::enumeration::enumeration;
use crate::numerics::scalar::Scalar;
use crate::spacecraft::GasSurface;

enumeration! {
    /// Law of the force of air on a face.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
    #[serde(rename_all = "camelCase")]
    pub enum AerodynamicLaw {
        /// Drag along the flow, by projected area and the material's drag coefficient.
        1 => DragCoefficient,
        /// Diffuse re-emission at a temperature by the material's energy accommodation.
        2 => Sentman,
        /// Normal and tangential momentum by the material's accommodation of each.
        3 => SchaafChambre,
    }
}

enumeration! {
    /// Temperature equivalent to the energy of incident molecules in the law sentman.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
    #[serde(rename_all = "camelCase")]
    pub enum Reemission {
        /// That of effusing molecules of the same energy, M V^2 / (4 R).
        1 => Effusive,
        /// The kinetic temperature, M V^2 / (3 R).
        2 => Moe,
    }
}

/// A law in one flow, common to all faces.
#[derive(Clone, Copy, Debug)]
pub(super) struct LawAtFlow<'a, T: Scalar> {
    law: AerodynamicLaw,
    flow: &'a AirFlow<T>,
    /// Most probable speed of the gas, in m/s.
    thermal_m_s: T,
    /// Square of the most probable speed at the temperature of the incident energy, in m2/s2.
    incident_m2_s2: T,
}

impl<'a, T: Scalar> LawAtFlow<'a, T> {
    pub(super) fn new(law: AerodynamicLaw, reemission: Reemission, flow: &'a AirFlow<T>) -> Self {
        let velocity = &flow.velocity_body_m_s;
        let thermal_m_s = match law {
            AerodynamicLaw::DragCoefficient => T::constant(0.0),
            AerodynamicLaw::Sentman | AerodynamicLaw::SchaafChambre => {
                flow.speed_squared(flow.temperature_k).sqrt()
            }
        };
        // The incident temperature is M V^2 / R over this.
        let divisor = if reemission == Reemission::Moe { 3.0 } else { 4.0 };
        let incident_m2_s2 = velocity.dot(velocity) * (2.0 / divisor);
        Self { law, flow, thermal_m_s, incident_m2_s2 }
    }

    /// Incident flux on a face with this velocity along its outward normal.
    pub(super) fn incident(&self, normal_m_s: T) -> IncidentFlow<T> {
        match self.law {
            AerodynamicLaw::DragCoefficient => {
                let incident_m_s = if normal_m_s.value() > 0.0 { normal_m_s } else { T::constant(0.0) };
                let mass_flux_kg_m2_s = self.flow.density_kg_m3 * incident_m_s;
                IncidentFlow { mass_flux_kg_m2_s, pressure_pa: mass_flux_kg_m2_s * incident_m_s }
            }
            AerodynamicLaw::Sentman | AerodynamicLaw::SchaafChambre => {
                IncidentFlow::new(self.flow.density_kg_m3, self.thermal_m_s, normal_m_s)
            }
        }
    }

    /// Force per area in Pa on a face of this outward normal and wall temperature under this incident flux.
    pub(super) fn force_per_area_pa(
        &self,
        surface: &GasSurface<T>,
        wall_temperature_k: T,
        normal_body: &Vector3<T>,
        incident: &IncidentFlow<T>,
    ) -> Vector3<T> {
        let velocity = &self.flow.velocity_body_m_s;
        let mass = incident.mass_flux_kg_m2_s;
        let wall_m2_s2 = self.flow.speed_squared(wall_temperature_k);
        let (pressure_pa, along) = match self.law {
            AerodynamicLaw::DragCoefficient => {
                return -velocity * (mass * (surface.drag_coefficient * 0.5));
            }
            AerodynamicLaw::Sentman => {
                let alpha = surface.energy_accommodation;
                let reemitted_m2_s2 = self.incident_m2_s2 * (T::constant(1.0) - alpha) + wall_m2_s2 * alpha;
                (incident.pressure_pa + reemitted_pressure_pa(mass, reemitted_m2_s2), mass)
            }
            AerodynamicLaw::SchaafChambre => {
                let (normal, tangential) = (surface.normal_accommodation, surface.tangential_accommodation);
                let reemitted_pa = reemitted_pressure_pa(mass, wall_m2_s2) * normal;
                (incident.pressure_pa * (T::constant(2.0) - normal) + reemitted_pa, mass * tangential)
            }
        };
        let normal_m_s = normal_body.dot(velocity);
        -(*normal_body * (pressure_pa - along * normal_m_s) + *velocity * along)
    }
}

/// Pressure of diffusely re-emitted mass with this square of the most probable speed.
fn reemitted_pressure_pa<T: Scalar>(mass_flux_kg_m2_s: T, speed_squared: T) -> T {
    // The root's slope at no speed is infinite.
    if speed_squared.value() <= 0.0 {
        return T::constant(0.0);
    }
    mass_flux_kg_m2_s * speed_squared.sqrt() * (0.5 * PI.sqrt())
}

//! Conditions at one time, by which sources act: geometry, attitude, mass properties, air, field and the load from outside.

use nalgebra::Vector3;

use crate::aerodynamics::AirFlow;
use crate::loads::ForceTorque;
use crate::plant::air_and_field::air_and_field_segment::AirAndField;
use crate::plant::motion::instant::Instant;
use crate::plant::settings::configuration::Configuration;
use crate::plant::settings::prepared_spacecraft::PreparedSpacecraft;
use crate::spacecraft::MassProperties;

/// Everything at one time that sources read.
pub(crate) struct Conditions<'a> {
    /// When, in s.
    pub time_s: f64,
    /// Settings.
    pub configuration: &'a Configuration,
    /// The spacecraft.
    pub spacecraft: PreparedSpacecraft<'a>,
    /// With every panel at angle 0, of what is left of the propellant.
    pub current_mass_panels_stowed: &'a MassProperties,
    /// Geometry and attitude.
    pub instant: &'a Instant,
    /// Mass, centre of mass and inertia as the panels stand.
    pub mass: &'a MassProperties,
    /// Air and magnetic field.
    pub air_and_field: &'a AirAndField,
    /// The air's flow about the spacecraft; `None` where there is no air.
    pub flow: Option<AirFlow<f64>>,
    /// Force through the centre of mass and torque from outside.
    pub applied: ForceTorque,
}

impl AirAndField {
    /// Velocity relative to the air, body frame, in m/s; `None` without a planet.
    pub(crate) fn velocity_body_m_s(&self, instant: &Instant) -> Option<Vector3<f64>> {
        let from_planet = instant.geometry.from_planet()?;
        Some(instant.to_body * (from_planet.velocity_m_s - self.air_velocity_m_s))
    }

    /// The air's flow about the spacecraft; `None` where there is no air.
    pub(crate) fn flow(&self, instant: &Instant) -> Option<AirFlow<f64>> {
        let velocity = self.velocity_body_m_s(instant).filter(|_| self.air.density_kg_m3 > 0.0);
        velocity.map(|velocity_body_m_s| AirFlow {
            density_kg_m3: self.air.density_kg_m3,
            temperature_k: self.air.temperature_k,
            molar_mass_kg_mol: self.air.molar_mass_kg_mol,
            velocity_body_m_s,
        })
    }
}

//! Conditions at one time, by which sources act: geometry, attitude, mass properties, air, field and the load from outside.

use super::air_and_field_segment::AirAndField;
use crate::aerodynamics::AirFlow;
use crate::loads::ForceTorque;
use crate::plant::motion::instant::Instant;
use crate::plant::settings::configuration::Configuration;
use crate::plant::settings::prepared_spacecraft::PreparedSpacecraft;
use crate::spacecraft::MassProperties;

/// Everything at one time that sources read.
pub(crate) struct Conditions<'a> {
    /// Time of the conditions, in s.
    pub time_s: f64,
    /// Settings.
    pub configuration: &'a Configuration,
    /// The spacecraft.
    pub spacecraft: PreparedSpacecraft<'a>,
    /// Mass properties with every panel at angle 0 and the remaining propellant.
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

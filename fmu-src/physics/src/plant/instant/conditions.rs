//! Conditions at one time, by which sources act: geometry, attitude, mass properties, air, field and the load from outside.

use super::air_and_field_segment::AirAndField;
use crate::aerodynamics::AirFlow;
use crate::loads::ForceTorque;
use crate::plant::instant::at_time::Instant;
use crate::plant::instant::kinematics::Kinematics;
use crate::spacecraft::MassProperties;

/// Everything at one time that sources read.
pub(crate) struct Conditions<'a> {
    /// Settings, the spacecraft and its mass properties with every panel at angle 0.
    pub kinematics: &'a Kinematics<'a>,
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

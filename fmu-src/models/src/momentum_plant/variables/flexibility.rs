//! Flexible modes and sloshing propellant of the spacecraft.

use fmi_export::{Real, RealVector, Variables};

use super::super::setup::PlantSetup as Setup;

/// One flexible mode, normalised to a modal mass of 1 kg, so that its coupling in kg m is that in sqrt(kg) m. It plays no part
/// in guided and commanded flight.
#[derive(Variables)]
pub struct FlexibleModeVariables {
    /// Frequency with the body held.
    #[parameter(unit = "Hz", min = 1e-9, max = 1e3, start = setup.spacecraft.flexible_modes[index].mode.frequency_hz)]
    pub frequency: Real,
    /// Damping ratio with the body held.
    #[parameter(unit = "1", min = 0.0, max = 1.0, start = setup.spacecraft.flexible_modes[index].mode.damping)]
    pub damping: Real,
    /// Angular momentum about each body axis by unit speed of the mode.
    #[parameter(unit = "kg.m", min = -1e9, max = 1e9, start = setup.spacecraft.flexible_modes[index].mode.coupling_body_sqrt_kg_m.into())]
    pub coupling: RealVector<3>,
    /// Displacement; 0 where the flight begins.
    #[output(unit = "m", display = "mm", nominal = 1e-3)]
    pub displacement: Real,
}

/// Propellant that swings as a pendulum, linear in its angles. It plays no part in guided and commanded flight.
#[derive(Variables)]
pub struct SloshVariables {
    /// Mass that swings, a part of spacecraft.mass.
    #[parameter(unit = "kg", min = 1e-9, max = 1e12, start = setup.spacecraft.sloshes[index].pendulum.mass_kg)]
    pub mass: Real,
    /// Length of the pendulum.
    #[parameter(unit = "m", display = "cm", min = 1e-6, max = 1e4, start = setup.spacecraft.sloshes[index].pendulum.length_m)]
    pub length: Real,
    /// Pivot in the body frame.
    #[parameter(unit = "m", display = "cm", min = -1e4, max = 1e4, start = setup.spacecraft.sloshes[index].pendulum.pivot_body_m.into())]
    pub pivot: RealVector<3>,
    /// From the pivot to the mass at rest in the body frame, of any length: against the acceleration it swings under.
    #[parameter(unit = "1", min = -1e6, max = 1e6, start = setup.spacecraft.sloshes[index].pendulum.axis_body.into())]
    pub axis: RealVector<3>,
    /// Damping ratio with the body held.
    #[parameter(unit = "1", min = 0.0, max = 1.0, start = setup.spacecraft.sloshes[index].pendulum.damping)]
    pub damping: Real,
    /// Frequency without acceleration, by surface tension or a membrane.
    #[parameter(unit = "Hz", min = 1e-9, max = 1e3, start = setup.spacecraft.sloshes[index].pendulum.coast_frequency_hz)]
    pub coast_frequency: Real,
    /// Angles of the pendulum along two axes across slosh.axis: the first is axis x that body axis along which axis is least, the
    /// second axis x the first. 0 where the flight begins.
    #[output(unit = "rad", display = "deg", nominal = 1e-2)]
    pub angle: RealVector<2>,
}

//! Settings of a flight by its mode, and what of parameters and inputs changed.

use super::dynamics_settings::DynamicsSettings;
use super::ideal_settings::IdealSettings;

/// Settings of a mode, next to the configuration.
#[derive(Clone, Debug)]
pub enum ModeSettings {
    /// Settings of a flight whose attitude is followed ideally, and of one that waits.
    Ideal(IdealSettings),
    /// Settings of a flight by torque.
    Dynamic(Box<DynamicsSettings>),
}

/// Groups of parameters and inputs that changed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Changes {
    /// Position and velocity were given.
    pub orbit: bool,
    /// Attitude, panels or Sun changed, on which light and heat depend.
    pub light: bool,
    /// Mass, centre of mass or inertia changed.
    pub mass: bool,
    /// The force from outside changed.
    pub force: bool,
    /// Mass, thresholds or target of dumps changed.
    pub tunables: bool,
}

//! What swings on the spacecraft: flexible modes, propellant as pendulums.

use nalgebra::Vector3;
use serde::Serialize;

use crate::attitude::{FlexibleMode, SloshPendulum};

/// A flexible mode of the spacecraft.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct NamedMode {
    /// For messages.
    pub name: String,
    /// Frequency, damping and coupling.
    pub mode: FlexibleMode,
}

/// Propellant that swings as a pendulum in its tank.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Slosh {
    /// For messages.
    pub name: String,
    /// Mass that swings, in kg; a part of the spacecraft's.
    pub mass_kg: f64,
    /// Length of the pendulum, in m.
    pub length_m: f64,
    /// Pivot, body frame, in m.
    pub pivot_body_m: Vector3<f64>,
    /// Unit vector from the pivot to the bob at rest.
    pub axis_body: Vector3<f64>,
    /// Damping ratio.
    pub damping: f64,
    /// Angular frequency without acceleration, in rad/s.
    pub coast_frequency_rad_s: f64,
}

impl Slosh {
    /// The pendulum about a centre of mass.
    pub fn pendulum(&self, center_of_mass_body_m: &Vector3<f64>) -> SloshPendulum {
        SloshPendulum {
            mass_kg: self.mass_kg,
            length_m: self.length_m,
            pivot_from_center_body_m: self.pivot_body_m - center_of_mass_body_m,
            axis_body: self.axis_body,
            coast_frequency_rad_s: self.coast_frequency_rad_s,
            damping: self.damping,
        }
    }
}

/// Frequency of propellant without acceleration where the file gives none, in Hz: surface tension or a membrane holds it.
/// Assumed.
pub const COAST_FREQUENCY_HZ: f64 = 0.005;

//! What thrusters exert, and what that adds up to.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use crate::numerics::chebyshev::GREATEST_IN_STATE;
use crate::propulsion::ThrustLaw;

/// What thrusters exert, torque about the centre of mass, on a spacecraft whose mass they take with them.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ThrusterLoad {
    /// Force, torque and flow.
    pub law: ThrustLaw,
    /// Mass in kg at the start.
    pub mass_kg: f64,
}

impl ThrusterLoad {
    /// Nothing, on a spacecraft of this mass.
    pub(super) fn none(time_s: f64, mass_kg: f64) -> Self {
        Self { law: ThrustLaw::none(time_s), mass_kg }
    }

    /// Whether its numbers can come from a flight; bytes from elsewhere may hold anything.
    pub(super) fn is_sound(&self) -> bool {
        self.law.is_sound() && self.mass_kg > 0.0 && self.mass_kg <= GREATEST_IN_STATE
    }

    /// Acceleration in m/s2 at `time_s`, body frame.
    pub(super) fn acceleration_body_m_s2(&self, time_s: f64) -> Vector3<f64> {
        self.law.force_at_n(time_s) / (self.mass_kg - self.law.burnt_kg(time_s))
    }
}

/// What thrusters did so far, EME2000.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ThrusterTotals {
    /// Angular impulse about the centre of mass, in N m s.
    pub impulse_inertial_n_m_s: Vector3<f64>,
    /// Velocity change, in m/s.
    pub delta_v_inertial_m_s: Vector3<f64>,
}

impl ThrusterTotals {
    /// Whether its numbers can come from a flight; bytes from elsewhere may hold anything.
    pub(super) fn is_sound(&self) -> bool {
        let numbers = self.impulse_inertial_n_m_s.iter().chain(&self.delta_v_inertial_m_s);
        numbers.into_iter().all(|x| x.abs() <= GREATEST_IN_STATE)
    }
}

//! What thrusters exert, and what that adds up to.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use crate::numerics::chebyshev::GREATEST_IN_STATE;

/// What thrusters exert from a time on, linear in time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ThrusterLoad {
    pub(super) since_s: f64,
    /// Force in N and its slope in N/s, body frame.
    pub force_body_n: [Vector3<f64>; 2],
    /// Torque about the centre of mass in N m and its slope in N m/s, body frame.
    pub torque_body_n_m: [Vector3<f64>; 2],
    /// Mass in kg at the start.
    pub mass_kg: f64,
    /// Flow out of the tanks in kg/s and its slope in kg/s2.
    pub flow_kg_s: [f64; 2],
}

impl ThrusterLoad {
    /// Nothing, on a spacecraft of this mass.
    pub(super) fn none(time_s: f64, mass_kg: f64) -> Self {
        let nothing = [Vector3::zeros(); 2];
        Self {
            since_s: time_s,
            force_body_n: nothing,
            torque_body_n_m: nothing,
            mass_kg,
            flow_kg_s: [0.0; 2],
        }
    }

    /// Whether nothing fires; couples exert no force, but propellant flows.
    pub fn is_none(&self) -> bool {
        self.flow_kg_s == [0.0; 2]
    }

    /// Force in N and torque in N m at `time_s`, body frame.
    pub fn at(&self, time_s: f64) -> [Vector3<f64>; 2] {
        let elapsed_s = time_s - self.since_s;
        [self.force_body_n, self.torque_body_n_m].map(|[start, slope]| start + slope * elapsed_s)
    }

    /// Acceleration in m/s2 at `time_s`, body frame.
    pub(super) fn acceleration_body_m_s2(&self, time_s: f64) -> Vector3<f64> {
        let elapsed_s = time_s - self.since_s;
        let [flow, slope] = self.flow_kg_s;
        self.at(time_s)[0] / (self.mass_kg - (flow + 0.5 * slope * elapsed_s) * elapsed_s)
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

//! Reaction wheels: their axes, and what each can hold and exert.

use nalgebra::Vector3;
use serde::Serialize;

/// One reaction wheel.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Wheel {
    /// For messages.
    pub name: String,
    /// Unit vector of the spin axis; positive speed is right-handed about it.
    pub axis_body: Vector3<f64>,
    /// Greatest momentum of the rotor about its axis, in N m s.
    pub capacity_n_m_s: f64,
    /// Momentum about which it works, along its axis, in N m s.
    pub bias_n_m_s: f64,
    /// Moment of inertia of the rotor about its axis, in kg m2.
    pub inertia_kg_m2: f64,
    /// Greatest torque of the motor, in N m.
    pub max_torque_n_m: f64,
    /// Coulomb friction, in N m.
    pub coulomb_friction_n_m: f64,
    /// Viscous friction, in N m per rad/s.
    pub viscous_friction_n_m_s: f64,
    /// Static imbalance of the rotor, in kg m.
    pub static_imbalance_kg_m: f64,
    /// Place of the rotor, body frame, in m; the origin unless given.
    pub position_body_m: Vector3<f64>,
}

impl Wheel {
    /// Momentum that it takes up to either side of its bias, in N m s.
    pub fn free_capacity_n_m_s(&self) -> f64 {
        free_capacity_n_m_s(self.capacity_n_m_s, self.bias_n_m_s)
    }
}

/// The part of a capacity that a wheel has to either side of its bias momentum, in N m s.
pub fn free_capacity_n_m_s(capacity_n_m_s: f64, bias_n_m_s: f64) -> f64 {
    capacity_n_m_s - bias_n_m_s.abs()
}

/// Speed at the capacity, from which a rotor's inertia follows where the file gives none: 6000 rpm, assumed.
pub(super) const SPEED_AT_CAPACITY_RAD_S: f64 = 6000.0 * core::f64::consts::TAU / 60.0;
/// How long a motor takes from rest to the capacity where the file gives no torque: 100 s, assumed.
pub(super) const TIME_TO_CAPACITY_S: f64 = 100.0;

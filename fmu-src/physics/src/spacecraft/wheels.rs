//! Reaction wheels: their axes, and what each can hold and exert.

use nalgebra::Vector3;
use serde::Serialize;

use super::part_reader::PartReader;
use crate::toml::{Finite, NotNegative, Point, Positive, UnitVector, tables};

/// Speed at the capacity, from which a rotor's inertia follows where the file gives none: 6000 rpm, assumed.
const SPEED_AT_CAPACITY_RAD_S: f64 = 6000.0 * core::f64::consts::TAU / 60.0;
/// How long a motor takes from rest to the capacity where the file gives no torque: 100 s, assumed.
const TIME_TO_CAPACITY_S: f64 = 100.0;

tables! {
/// A reaction wheel.
struct WheelDescription called "wheel" makes #[derive(Clone, Debug, PartialEq, Serialize)] pub struct Wheel {
    /// Name for messages; numbered unless given.
    name: Option<String>,
    /// Unit vector of the spin axis, body frame.
    axis as axis_body: UnitVector,
    /// Greatest momentum of the rotor, in N m s.
    capacity_n_m_s: Positive,
    /// Momentum about which the wheel works, along its axis, in N m s; up to its capacity either way.
    bias_momentum_n_m_s as bias_n_m_s: Finite = 0.0,
    /// Moment of inertia of the rotor about its axis, in kg m2; left out, that which reaches the capacity at 6000 rpm.
    inertia_kg_m2: Positive => |it| it.capacity_n_m_s.0 / SPEED_AT_CAPACITY_RAD_S,
    /// Greatest torque of the motor, in N m; left out, that which reaches the capacity from rest in 100 s.
    max_torque_n_m: Positive => |it| it.capacity_n_m_s.0 / TIME_TO_CAPACITY_S,
    /// Coulomb friction, in N m.
    coulomb_friction_n_m: NotNegative = 0.0,
    /// Viscous friction, in N m per rad/s.
    viscous_friction_n_m_s: NotNegative = 0.0,
    /// Static imbalance of the rotor, in kg m.
    static_imbalance_kg_m: NotNegative = 0.0,
    /// Place of the rotor, body frame, in m.
    position_m as position_body_m: Point => |_| Vector3::zeros(),
} rules {
    RequiresIfPositive static_imbalance_kg_m => position_m: "no position_m beside it", "with the rotor's place, position_m";
}
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

/// Reads a wheel.
pub(super) fn wheel(part: &PartReader<'_>, description: &WheelDescription) -> Wheel {
    let wheel = description.made(part.index);
    if wheel.bias_n_m_s.abs() > wheel.capacity_n_m_s {
        let allowed = format_args!("up to capacity_n_m_s either way, {}", wheel.capacity_n_m_s);
        part.key("bias_momentum_n_m_s").report_across(wheel.bias_n_m_s, allowed);
    }
    wheel
}

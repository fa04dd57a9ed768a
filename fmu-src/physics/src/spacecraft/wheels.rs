//! Reaction wheels: their axes and what each can hold.

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
}

/// Dump thresholds paper 000 states beside the capacity of each of four wheels, both in N m s; it does not publish
/// the wheels' axes.
pub const PAPER_DUMP_THRESHOLDS_N_M_S: [(f64, f64); 3] = [(4.0, 4.0), (8.0, 5.5), (12.0, 7.0)];

//! Thrusters: force, torque and propellant flow of one and of a set.

use nalgebra::Vector3;
use serde::Serialize;

/// One thruster.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Thruster {
    /// Name.
    pub name: String,
    /// Where it stands from the centre of mass, body frame, in m; for pictures, the torque is what acts.
    #[serde(skip)]
    pub position_body_m: Vector3<f64>,
    /// Force on the spacecraft, body components, in N.
    pub force_body_n: Vector3<f64>,
    /// Torque about the centre of mass, body components, in N m.
    pub torque_body_n_m: Vector3<f64>,
    /// Propellant flow, in kg/s.
    pub flow_kg_s: f64,
}

impl Thruster {
    /// Moment arm across the body's Z axis, in m (paper 002 Table 1).
    pub fn arm_across_z_m(&self) -> f64 {
        self.torque_body_n_m.xy().norm() / self.force_body_n.norm()
    }
}

/// Force, torque and flow of a set of thrusters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Thrust {
    /// Body components, in N.
    pub force_body_n: Vector3<f64>,
    /// Body components, in N m.
    pub torque_body_n_m: Vector3<f64>,
    /// In kg/s.
    pub flow_kg_s: f64,
}

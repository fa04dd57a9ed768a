//! Propellant that leaves a body: inertia that changes with it, and jet damping.
//!
//! Equations: d(J w)/dt + w x J w = T - sum of q r_e x (w x r_e) over the nozzles, q the flow and r_e from the centre of mass to
//! the nozzle; J = J0 + J' t over a segment of motion. What is left out is the momentum of the flow inside the body.
//! Reference: Thomson, Introduction to Space Dynamics, 7.7.

use nalgebra::{Matrix3, Vector3};
use serde::{Deserialize, Serialize};

/// What a flow that is linear in time does to the body beside thrust, body frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct MassFlow {
    /// J', in kg m2/s.
    pub inertia_rate_kg_m2_s: Matrix3<f64>,
    /// D = sum of q (r_e.r_e 1 - r_e r_e^T), so that the torque is -D w, in kg m2/s, and its slope in kg m2/s2.
    pub jet_damping_kg_m2_s: [Matrix3<f64>; 2],
}

impl MassFlow {
    /// Torque of jet damping in N m, `elapsed_s` after the start, on a body that turns like this, body frame.
    pub fn jet_torque_n_m(&self, elapsed_s: f64, rate_body_rad_s: &Vector3<f64>) -> Vector3<f64> {
        let [start, slope] = &self.jet_damping_kg_m2_s;
        -(start * rate_body_rad_s + slope * (rate_body_rad_s * elapsed_s))
    }

    /// Coefficient `j` of that torque's series, where `rates` are those of the rate up to `j`.
    pub(super) fn jet_term(&self, rates: &[Vector3<f64>], j: usize) -> Vector3<f64> {
        let [start, slope] = &self.jet_damping_kg_m2_s;
        let from_slope = j.checked_sub(1).map_or(Vector3::zeros(), |before| slope * rates[before]);
        -(start * rates[j] + from_slope)
    }
}

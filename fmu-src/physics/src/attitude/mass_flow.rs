//! Propellant that leaves a body: inertia that changes with it, and jet damping.
//!
//! Equations: d(J w)/dt + w x J w = T - sum of q r_e x (w x r_e) over the nozzles, q the flow and r_e from the centre of mass to
//! the nozzle; J = J0 + J' t over a segment of motion. What is left out is the momentum of the flow inside the body.
//! Reference: Thomson, Introduction to Space Dynamics, 7.7.

use nalgebra::{Matrix3, Vector3};
use serde::{Deserialize, Serialize};

/// Propellant that carries momentum away through nozzles: a torque -D w, body frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct JetDamping {
    /// D = sum of q (r_e.r_e 1 - r_e r_e^T) at the start in kg m2/s, and its slope in kg m2/s2.
    pub terms_kg_m2_s: [Matrix3<f64>; 2],
}

impl JetDamping {
    /// The same from `elapsed_s` later on.
    #[must_use]
    pub fn after(self, elapsed_s: f64) -> Self {
        let [start, slope] = self.terms_kg_m2_s;
        Self { terms_kg_m2_s: [start + slope * elapsed_s, slope] }
    }

    /// Torque in N m, `elapsed_s` after the start, on a body that turns like this.
    pub fn torque_n_m(&self, elapsed_s: f64, rate_body_rad_s: &Vector3<f64>) -> Vector3<f64> {
        let [start, slope] = &self.terms_kg_m2_s;
        -(start * rate_body_rad_s + slope * (rate_body_rad_s * elapsed_s))
    }

    /// Coefficient `j` of that torque's series, where `rates` are those of the rate up to `j`.
    pub(crate) fn term(&self, rates: &[Vector3<f64>], j: usize) -> Vector3<f64> {
        let [start, slope] = &self.terms_kg_m2_s;
        let from_slope = j.checked_sub(1).map_or(Vector3::zeros(), |before| slope * rates[before]);
        -(start * rates[j] + from_slope)
    }

    /// Adds a flow times a share that is linear in time, through a nozzle of this r_e.r_e 1 - r_e r_e^T.
    pub(crate) fn add(&mut self, flow_kg_s: f64, nozzle_m2: &Matrix3<f64>, share: [f64; 2]) {
        for (term, part) in self.terms_kg_m2_s.iter_mut().zip(share) {
            *term += nozzle_m2 * (flow_kg_s * part);
        }
    }
}

/// Effect on the body of a flow that is linear in time, thrust apart, body frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct MassFlow {
    /// J', in kg m2/s.
    pub inertia_rate_kg_m2_s: Matrix3<f64>,
    /// Momentum that the flow carries away.
    pub jet_damping: JetDamping,
}

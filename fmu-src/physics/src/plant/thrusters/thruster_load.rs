//! Force, torque and flow of thrusters, and their integrals.
//!
//! Equations: of tanks at r_k that lose q_k from a body of mass M about r_c, r_c' = -sum of q_k (r_k - r_c) / M and
//! J' = -sum of q_k [r_k - r_c] with [r] = r.r 1 - r r^T; T(t) = T(0) + (T' - r_c' x F) t; jet damping as in
//! [`crate::attitude::MassFlow`], of nozzles at r_e from r_c: r_e' = -r_c'.

use nalgebra::{Matrix3, Vector3};
use serde::{Deserialize, Serialize};

use crate::attitude::MassFlow;
use crate::propulsion::ThrustLaw;
use crate::spacecraft::{Thrust, steiner};

/// Force, flow and torque about the centre of mass of thrusters, which drain the spacecraft's mass.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ThrusterLoad {
    /// Force, torque and flow; torque without jet damping.
    pub law: ThrustLaw,
    /// Mass in kg at the start.
    pub mass_kg: f64,
    /// Inertia that changes, and jet damping.
    pub mass_flow: MassFlow,
}

impl ThrusterLoad {
    /// Load without thrust, on a spacecraft of this mass.
    pub(crate) fn none(time_s: f64, mass_kg: f64) -> Self {
        Self { law: ThrustLaw::none(time_s), mass_kg, mass_flow: MassFlow::default() }
    }

    /// Adds a thruster's full thrust times a share that is linear in time, its nozzle `arm_m` from the centre of mass.
    pub(crate) fn add(&mut self, thrust: &Thrust, arm_m: &Vector3<f64>, share: [f64; 2]) {
        self.law.add(thrust, share);
        self.mass_flow.jet_damping.add(thrust.flow_kg_s, &steiner(arm_m), share);
    }

    /// Lets the centre of mass move: this flows from tanks so far from it, in kg/s and m, and `nozzles_kg_m_s` is the sum over
    /// the thrusters of flow times the nozzle's place from it.
    pub(crate) fn drain(
        &mut self,
        tanks: impl Iterator<Item = (f64, Vector3<f64>)>,
        nozzles_kg_m_s: &Vector3<f64>,
    ) {
        let mut moment_kg_m_s = Vector3::zeros();
        for (flow_kg_s, from_center_m) in tanks {
            moment_kg_m_s += from_center_m * flow_kg_s;
            self.mass_flow.inertia_rate_kg_m2_s -= steiner(&from_center_m) * flow_kg_s;
        }
        let center_rate_m_s = -moment_kg_m_s / self.mass_kg;
        self.law.torque_body_n_m[1] -= center_rate_m_s.cross(&self.law.force_body_n[0]);
        let product = nozzles_kg_m_s * center_rate_m_s.transpose();
        let toward = Matrix3::from_diagonal_element(2.0 * product.trace()) - product - product.transpose();
        self.mass_flow.jet_damping.terms_kg_m2_s[1] -= toward;
    }

    /// Acceleration in m/s2 at `time_s`, body frame.
    pub(crate) fn acceleration_body_m_s2(&self, time_s: f64) -> Vector3<f64> {
        self.law.force_at_n(time_s) / (self.mass_kg - self.law.burnt_kg(time_s))
    }

    /// Torque with jet damping in N m at `time_s`, on a body that turns like this, body frame.
    pub(crate) fn torque_at_n_m(&self, time_s: f64, rate_body_rad_s: &Vector3<f64>) -> Vector3<f64> {
        let elapsed_s = time_s - self.law.since_s;
        self.law.torque_at_n_m(time_s) + self.mass_flow.jet_damping.torque_n_m(elapsed_s, rate_body_rad_s)
    }
}

/// Impulse and velocity change by thrusters so far, EME2000.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ThrusterTotals {
    /// Angular impulse about the centre of mass with jet damping, in N m s.
    pub impulse_inertial_n_m_s: Vector3<f64>,
    /// Velocity change, in m/s.
    pub delta_v_inertial_m_s: Vector3<f64>,
}

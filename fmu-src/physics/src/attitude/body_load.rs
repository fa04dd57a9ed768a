//! Load on a body over a segment of its motion, and the body at one time.

use nalgebra::{Matrix3, Vector3};
use serde::{Deserialize, Serialize};

use super::dipole_in_field::DipoleInField;
use super::internal_motion::InternalMotion;
use super::mass_flow::MassFlow;
use super::quaternion::Quaternion;

/// Load on the body over a segment, body frame, by polynomials of the time since its start.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct BodyLoad {
    /// Torque about the centre of mass in N m, and its slope in N m/s.
    pub torque_body_n_m: [Vector3<f64>; 2],
    /// Force other than gravity in N, and its slope in N/s.
    pub force_body_n: [Vector3<f64>; 2],
    /// Mass in kg at the start.
    pub mass_kg: f64,
    /// Mass flow out of the body in kg/s at the start, and its slope in kg/s2.
    pub flow_kg_s: [f64; 2],
    /// Effect of that flow on the body, its force apart; absent where nothing flows.
    pub mass_flow: Option<MassFlow>,
    /// A dipole in a magnetic field; absent where none is.
    pub dipole: Option<DipoleInField>,
    /// Motion of masses on hinges; absent where none turns.
    pub internal: Option<InternalMotion>,
}

impl BodyLoad {
    /// No load, on a body of this mass.
    pub fn none(mass_kg: f64) -> Self {
        Self { mass_kg, ..Self::default() }
    }

    /// Copies another load; its large parts only where they are present.
    pub(super) fn copy_from(&mut self, other: &Self) {
        let Self { torque_body_n_m, force_body_n, mass_kg, flow_kg_s, mass_flow, dipole, internal } = self;
        (*torque_body_n_m, *force_body_n) = (other.torque_body_n_m, other.force_body_n);
        (*mass_kg, *flow_kg_s, *dipole) = (other.mass_kg, other.flow_kg_s, other.dipole);
        if mass_flow.is_some() || other.mass_flow.is_some() {
            *mass_flow = other.mass_flow;
        }
        if internal.is_some() || other.internal.is_some() {
            *internal = other.internal;
        }
    }

    /// Whether nothing acts.
    pub(super) fn is_zero(&self) -> bool {
        self.torque_body_n_m.iter().chain(&self.force_body_n).all(|it| *it == Vector3::zeros())
            && self.mass_flow.is_none()
            && self.dipole.is_none()
    }

    /// Torque without jet damping in N m and acceleration in m/s2.
    pub(super) fn after(&self, elapsed_s: f64) -> [Vector3<f64>; 2] {
        let [torque, force] =
            [self.torque_body_n_m, self.force_body_n].map(|[start, slope]| start + slope * elapsed_s);
        [torque, force / self.mass_after_kg(elapsed_s)]
    }

    pub(super) fn mass_after_kg(&self, elapsed_s: f64) -> f64 {
        let [flow_kg_s, slope_kg_s2] = self.flow_kg_s;
        self.mass_kg - (flow_kg_s + 0.5 * slope_kg_s2 * elapsed_s) * elapsed_s
    }

    /// Inverse of the inertia of body and held rotors after `elapsed_s`, from that at the start, in 1/(kg m2).
    pub(super) fn inverse_inertia_after(&self, at_start: &Matrix3<f64>, elapsed_s: f64) -> Matrix3<f64> {
        let Self { mass_flow, internal, .. } = self;
        if mass_flow.is_none() && internal.is_none() {
            return *at_start;
        }
        let by_flow = mass_flow.map_or(Matrix3::zeros(), |flow| flow.inertia_rate_kg_m2_s * elapsed_s);
        let turned = internal.as_ref().map_or(Matrix3::zeros(), |it| it.inertia_change_after(elapsed_s));
        let grown = Matrix3::identity() + at_start * (by_flow + turned);
        grown.try_inverse().map_or(*at_start, |inverse| inverse * at_start)
    }

    /// Acceleration at the start and its slope there, in m/s2 and m/s3.
    pub(super) fn acceleration_body_m_s2(&self) -> [Vector3<f64>; 2] {
        let start = self.force_body_n[0] / self.mass_kg;
        [start, (self.force_body_n[1] + start * self.flow_kg_s[0]) / self.mass_kg]
    }
}

/// The body at one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyMotion {
    /// EME2000 to body.
    pub attitude: Quaternion,
    /// Angular rate, body frame, in rad/s.
    pub rate_body_rad_s: Vector3<f64>,
    /// Total angular momentum, EME2000, in N m s.
    pub momentum_inertial_n_m_s: Vector3<f64>,
    /// Velocity change by forces other than gravity since the start, EME2000, in m/s.
    pub delta_v_inertial_m_s: Vector3<f64>,
}

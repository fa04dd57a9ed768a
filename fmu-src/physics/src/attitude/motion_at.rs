//! Body at one time of a segment of its motion, and impulses up to there.

use nalgebra::Vector3;

use super::body_load::BodyMotion;
use super::quaternion::Quaternion;
use super::series::{RotationSeries, TERMS};
use crate::numerics::quadrature::GAUSS_3;

/// Attitudes at the nodes of the quadrature over the first `elapsed_s` of a segment.
pub(super) fn node_attitudes(series: &RotationSeries<TERMS>, elapsed_s: f64) -> [Quaternion; 3] {
    GAUSS_3.map(|(node, _)| series.attitude_after(node * elapsed_s))
}

/// Number of rotors whose momenta are kept with the body; those of others are evaluated where they are needed.
pub(super) const KEPT_ROTORS: usize = 4;

/// Body at one time of a segment, and its attitudes at the nodes of the quadrature up to there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MotionAt {
    /// Time of the motion, in s.
    pub time_s: f64,
    /// Time since the start of the segment, in s.
    pub(super) elapsed_s: f64,
    /// The body.
    pub body: BodyMotion,
    pub(super) attitudes: [Quaternion; 3],
    /// Momenta of the first rotors relative to the body, in N m s.
    pub(super) rotors_n_m_s: [f64; KEPT_ROTORS],
}

impl MotionAt {
    /// Change of the total momentum since the start of the segment by a torque, body frame in N m with its slope in N m/s, that acts
    /// from there on: EME2000, in N m s. Those of all parts of the load add up.
    pub fn linear_impulse_inertial_n_m_s(&self, [start, slope]: &[Vector3<f64>; 2]) -> Vector3<f64> {
        if [start, slope].into_iter().all(|it| *it == Vector3::zeros()) {
            return Vector3::zeros();
        }
        self.impulse_inertial_n_m_s(|_, at_s| start + slope * at_s)
    }

    /// The same by a torque in N m, body frame, by attitude and s since the start.
    pub(super) fn impulse_inertial_n_m_s(
        &self,
        torque_body_n_m: impl Fn(&Quaternion, f64) -> Vector3<f64>,
    ) -> Vector3<f64> {
        let torques = GAUSS_3.into_iter().zip(self.attitudes).map(|((node, weight), attitude)| {
            let torque = torque_body_n_m(&attitude, node * self.elapsed_s);
            attitude.inertial_from_body(&torque) * (weight * self.elapsed_s)
        });
        torques.sum()
    }
}

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
}

impl MotionAt {
    /// Change of the total momentum since the start of the segment by each of these torques, body frame in N m with slopes in
    /// N m/s, that act from there on: EME2000, in N m s. Those of the whole load add up to the change of all.
    pub fn impulses_inertial_n_m_s<const N: usize>(
        &self,
        torques: &[Option<[Vector3<f64>; 2]>; N],
    ) -> [Vector3<f64>; N] {
        let impulse =
            |[start, slope]: [Vector3<f64>; 2]| self.impulse_inertial_n_m_s(|_, at_s| start + slope * at_s);
        torques.map(|torque| torque.map_or_else(Vector3::zeros, impulse))
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

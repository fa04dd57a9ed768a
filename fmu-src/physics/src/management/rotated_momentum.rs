//! Momentum at the end of a downlink where the spacecraft turns under it: predictive targets for the physical momentum.
//!
//! Through the science to come the momentum h left with shows as R_k h + d_k in the body frame, R_k the turn since the downlink
//! and d_k what torques have added until then. The mean square of its X and Z components, in parts of their thresholds, is convex in h,
//! h' A h + 2 b' h + c; its least over the X and Z that the downlink can reach is found by golden section, Z within X. The greatest
//! component would leave open where the other one goes; what goes anywhere adds up from cycle to cycle where reach is short. The
//! next downlink is the end of it, since every component can be brought to a target again there. Y is left out: light hardly turns
//! it.

use nalgebra::{Matrix3, Vector3};

use super::profile::ControlAuthority;
use super::searches::golden;

/// Momentum in the body frame at one time of the science to come: R h + d.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RotatedMomentum {
    /// R.
    pub turn: Matrix3<f64>,
    /// d, in N m s.
    pub added_body_n_m_s: Vector3<f64>,
}

/// Squares of X and Z in parts of their thresholds, added up over times, by the momentum h that a downlink leaves.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SquareSum {
    /// A.
    quadratic: Matrix3<f64>,
    /// b.
    linear: Vector3<f64>,
    /// c.
    constant: f64,
}

impl SquareSum {
    /// Adds a time.
    pub fn add(&mut self, at: &RotatedMomentum, threshold_body_n_m_s: &Vector3<f64>) {
        for axis in [0, 2] {
            let part = 1.0 / threshold_body_n_m_s[axis];
            let turn = at.turn.row(axis).transpose() * part;
            let added = at.added_body_n_m_s[axis] * part;
            self.quadratic += turn * turn.transpose();
            self.linear += turn * added;
            self.constant += added * added;
        }
    }

    /// Returns the sum for a momentum that the downlink leaves, body frame, in N m s.
    fn at(&self, momentum: &Vector3<f64>) -> f64 {
        momentum.dot(&(self.quadratic * momentum + self.linear * 2.0)) + self.constant
    }
}

/// The momentum to leave a downlink with, body frame, in N m s: X and Z within these ranges, Y as given.
pub fn best_turned(squares: &SquareSum, [x, z]: [ControlAuthority; 2], y: f64) -> Vector3<f64> {
    let along_z = |x_n_m_s: f64| golden(z[0], z[1], |z_n_m_s| squares.at(&Vector3::new(x_n_m_s, y, z_n_m_s)));
    let (best_x, _) = golden(x[0], x[1], |x_n_m_s| along_z(x_n_m_s).1);
    Vector3::new(best_x, y, along_z(best_x).0)
}

#[cfg(test)]
mod tests;

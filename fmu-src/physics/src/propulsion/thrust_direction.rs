//! Errors of a delta-v's thrust direction: misalignment, drift and jitter, drawn from a seed.
//!
//! The thrust is turned by a small rotation m e1 + d t e2 + j n_s: e1 and e2 are unit vectors across it that the seed chooses, t
//! the time since the thrust began, n_s a pair of normal draws across it, anew every second s.

use nalgebra::Vector3;

use crate::numerics::noise::{Channel, normal_vector};

/// How far the thrust is off its nominal direction.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ThrustErrors {
    /// Constant part, in rad.
    pub misalignment_rad: f64,
    /// Steady change, in rad/s.
    pub drift_rad_s: f64,
    /// Standard deviation about each axis across the thrust, anew every second, in rad.
    pub jitter_rad: f64,
    /// Seed of the random draws.
    pub seed: u64,
}

impl ThrustErrors {
    /// `vector_body` as it is turned `elapsed_s` after the thrust along `thrust_body` (of any length) began.
    pub fn turned(
        &self,
        vector_body: &Vector3<f64>,
        thrust_body: &Vector3<f64>,
        elapsed_s: f64,
    ) -> Vector3<f64> {
        let Some(along) = thrust_body.try_normalize(0.0) else { return *vector_body };
        if self.misalignment_rad == 0.0 && self.drift_rad_s == 0.0 && self.jitter_rad == 0.0 {
            return *vector_body;
        }
        let across = |draw: Vector3<f64>| draw - along * along.dot(&draw);
        let way = |event: u64| {
            let draw = across(normal_vector(self.seed, Channel::ThrustDirection, event));
            draw.try_normalize(0.0).unwrap_or_default()
        };
        let second = elapsed_s.max(0.0).floor() as u64;
        let jitter = across(normal_vector(self.seed, Channel::ThrustJitter, second));
        let turn = way(0) * self.misalignment_rad
            + way(1) * (self.drift_rad_s * elapsed_s)
            + jitter * self.jitter_rad;
        nalgebra::Rotation3::new(turn) * vector_body
    }
}

#[cfg(test)]
mod tests {
    //! Angles, and that the seed alone chooses directions.
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn the_thrust_turns_by_the_angles_given() {
        let along = Vector3::new(0.0, 0.0, 88.0);
        let angle = |errors: ThrustErrors, time_s: f64| errors.turned(&along, &along, time_s).angle(&along);
        let misaligned = ThrustErrors { misalignment_rad: 0.013, seed: 4, ..ThrustErrors::default() };
        assert_relative_eq!(angle(misaligned, 77.0), 0.013, max_relative = 1e-12);
        let drifting = ThrustErrors { drift_rad_s: 1e-5, seed: 4, ..ThrustErrors::default() };
        assert_relative_eq!(angle(drifting, 100.0), 1e-3, max_relative = 1e-9);
        let jittering = ThrustErrors { jitter_rad: 1e-3, seed: 4, ..ThrustErrors::default() };
        let square: f64 = (0..4000).map(|s| angle(jittering, f64::from(s)).powi(2)).sum::<f64>() / 4000.0;
        // Two axes across.
        assert_relative_eq!(square.sqrt(), 2f64.sqrt() * 1e-3, max_relative = 0.05);
        assert_eq!(angle(jittering, 3.1), angle(jittering, 3.9));
        let turned = misaligned.turned(&along, &along, 0.0);
        let other = ThrustErrors { seed: 5, ..misaligned }.turned(&along, &along, 0.0);
        assert_relative_eq!(turned.norm(), 88.0, max_relative = 1e-14);
        assert!((turned - other).norm() > 0.1);
        assert_eq!(ThrustErrors::default().turned(&along, &along, 5.0), along);
    }
}

//! Dispersed flights: draws of state, centre of mass and scale of sunlight by run, and what flights with them came to.
//!
//! A draw is a function of seed and run alone, so results do not depend on the order of the runs or on threads.

use nalgebra::{Matrix2, Matrix6, Vector2, Vector3, Vector6};
use physics::numerics::noise::{Channel, normal, normal_vector};

/// Standard deviations and covariances that are drawn from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dispersions {
    /// Lower triangular root of the covariance of position (m) and velocity (m/s).
    state_root: Option<Matrix6<f64>>,
    /// Standard deviation of each coordinate of the centre of mass, in m.
    pub center_of_mass_m: f64,
    /// Standard deviation of the scale of sunlight.
    pub scale: f64,
}

/// Errors of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Draw {
    /// Position, EME2000, in m.
    pub position_m: Vector3<f64>,
    /// Velocity, EME2000, in m/s.
    pub velocity_m_s: Vector3<f64>,
    /// Centre of mass, body frame, in m.
    pub center_of_mass_m: Vector3<f64>,
    /// Scale of sunlight.
    pub scale: f64,
}

impl Dispersions {
    /// Errors with a covariance of position and velocity; `None` where that is not positive.
    pub fn new(covariance: Option<&Matrix6<f64>>, center_of_mass_m: f64, scale: f64) -> Option<Self> {
        let state_root = match covariance {
            Some(covariance) => Some(covariance.cholesky()?.l()),
            None => None,
        };
        Some(Self { state_root, center_of_mass_m, scale })
    }

    /// Draws the errors of a run.
    pub fn draw(&self, seed: u64, run: u64) -> Draw {
        let of = |number: u16| normal_vector(seed, Channel::Dispersion(number), run);
        let (position, velocity) = (of(0), of(1));
        let normal6 = Vector6::new(position.x, position.y, position.z, velocity.x, velocity.y, velocity.z);
        let state = self.state_root.map_or_else(Vector6::zeros, |root| root * normal6);
        Draw {
            position_m: state.fixed_rows::<3>(0).into_owned(),
            velocity_m_s: state.fixed_rows::<3>(3).into_owned(),
            center_of_mass_m: of(2) * self.center_of_mass_m,
            scale: normal(seed, Channel::Dispersion(3), run) * self.scale,
        }
    }
}

/// Result of a dispersed flight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outcome {
    /// B.T and B.R less the aimpoint, in m.
    pub miss_m: [f64; 2],
    /// Time of closest approach, in s of the flight.
    pub arrival_s: f64,
    /// Altitude of closest approach, in m.
    pub altitude_m: f64,
    /// Greatest |H|, in N m s.
    pub momentum_n_m_s: f64,
}

/// Mean and covariance of the miss, along T and R.
pub fn miss_of(outcomes: &[Outcome]) -> (Vector2<f64>, Matrix2<f64>) {
    let count = outcomes.len().max(2) as f64;
    let mean: Vector2<f64> =
        outcomes.iter().map(|outcome| Vector2::from(outcome.miss_m)).sum::<Vector2<f64>>() / count;
    let square = |outcome: &Outcome| {
        let off = Vector2::from(outcome.miss_m) - mean;
        off * off.transpose()
    };
    (mean, outcomes.iter().map(square).sum::<Matrix2<f64>>() / (count - 1.0))
}

#[cfg(test)]
mod tests {
    //! Moments of many draws against what they are drawn from.
    use super::*;

    #[test]
    fn draws_have_the_covariance_that_was_given() {
        let mut covariance = Matrix6::from_diagonal(&Vector6::new(9e6, 4e6, 1e6, 1e-6, 4e-6, 9e-6));
        (covariance[(0, 3)], covariance[(3, 0)]) = (1.5, 1.5);
        let all = Dispersions::new(Some(&covariance), 0.01, 0.02).unwrap();
        let (count, mut sums) = (20_000_u64, [0.0; 4]);
        for run in 0..count {
            let draw = all.draw(3, run);
            sums[0] += draw.position_m.x.powi(2);
            sums[1] += draw.position_m.x * draw.velocity_m_s.x;
            sums[2] += draw.center_of_mass_m.norm_squared();
            sums[3] += draw.scale.powi(2);
        }
        for (sum, expected) in sums.iter().zip([9e6, 1.5, 3e-4, 4e-4]) {
            assert!((sum / count as f64 / expected - 1.0).abs() < 0.05, "{sum} {expected}");
        }
        assert_eq!(all.draw(3, 11), all.draw(3, 11));
        assert_ne!(all.draw(3, 11), all.draw(4, 11));
        assert!(Dispersions::new(Some(&-covariance), 0.01, 0.02).is_none());
    }
}

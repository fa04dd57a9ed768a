//! Manoeuvres that remove a miss at an encounter, with errors of execution: how large they are and what they leave.
//!
//! Equation: of a miss with mean m and covariance C a manoeuvre of least size is -P (m + c), P = L^T (L L^T)^-1, L the partials by
//! velocity. It errs by s_m |dv| along itself and by s_d |dv| about each axis across, so that it leaves the covariance
//! L E[s_m^2 dv dv^T + s_d^2 (|dv|^2 - dv dv^T)] L^T, in closed form by E[dv dv^T] = P (m m^T + C) P^T.
//! Reference: Gates, A Simplified Model of Midcourse Maneuver Execution Errors, 1963.

use nalgebra::{Matrix2, Matrix2x3, Matrix3, Matrix3x2, SymmetricEigen, Vector2, Vector3};

/// Standard deviations of a manoeuvre's execution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExecutionErrors {
    /// About each axis across, in rad.
    pub direction_rad: f64,
    /// Standard deviation of its size, relative.
    pub magnitude: f64,
}

/// Estimate of a miss in the B-plane.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Miss {
    /// Mean, along T and R, in m.
    pub mean_m: Vector2<f64>,
    /// Covariance, in m2.
    pub covariance_m2: Matrix2<f64>,
}

impl Miss {
    /// Mean of the square of its components.
    fn second_moment_m2(&self) -> Matrix2<f64> {
        self.mean_m * self.mean_m.transpose() + self.covariance_m2
    }

    /// Root mean square of its length, in m.
    pub fn rms_m(&self) -> f64 {
        self.second_moment_m2().trace().max(0.0).sqrt()
    }
}

/// A manoeuvre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Maneuver {
    /// Its mean, EME2000, in m/s.
    pub mean_m_s: Vector3<f64>,
    /// Root mean square of its size, in m/s.
    pub rms_m_s: f64,
    /// Miss after the manoeuvre.
    pub left: Miss,
}

/// The manoeuvre that removes a miss, where a change of velocity moves B by `by_velocity_s`; `None` where that has no inverse.
pub fn approach(miss: &Miss, by_velocity_s: &Matrix2x3<f64>, errors: &ExecutionErrors) -> Option<Maneuver> {
    let inverse = (by_velocity_s * by_velocity_s.transpose()).try_inverse()?;
    let removes = -(by_velocity_s.transpose() * inverse);
    let square = removes * miss.second_moment_m2() * removes.transpose();
    let [along, across] = [errors.magnitude.powi(2), errors.direction_rad.powi(2)];
    let executed = square * along + (Matrix3::identity() * square.trace() - square) * across;
    Some(Maneuver {
        mean_m_s: removes * miss.mean_m,
        rms_m_s: square.trace().max(0.0).sqrt(),
        left: Miss {
            mean_m: Vector2::zeros(),
            covariance_m2: by_velocity_s * executed * by_velocity_s.transpose(),
        },
    })
}

/// Mean (EME2000, m/s) and root mean square of the size of a manoeuvre behind the encounter that is linear in the miss.
pub fn departure(miss: &Miss, by_miss_1_s: &Matrix3x2<f64>) -> (Vector3<f64>, f64) {
    let square = by_miss_1_s * miss.second_moment_m2() * by_miss_1_s.transpose();
    (by_miss_1_s * miss.mean_m, square.trace().max(0.0).sqrt())
}

/// Semi-axes of an ellipse of one standard deviation in m, the larger first, and the angle of that from T toward R in rad.
pub fn ellipse(covariance_m2: &Matrix2<f64>) -> ([f64; 2], f64) {
    let found = SymmetricEigen::new(*covariance_m2);
    let (large, small) = if found.eigenvalues[0] >= found.eigenvalues[1] { (0, 1) } else { (1, 0) };
    let axis = found.eigenvectors.column(large);
    let deviations = [large, small].map(|at| found.eigenvalues[at].max(0.0).sqrt());
    (deviations, axis[1].atan2(axis[0]).rem_euclid(core::f64::consts::PI))
}

#[cfg(test)]
mod tests {
    //! Against draws of the errors, one by one.
    use physics::numerics::noise::{Channel, normal, normal_vector};

    use super::*;

    const BY_VELOCITY_S: [[f64; 3]; 2] = [[3e6, -1e6, 4e5], [2e5, 5e5, 1.5e6]];
    const ERRORS: ExecutionErrors = ExecutionErrors { direction_rad: 0.02, magnitude: 0.05 };

    fn by_velocity() -> Matrix2x3<f64> {
        Matrix2x3::from_rows(&BY_VELOCITY_S.map(nalgebra::RowVector3::from))
    }

    /// 20,000 manoeuvres with a direction turned about both axes across: deviations of samples are 0.5 %.
    #[test]
    fn what_is_left_is_that_of_drawn_errors() {
        let miss =
            Miss { mean_m: Vector2::new(1.7e5, -4e4), covariance_m2: Matrix2::new(4e8, 1e8, 1e8, 9e8) };
        let found = approach(&miss, &by_velocity(), &ERRORS).unwrap();
        let root = miss.covariance_m2.cholesky().unwrap().l();
        let removes = -by_velocity().pseudo_inverse(1e-15).unwrap();
        let (count, mut square, mut left) = (20_000_u64, 0.0, Matrix2::zeros());
        for draw in 0..count {
            let spread = normal_vector(7, Channel::ManeuverDirection, draw);
            let random = miss.mean_m + root * spread.xy();
            let delta_v = removes * random;
            let turns = normal_vector(8, Channel::ManeuverDirection, draw);
            let across = delta_v.cross(&Vector3::new(0.3, -0.2, 0.9)).normalize();
            let other = delta_v.cross(&across).normalize();
            let size = delta_v.norm();
            let error = delta_v * (ERRORS.magnitude * normal(9, Channel::ManeuverMagnitude, draw))
                + (across * turns.x + other * turns.y) * (ERRORS.direction_rad * size);
            let after = random + by_velocity() * (delta_v + error);
            square += size * size / count as f64;
            left += after * after.transpose() / count as f64;
        }
        assert!((found.rms_m_s / square.sqrt() - 1.0).abs() < 5e-3);
        assert!(
            (found.left.covariance_m2 - left).norm() < 0.03 * left.norm(),
            "{} {left}",
            found.left.covariance_m2
        );
        assert!((by_velocity() * found.mean_m_s + miss.mean_m).norm() < 1e-6);
    }

    #[test]
    fn an_ellipse_has_the_axes_of_its_covariance() {
        let (sine, cosine) = 0.4_f64.sin_cos();
        let turn = Matrix2::new(cosine, -sine, sine, cosine);
        let covariance = turn * Matrix2::from_diagonal(&Vector2::new(9.0, 4.0)) * turn.transpose();
        let (axes, angle_rad) = ellipse(&covariance);
        assert!(
            (axes[0] - 3.0).abs() < 1e-12 && (axes[1] - 2.0).abs() < 1e-12 && (angle_rad - 0.4).abs() < 1e-12
        );
    }
}

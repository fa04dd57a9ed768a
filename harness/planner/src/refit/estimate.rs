//! Least squares with priors, by Gauss and Newton, on an expansion of the momentum.
//!
//! With y the deviation of what is fitted from its prior in units of the prior's deviations, the sum
//! |r(y)|^2 / noise^2 + |y|^2 is least, r being telemetry less flight with a free start momentum in each arc. A start momentum moves
//! every row of its arc alike: it is eliminated by taking the arc's mean off r and its derivatives. The normal equations are solved in
//! the principal directions; along those that the history does not determine y is 0 (Tapley, Schutz and Born 2004, chapter 4).

use std::ops::Range;

use nalgebra::{Matrix3x4, Matrix4, Vector3, Vector4};

use super::{
    directions::{Direction, principal},
    expansion::Expansion,
    parameters::{Deviations, Parameters},
    telemetry::Telemetry,
};

/// Steps at most; each squares the error, or divides it by twenty along a valley that bends.
const MAX_STEPS: u32 = 50;
/// Parts of its deviation that a direction may still move by.
const CONVERGED: f64 = 1e-3;

/// History and priors of a fit.
pub struct Requested<'a> {
    /// The history.
    pub telemetry: &'a Telemetry,
    /// The mission's values.
    pub prior: Parameters,
    /// How sure history and prior are.
    pub deviations: Deviations,
}

/// Minimum of the sum of squares.
pub(super) struct Estimate {
    pub parameters: Parameters,
    pub directions: [Direction; 4],
}

impl Requested<'_> {
    /// From `start` on, with the rows of each arc.
    ///
    /// # Errors
    /// Steps that do not end.
    pub(super) fn solve(
        &self,
        arcs: &[Range<usize>],
        expansion: &Expansion,
        start: &Parameters,
    ) -> Result<Estimate, String> {
        let deviations = self.deviations.of_parameters();
        let prior = self.prior.values();
        let mut y = (start.values() - prior).component_div(&deviations);
        for _ in 0..MAX_STEPS {
            let parameters = Parameters::new(&(prior + y.component_mul(&deviations)));
            let (information, gradient) = self.normal(arcs, expansion, &parameters);
            let directions = principal(&information);
            let right = information * y + gradient;
            let determined = directions.iter().filter(|it| it.observable);
            // (J'J + 1) y = J'(r + J y), in which the eigenvalues of the left are 1 / sigma^2.
            let next: Vector4<f64> =
                determined.map(|it| it.vector * (it.vector.dot(&right) * it.sigma.powi(2))).sum();
            let step = next - y;
            y = next;
            if directions.iter().all(|it| it.vector.dot(&step).abs() <= CONVERGED * it.sigma) {
                let parameters = Parameters::new(&(prior + y.component_mul(&deviations)));
                let directions = principal(&self.normal(arcs, expansion, &parameters).0);
                return Ok(Estimate { parameters, directions });
            }
        }
        Err(format!(
            "the fit did not converge in {MAX_STEPS} steps, allowed: a history that the mission's flight is near to: see \
             --prior-center and --prior-scale"
        ))
    }

    /// The normal equations about some parameters, in units of noise and priors: J'J and J'r.
    fn normal(
        &self,
        arcs: &[Range<usize>],
        expansion: &Expansion,
        parameters: &Parameters,
    ) -> (Matrix4<f64>, Vector4<f64>) {
        let scales = self.deviations.of_parameters() / self.deviations.noise_n_m_s;
        let rows: Vec<(Vector3<f64>, Matrix3x4<f64>)> = expansion
            .at(parameters)
            .zip(&self.telemetry.momentum_inertial_n_m_s)
            .map(|((simulated, by), measured)| {
                ((measured - simulated) / self.deviations.noise_n_m_s, by * Matrix4::from_diagonal(&scales))
            })
            .collect();
        let (mut information, mut gradient) = (Matrix4::zeros(), Vector4::zeros());
        for arc in arcs {
            let rows = &rows[arc.clone()];
            let share = 1.0 / rows.len() as f64;
            let (mean, mean_by) = rows.iter().fold((Vector3::zeros(), Matrix3x4::zeros()), |sum, row| {
                (sum.0 + row.0 * share, sum.1 + row.1 * share)
            });
            for (residual, by) in rows {
                let by = (by - mean_by).transpose();
                information += by * by.transpose();
                gradient += by * (residual - mean);
            }
        }
        (information, gradient)
    }
}

/// Telemetry less flight with the start momentum of each arc that fits best, by row, in N m s.
pub(super) fn residuals_n_m_s(
    telemetry: &Telemetry,
    arcs: &[Range<usize>],
    simulated_n_m_s: &[Vector3<f64>],
) -> Vec<Vector3<f64>> {
    let mut residuals: Vec<_> =
        telemetry.momentum_inertial_n_m_s.iter().zip(simulated_n_m_s).map(|(a, b)| a - b).collect();
    for arc in arcs {
        let rows = &mut residuals[arc.clone()];
        let mean = rows.iter().sum::<Vector3<f64>>() / rows.len() as f64;
        rows.iter_mut().for_each(|row| *row -= mean);
    }
    residuals
}

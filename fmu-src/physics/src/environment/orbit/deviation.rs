//! Deviation of a spacecraft from its integrated orbit by forces that depend on the simulated attitude.
//!
//! Equation: d'' = a(t) + g(r + d) - g(r), r on the reference orbit, which includes all other accelerations, a by those forces.
//! Method: Encke's. The acceleration is interpolated at the Chebyshev nodes of an interval on which a is smooth and integrated
//! twice exactly; the difference of gravity is solved by Picard iteration, which converges by (w h)^2 / 12 per iteration, w the mean
//! motion. The orbit is rectified at the start of each of its own segments.
//! Order: 6 in the length h of the interval.
//! Error measure: the iteration stops when the predicted next change is rounding; the truncation error is not estimated: intervals of
//! the attitude are short compared with the orbital period.
//! Reference: Battin, An Introduction to the Mathematics and Methods of Astrodynamics, 10.3.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use crate::environment::CartesianState;
use crate::numerics::Span;
use crate::numerics::chebyshev::Segment;
use crate::numerics::collocation::IntegrationError;

/// Nodes of an interval.
const NODES: usize = 6;
/// Largest number of iterations.
const ITERATIONS: usize = 40;

/// Deviation in position and velocity, EME2000, with dense output over the last interval.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Deviation {
    start_s: f64,
    /// End of the last interval, s.
    pub(super) end_s: f64,
    position_m: Segment<3, { NODES + 2 }>,
    velocity_m_s: Segment<3, { NODES + 1 }>,
}

impl Deviation {
    /// Integrates the deviation from its value `before` at the start of `span` to its end, under `perturbation_m_s2(t)` and the
    /// difference of `gravity_m_s2(r)` from that on the reference orbit `reference_m(t)`.
    ///
    /// # Errors
    /// [`IntegrationError`].
    pub(super) fn integrate(
        before: &CartesianState,
        span: Span,
        reference_m: impl Fn(f64) -> Vector3<f64>,
        gravity_m_s2: impl Fn(&Vector3<f64>) -> Vector3<f64>,
        perturbation_m_s2: Option<impl Fn(f64) -> Vector3<f64>>,
    ) -> Result<Self, IntegrationError> {
        let Span { start_s, end_s } = span;
        let CartesianState { position_m, velocity_m_s } = *before;
        let node_s = Segment::<3, NODES>::nodes(start_s, end_s);
        let known = node_s.map(|at_s| {
            let reference_m = reference_m(at_s);
            let perturbation_m_s2 =
                perturbation_m_s2.as_ref().map_or(Vector3::zeros(), |perturbation| perturbation(at_s));
            (reference_m, perturbation_m_s2 - gravity_m_s2(&reference_m))
        });
        let mut off_m = node_s.map(|at_s| position_m + velocity_m_s * (at_s - start_s));
        let mut last_m = None;
        for _ in 0..ITERATIONS {
            let mut rates = [Vector3::zeros(); NODES];
            for ((rate, (reference_m, apart_m_s2)), off_m) in rates.iter_mut().zip(&known).zip(&off_m) {
                *rate = gravity_m_s2(&(reference_m + off_m)) + apart_m_s2;
            }
            let acceleration = Segment::from_samples(start_s, end_s, &rates);
            let velocity = acceleration.integral(velocity_m_s);
            let position = velocity.integral(position_m);
            let (mut change_m, mut size_m) = (0.0_f64, 0.0_f64);
            for (off_m, &at_s) in off_m.iter_mut().zip(&node_s) {
                let next_m = position.value(at_s);
                change_m = change_m.max((next_m - *off_m).amax());
                size_m = size_m.max(next_m.amax());
                *off_m = next_m;
            }
            if !size_m.is_finite() {
                return Err(IntegrationError::NotFinite { at_s: start_s });
            }
            // Predicted change of the next iteration.
            let gain = last_m.map_or(1.0, |last_m: f64| (change_m / last_m).min(1.0));
            if change_m * gain <= 4.0 * f64::EPSILON * size_m {
                return Ok(Self { start_s, end_s, position_m: position, velocity_m_s: velocity });
            }
            last_m = Some(change_m);
        }
        let change = last_m.unwrap_or(f64::INFINITY);
        Err(IntegrationError::NotConverged { from_s: start_s, to_s: end_s, change })
    }

    /// Position and velocity off the reference orbit at `at_s`; before the interval its start value, after it linear motion.
    pub(super) fn value(&self, at_s: f64) -> CartesianState {
        let within_s = at_s.clamp(self.start_s, self.end_s);
        let velocity_m_s = self.velocity_m_s.value(within_s);
        let position_m = self.position_m.value(within_s) + velocity_m_s * (at_s - within_s).max(0.0);
        CartesianState { position_m, velocity_m_s }
    }

    /// Rejects decoded states that no simulation can produce.
    pub(super) fn is_valid(&self) -> bool {
        self.start_s <= self.end_s
            && self.position_m.is_valid()
            && self.position_m.spans(self.start_s, self.end_s)
            && self.velocity_m_s.is_valid()
            && self.velocity_m_s.spans(self.start_s, self.end_s)
    }
}

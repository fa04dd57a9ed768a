//! Coarse ephemeris: polynomials of fourth degree in time of the classical Keplerian elements (paper 001).
//!
//! The elements are those of the osculating ellipse in EME2000, whose equator no planet's orbit lies in, so that every node
//! is defined. Coefficients are of Chebyshev polynomials over the span: what the first five of a longer series are is the
//! fit of least squares with Chebyshev's weight. Evaluated, the elements become a state by Kepler's equation.

use core::f64::consts::TAU;

use nalgebra::SVector;

use crate::bodies::Body;
use crate::environment::CartesianState;
use crate::environment::orbit::Elements;
use crate::environment::orbit::kepler::{Anomaly, eccentric_anomaly};
use crate::math;
use crate::numerics::Span;
use crate::numerics::chebyshev::Segment;

/// Coefficients of an element: fourth degree.
pub const COARSE_TERMS: usize = 5;

/// Semi-major axis in m, eccentricity, inclination, ascending node, argument of periapsis and mean anomaly in rad.
pub type KeplerianElements = SVector<f64, 6>;

/// The polynomials of one body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CoarseElements {
    /// Body about which it moves.
    pub center: Body,
    /// First and last epoch; those of the polynomials are rounded otherwise.
    pub span: Span,
    /// The elements over the span.
    pub elements: Segment<6, COARSE_TERMS>,
}

impl CoarseElements {
    /// Fits elements at the nodes of a span, [`Segment::nodes`]; mean anomalies run on over full turns.
    pub fn from_elements<const N: usize>(
        center: Body,
        span: Span,
        elements: &[KeplerianElements; N],
    ) -> Self {
        let Span { start_s, end_s } = span;
        let whole = Segment::from_samples(start_s, end_s, elements);
        let lowest = whole.coefficients().fixed_columns::<COARSE_TERMS>(0).into_owned();
        Self { center, span, elements: Segment::from_coefficients(start_s, end_s, lowest) }
    }

    /// Position and velocity about the centre; `None` outside the span and where the polynomials give no ellipse.
    pub fn state(&self, epoch_s: f64) -> Option<CartesianState> {
        if !self.span.contains(epoch_s) {
            return None;
        }
        let elements = self.elements.value(epoch_s);
        let [a_m, e, inclination_rad, node_rad, periapsis_rad, mean_rad] = elements.data.0[0];
        if !(0.0..1.0).contains(&e) {
            return None;
        }
        let Anomaly { sin, cos, .. } = eccentric_anomaly(mean_rad % TAU, e, 1.0 - e);
        let elements = Elements {
            semi_major_axis_m: a_m,
            eccentricity: e,
            inclination_rad,
            ascending_node_rad: node_rad,
            periapsis_argument_rad: periapsis_rad,
            true_anomaly_rad: math::atan2(((1.0 - e) * (1.0 + e)).sqrt() * sin, cos - e),
        };
        elements.state(self.center.data().gm_m3_s2).ok()
    }
}

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

/// States that a fit is made of.
pub const COARSE_SAMPLES: usize = 256;

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

    /// Fits states about the centre at the nodes of a span, from the last to the first; `None` where one is no ellipse.
    pub fn from_states(center: Body, span: Span, states: &[CartesianState; COARSE_SAMPLES]) -> Option<Self> {
        let nodes_s = Segment::<6, COARSE_SAMPLES>::nodes(span.start_s, span.end_s);
        let mut elements = [KeplerianElements::zeros(); COARSE_SAMPLES];
        let mut later: Option<(f64, KeplerianElements)> = None;
        for ((state, at_s), slot) in states.iter().zip(nodes_s).zip(&mut elements) {
            let mut found = classical(state, center)?;
            if let Some((later_s, later)) = later {
                // The mean anomaly continues by the mean motion, the other angles hardly at all.
                let a_m = 0.5 * (found[0] + later[0]);
                let motion_rad_s = (center.data().gm_m3_s2 / (a_m * a_m * a_m)).sqrt();
                for (angle, expected) in
                    [(3, later[3]), (4, later[4]), (5, later[5] - motion_rad_s * (later_s - at_s))]
                {
                    found[angle] -= ((found[angle] - expected) / TAU).round() * TAU;
                }
            }
            later = Some((at_s, found));
            *slot = found;
        }
        Some(Self::from_elements(center, span, &elements))
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

/// The elements of an ellipse; `None` for another orbit.
fn classical(state: &CartesianState, center: Body) -> Option<KeplerianElements> {
    let elements = Elements::from_state(state, center.data().gm_m3_s2).ok()?;
    let e = elements.eccentricity;
    if e >= 1.0 {
        return None;
    }
    let (sin, cos) = math::sin_cos(elements.true_anomaly_rad);
    let eccentric_rad = math::atan2(((1.0 - e) * (1.0 + e)).sqrt() * sin, cos + e);
    Some(KeplerianElements::from([
        elements.semi_major_axis_m,
        e,
        elements.inclination_rad,
        elements.ascending_node_rad,
        elements.periapsis_argument_rad,
        eccentric_rad - e * math::sin(eccentric_rad),
    ]))
}

//! Deviation of a spacecraft from its integrated orbit by thrust that becomes known only while it acts.
//!
//! Equation: d'' = a(t) + g(r + d) - g(r), r on the reference orbit, which has every other acceleration, a by thrust.
//! Method: Encke's; Gauss collocation of the orbit's own order over each interval on which a is smooth. The orbit is rectified,
//! that is takes the deviation, wherever its own segments are computed anew.
//! Order: 16 at the ends of the intervals.
//! Error measure: none; intervals are those of the attitude, which are short to the orbit.
//! Reference: Battin, An Introduction to the Mathematics and Methods of Astrodynamics, 10.3.

use nalgebra::{SVector, Vector3};
use serde::{Deserialize, Serialize};

use crate::numerics::chebyshev::Segment;
use crate::numerics::collocation::{Collocation, IntegrationError};

/// Nodes of a segment.
pub(super) const NODES: usize = 8;
/// Coefficients of a segment's dense output.
pub(super) const TERMS: usize = NODES + 1;

/// Deviation in position (m) and velocity (m/s), EME2000, with dense output over the last interval.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Deviation {
    start_s: f64,
    end_s: f64,
    end: SVector<f64, 6>,
    segment: Segment<6, TERMS>,
}

impl Deviation {
    /// Integrates from `start_s`, where the deviation so far is `before`, to `end_s`; `acceleration_m_s2(t, d)` is d'' in m/s2.
    ///
    /// # Errors
    /// See [`Collocation::solve`].
    pub(super) fn integrate(
        method: &Collocation<NODES, TERMS>,
        before: &SVector<f64, 6>,
        [start_s, end_s]: [f64; 2],
        mut acceleration_m_s2: impl FnMut(f64, &Vector3<f64>) -> Vector3<f64>,
    ) -> Result<Self, IntegrationError> {
        let (segment, end) = method.solve(start_s, end_s, before, None, |at_s, y| {
            let acceleration = acceleration_m_s2(at_s, &Vector3::new(y[0], y[1], y[2]));
            SVector::from([y[3], y[4], y[5], acceleration.x, acceleration.y, acceleration.z])
        })?;
        Ok(Self { start_s, end_s, end, segment })
    }

    /// Position and velocity off the reference orbit at `at_s`; beyond the interval as at its start, or going on evenly.
    pub(super) fn value(&self, at_s: f64) -> SVector<f64, 6> {
        if at_s < self.end_s {
            return self.segment.value(at_s.max(self.start_s));
        }
        let mut value = self.end;
        for i in 0..3 {
            value[i] += self.end[i + 3] * (at_s - self.end_s);
        }
        value
    }

    /// Rejects decoded states that no simulation can produce.
    pub(super) fn is_valid(&self) -> bool {
        self.segment.is_valid() && self.segment.spans(self.start_s, self.end_s)
    }
}

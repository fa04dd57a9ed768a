//! Segments of light and heat: they change slowly and cost more than everything else, so they are computed at a few nodes of
//! a segment of their own and read from a polynomial in between. How the flight is stepped does not matter to them.
//!
//! Equation: force and torque of each effect as functions of time; temperatures of surfaces that store heat.
//! Method: interpolation at 6 Chebyshev nodes, the segment shortened until its last terms are below the tolerance
//! ([`crate::numerics::adaptive`]); it ends at an event. Stored heat is integrated along the segment between the nodes
//! (`stored_heat`).
//! Order: 6 in the length.
//! Error measure: the last two terms of force and torque, relative to the largest force and torque of all effects in the
//! segment; a torque counts against the largest force at an arm of 1 cm at least.
//! Reference: see [`crate::numerics::adaptive`].

use serde::{Deserialize, Serialize};

use crate::loads::{ByEffect, ForceTorque, Loads};
use crate::numerics::Span;
use crate::numerics::adaptive::SegmentSpan;
use crate::numerics::chebyshev::Segment;
use crate::plant::settings::digest::Digest;

/// Chebyshev nodes a segment.
pub(crate) const NODES: usize = 6;
/// Force and torque of one effect.
pub(crate) type LoadSeries = Segment<6, NODES>;
/// No surface is hotter, in K.
pub(crate) const HOTTEST_K: f64 = 1e5;

/// Light and heat over one interval, and the heat stored at its end. The default stands before the first segment.
#[derive(Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct RadiationSegment {
    pub(crate) span: SegmentSpan,
    /// Digest of the settings that it was made for.
    pub(crate) made_for: Digest,
    /// Absent for effects that do not act, and before the first segment for all.
    pub(crate) loads: ByEffect<Option<LoadSeries>>,
    /// Temperature of every face in K; empty where no heat is stored and no air meets the faces.
    pub(crate) temperatures_k: Vec<Segment<1, NODES>>,
    /// The same at the end.
    pub(crate) end_k: Vec<f64>,
}

impl Clone for RadiationSegment {
    fn clone(&self) -> Self {
        let mut copy = Self::default();
        copy.clone_from(self);
        copy
    }

    /// Allocates nothing where `self` held as many temperatures before.
    fn clone_from(&mut self, other: &Self) {
        (self.span, self.made_for, self.loads) = (other.span, other.made_for, other.loads);
        self.temperatures_k.clone_from(&other.temperatures_k);
        self.end_k.clone_from(&other.end_k);
    }
}

impl RadiationSegment {
    /// Whether a simulation can produce it.
    pub fn is_valid(&self) -> bool {
        let hot = |kelvin: &f64| (0.0..=HOTTEST_K).contains(kelvin);
        let Span { start_s, end_s } = self.span.span();
        self.span.is_valid()
            && self.loads.present().all(|(_, it)| it.is_valid() && it.spans(start_s, end_s))
            && self.temperatures_k.iter().all(|it| {
                let most_k: f64 = it.coefficients().iter().map(|c| c.abs()).sum();
                it.is_valid() && it.spans(start_s, end_s) && most_k <= 10.0 * HOTTEST_K
            })
            && self.end_k.iter().all(hot)
    }

    /// Whether it has come to `time_s` and no segment further; so in every flight, not in every sequence of bytes.
    pub fn covers(&self, time_s: f64) -> bool {
        self.span.covers(time_s)
    }

    /// Writes force and torque of its effects at `time_s`.
    pub(crate) fn write_loads(&self, time_s: f64, loads: &mut Loads) {
        for (effect, series) in self.loads.present() {
            let values = series.value(time_s);
            loads[effect] = ForceTorque {
                force_body_n: values.fixed_rows::<3>(0).into(),
                torque_body_n_m: values.fixed_rows::<3>(3).into(),
            };
        }
    }

    /// Temperatures in K of the faces at `time_s`; leaves `temperatures_k` alone where no heat is stored.
    pub(crate) fn temperatures_at(&self, time_s: f64, temperatures_k: &mut [f64]) {
        for (face, kelvin) in temperatures_k.iter_mut().enumerate() {
            let inside = self.temperatures_k.get(face).filter(|_| time_s < self.span.end_s);
            if let Some(known_k) =
                inside.map(|series| series.value(time_s)[0]).or(self.end_k.get(face).copied())
            {
                *kelvin = known_k;
            }
        }
    }

    /// Ends at `time_s`: the flight changes there.
    pub(crate) fn cut(&mut self, time_s: f64) {
        if time_s > self.span.start_s && time_s < self.span.end_s {
            for (kelvin, series) in self.end_k.iter_mut().zip(&self.temperatures_k) {
                *kelvin = series.value(time_s)[0];
            }
        }
        self.span.cut(time_s);
    }
}

//! A body's position and velocity by Chebyshev segments one after the other.
//!
//! On a segment every component is the sum of `c_k T_k(x)`, x from -1 to 1 over the segment, and the velocity is its
//! derivative, as in SPK kernels of type 2.

use nalgebra::Vector3;

use crate::environment::CartesianState;
use crate::numerics::Span;
use crate::numerics::chebyshev::series_at;

/// A polynomial of position.
#[derive(Clone, Debug, PartialEq)]
pub struct EphemerisSegment {
    /// Start, in s past J2000 TDB.
    pub start_s: f64,
    /// End, in s past J2000 TDB.
    pub end_s: f64,
    /// Coefficients of x, y and z in m, item k for `T_k`.
    pub coefficients_m: Vec<[f64; 3]>,
}

impl EphemerisSegment {
    /// Position and velocity at an epoch inside.
    pub fn state(&self, epoch_s: f64) -> CartesianState {
        let length_s = self.end_s - self.start_s;
        let x = ((epoch_s - self.start_s) - (self.end_s - epoch_s)) / length_s;
        let (position_m, slope_m) = series_at(&self.coefficients_m, x);
        CartesianState {
            position_m: Vector3::from(position_m),
            velocity_m_s: Vector3::from(slope_m) * (2.0 / length_s),
        }
    }
}

/// Segments without gaps. At a common edge the later one counts.
#[derive(Clone, Debug, PartialEq)]
pub struct SegmentTable {
    /// At least one, in order and without gaps.
    pub(super) segments: Vec<EphemerisSegment>,
}

impl SegmentTable {
    /// At least one segment; each begins where the one before ends.
    pub fn new(segments: Vec<EphemerisSegment>) -> Option<Self> {
        let is_ordered = segments.iter().all(|segment| segment.start_s < segment.end_s);
        let is_whole = segments.windows(2).all(|pair| pair[0].end_s == pair[1].start_s);
        (!segments.is_empty() && is_ordered && is_whole).then_some(Self { segments })
    }

    /// The segments in the order of time.
    pub fn segments(&self) -> &[EphemerisSegment] {
        &self.segments
    }

    /// First and last epoch.
    pub fn span(&self) -> Span {
        let start_s = self.segments.first().map_or(f64::NAN, |segment| segment.start_s);
        Span::new(start_s, self.segments.last().map_or(f64::NAN, |segment| segment.end_s))
    }

    /// Position and velocity; `None` outside the span.
    pub fn state(&self, epoch_s: f64) -> Option<CartesianState> {
        self.segment(epoch_s).map(|segment| segment.state(epoch_s))
    }

    /// The first end of a segment after an epoch; infinite behind the last one.
    pub fn smooth_until_s(&self, epoch_s: f64) -> f64 {
        let ended = self.segments.partition_point(|segment| segment.end_s <= epoch_s);
        self.segments.get(ended).map_or(f64::INFINITY, |segment| segment.end_s)
    }

    fn segment(&self, epoch_s: f64) -> Option<&EphemerisSegment> {
        let begun = self.segments.partition_point(|segment| segment.start_s <= epoch_s);
        let segment = self.segments.get(begun.checked_sub(1)?)?;
        (epoch_s <= segment.end_s).then_some(segment)
    }
}

//! Gravity of several bodies, and how a path between them is integrated.

use super::gravity_model::GravityModel;
use super::orbit_method::TERMS;
use crate::bodies::Body;
use crate::numerics::chebyshev::Segment;

/// No segment is shortened below this for what light does, in s.
const SHORTEST_LIT_S: f64 = 60.0;

/// Settings of a path between bodies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NBodySettings {
    /// Whether the path is integrated about the planet whose sphere of influence it is in. A body that the spacecraft's file places,
    /// which may move by the Sun alone, is never left.
    pub changes_center: bool,
    /// Longest segment, s.
    pub cell_s: f64,
    /// Greatest last term of a segment's position, m.
    pub tolerance_m: f64,
}

/// Gravity of several bodies with the settings of a path between them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NBodyGravity {
    /// List of what attracts.
    pub model: GravityModel,
    /// Settings of the path.
    pub(super) settings: NBodySettings,
}

impl NBodyGravity {
    /// Returns the gravity of `model`, the path integrated by `settings`.
    pub fn new(settings: NBodySettings, model: GravityModel) -> Self {
        let changes_center = settings.changes_center && model.center != Body::Custom;
        Self { model, settings: NBodySettings { changes_center, ..settings } }
    }

    /// Tells whether a segment's position is as good as the settings say, or as its rounding allows.
    pub(super) fn is_resolved(&self, segment: &Segment<6, TERMS>) -> bool {
        let rows = segment.coefficients().fixed_rows::<3>(0);
        let rounding_m = 8.0 * f64::EPSILON * rows.column(0).norm();
        rows.column(TERMS - 1).norm() <= self.settings.tolerance_m.max(rounding_m)
    }

    /// Tells whether an acceleration over a segment is resolved: the effect of its last term on the position, were it constant, is the
    /// measure.
    pub fn resolves<const N: usize>(&self, acceleration_m_s2: &Segment<3, N>) -> bool {
        let length_s = acceleration_m_s2.end() - acceleration_m_s2.start();
        let last_m_s2 = acceleration_m_s2.coefficients().column(N - 1).norm();
        let off_m = 0.5 * last_m_s2 * length_s * length_s;
        // A shorter segment does not mend an acceleration that is not a number.
        length_s <= SHORTEST_LIT_S || off_m.is_nan() || off_m <= self.settings.tolerance_m
    }
}

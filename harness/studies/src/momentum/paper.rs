//! What the paper prints.

use super::cases::{Case, Convention};
use super::spacing::Spacing;

/// One cell of Tables 2 and 3, strategy "thruster dumps only".
pub struct PaperRow {
    threshold_n_m_s: f64,
    offset_m: f64,
    /// Table 2.
    pub dumps: i64,
    /// Table 3.
    pub spacing: Spacing,
}

const ROWS: &[PaperRow] = &[
    row(4.0, 0.0, 4, [7.0, 45.0, 7.0, 10.0]),
    row(4.0, -0.0254, 9, [5.0, 15.5, 5.0, 11.0]),
    row(4.0, -0.0508, 14, [4.0, 21.0, 4.0, 6.0]),
    row(7.0, 0.0, 2, [55.0; 4]),
    row(7.0, -0.0254, 6, [3.5, 25.5, 10.0, 20.0]),
    row(7.0, -0.0508, 8, [7.0, 25.0, 7.0, 12.0]),
];

/// Gaps in days: closest, farthest, and the typical range.
const fn row(
    threshold_n_m_s: f64,
    offset_m: f64,
    dumps: i64,
    [closest_d, farthest_d, low_d, high_d]: [f64; 4],
) -> PaperRow {
    let spacing = Spacing::stated(dumps as usize, closest_d, farthest_d, (low_d, high_d));
    PaperRow { threshold_n_m_s, offset_m, dumps, spacing }
}

impl PaperRow {
    /// The paper's cell for a case, where it has one.
    pub fn of(case: &Case) -> Option<&'static Self> {
        let same = |row: &&Self| row.threshold_n_m_s == case.threshold_n_m_s && row.offset_m == case.offset_m;
        ROWS.iter().filter(|_| case.convention == Convention::BodyIntegral).find(same)
    }
}

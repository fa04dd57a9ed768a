//! What the paper prints.

use super::cases::{Case, Convention};

/// One cell of Tables 2 and 3, strategy "thruster dumps only".
pub struct PaperRow {
    threshold_n_m_s: f64,
    offset_m: f64,
    /// Table 2.
    pub dumps: i64,
    /// Table 3.
    pub spacing: &'static str,
}

const ROWS: &[PaperRow] = &[
    row(4.0, 0.0, 4, "closest 7 d, farthest 45 d, typical 7-10 d"),
    row(4.0, -0.0254, 9, "closest 5 d, farthest 15.5 d, typical 5-11 d"),
    row(4.0, -0.0508, 14, "closest 4 d, farthest 21 d, typical 4-6 d"),
    row(7.0, 0.0, 2, "2, 55 d apart"),
    row(7.0, -0.0254, 6, "closest 3.5 d, farthest 25.5 d, typical 10-20 d"),
    row(7.0, -0.0508, 8, "closest 7 d, farthest 25 d, typical 7-12 d"),
];

const fn row(threshold_n_m_s: f64, offset_m: f64, dumps: i64, spacing: &'static str) -> PaperRow {
    PaperRow { threshold_n_m_s, offset_m, dumps, spacing }
}

impl PaperRow {
    /// The paper's cell for a case, where it has one.
    pub fn of(case: &Case) -> Option<&'static Self> {
        let same = |row: &&Self| row.threshold_n_m_s == case.threshold_n_m_s && row.offset_m == case.offset_m;
        ROWS.iter().filter(|_| case.convention == Convention::BodyIntegral).find(same)
    }
}

//! What the paper prints.

use super::cases::{Case, Convention, Shade};
use super::spacing::Spacing;

/// Counts may differ from the paper's by this much: its pointing rules, epoch and windows are unpublished.
const COUNT_TOLERANCE: i64 = 2;

/// One cell of Tables 2 and 3, strategy "thruster dumps only".
pub struct PaperRow {
    threshold_n_m_s: f64,
    offset_m: f64,
    /// Table 2.
    dumps: i64,
    /// Table 3.
    spacing: Spacing,
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

/// What the paper prints of a case.
pub enum Published {
    /// A cell of its tables.
    Row(&'static PaperRow),
    /// "Comparable to the cases using the cylindrical shade": as many dumps as those with a higher and a lower threshold.
    Comparable {
        /// With large wheels.
        fewest: i64,
        /// With small ones.
        most: i64,
    },
}

impl Published {
    /// Of a case; the paper prints nothing for plates alone, nor for the physical momentum.
    pub fn of(case: &Case) -> Option<Self> {
        if case.convention != Convention::BodyIntegral {
            return None;
        }
        let mut at_offset = ROWS.iter().filter(|row| row.offset_m == case.offset_m);
        match case.shade {
            Shade::Cylinder => {
                at_offset.find(|row| row.threshold_n_m_s == case.threshold_n_m_s).map(Self::Row)
            }
            Shade::Plates => None,
            Shade::PlatesAndPanels => {
                let counts: Vec<i64> = at_offset.map(|row| row.dumps).collect();
                Some(Self::Comparable { fewest: *counts.iter().min()?, most: *counts.iter().max()? })
            }
        }
    }

    /// For tables.
    pub fn dumps(&self) -> String {
        match self {
            Self::Row(row) => row.dumps.to_string(),
            Self::Comparable { fewest, most } => format!("{fewest} to {most}"),
        }
    }

    /// How a number of dumps compares.
    pub fn against(&self, dumps: i64) -> &'static str {
        match self {
            Self::Row(row) if (dumps - row.dumps).abs() <= COUNT_TOLERANCE => "within 2",
            Self::Comparable { fewest, most } if (*fewest..=*most).contains(&dumps) => "comparable",
            Self::Row(_) | Self::Comparable { .. } => "off",
        }
    }

    /// The gaps between dumps, where the paper prints them.
    pub fn spacing(&self) -> Option<&'static Spacing> {
        match self {
            Self::Row(row) => Some(&row.spacing),
            Self::Comparable { .. } => None,
        }
    }
}

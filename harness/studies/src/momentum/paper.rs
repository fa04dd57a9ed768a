//! What paper 000 prints: its Tables 2 to 5.

use super::cases::{Convention, DumpsTo, MomentumCase, Shade, Strategy};
use super::spacing::Spacing;

/// Counts may differ from the paper's by this much: its pointing rules, epoch and windows are unpublished.
const COUNT_TOLERANCE: i64 = 2;

/// One cell of Tables 2 and 3, or of 4 and 5.
pub(super) struct PaperRow {
    shade: Shade,
    strategy: Strategy,
    threshold_n_m_s: f64,
    offset_in: [i8; 3],
    /// The number of Tables 2 and 4, the gaps of Tables 3 and 5.
    spacing: Spacing,
}

use Strategy::{DumpsOnly, Predictive, Reactive};

const ROWS: &[PaperRow] = &[
    cylinder(DumpsOnly, 4.0, 0, 4, Some((7.0, 45.0)), Some((7.0, 10.0))),
    cylinder(DumpsOnly, 4.0, -1, 9, Some((5.0, 15.5)), Some((5.0, 11.0))),
    cylinder(DumpsOnly, 4.0, -2, 14, Some((4.0, 21.0)), Some((4.0, 6.0))),
    cylinder(Reactive, 4.0, 0, 1, None, None),
    cylinder(Reactive, 4.0, -1, 2, Some((11.0, 11.0)), None),
    cylinder(Reactive, 4.0, -2, 8, Some((4.5, 39.0)), Some((4.0, 11.0))),
    cylinder(Predictive, 4.0, 0, 0, None, None),
    cylinder(Predictive, 4.0, -1, 1, None, None),
    cylinder(Predictive, 4.0, -2, 5, Some((5.0, 50.0)), None),
    cylinder(DumpsOnly, 7.0, 0, 2, Some((55.0, 55.0)), None),
    cylinder(DumpsOnly, 7.0, -1, 6, Some((3.5, 25.5)), Some((10.0, 20.0))),
    cylinder(DumpsOnly, 7.0, -2, 8, Some((7.0, 25.0)), Some((7.0, 12.0))),
    cylinder(Reactive, 7.0, 0, 0, None, None),
    cylinder(Reactive, 7.0, -1, 1, None, None),
    cylinder(Reactive, 7.0, -2, 4, Some((7.0, 53.0)), Some((10.0, 17.0))),
    cylinder(Predictive, 7.0, 0, 0, None, None),
    cylinder(Predictive, 7.0, -1, 0, None, None),
    cylinder(Predictive, 7.0, -2, 2, Some((11.0, 11.0)), None),
    panels([0, 0, -1], 2, (11.0, 11.0), None),
    panels([0, 0, -2], 9, (4.0, 30.0), Some((4.0, 9.0))),
    panels([0, 0, 1], 2, (4.5, 4.5), None),
    panels([0, 0, 2], 8, (3.0, 12.0), Some((4.0, 11.0))),
    panels([1, 1, 1], 5, (9.0, 20.0), None),
    panels([-1, -1, -1], 5, (5.0, 38.0), None),
];

/// A cell of Tables 2 and 3: the closest and the farthest gap, and the typical range, in days. Six arguments, as it is printed.
const fn cylinder(
    strategy: Strategy,
    threshold_n_m_s: f64,
    z_in: i8,
    dumps: i64,
    extremes_d: Option<(f64, f64)>,
    typical_d: Option<(f64, f64)>,
) -> PaperRow {
    let spacing = Spacing { dumps, extremes_d, typical_d };
    PaperRow { shade: Shade::Cylinder, strategy, threshold_n_m_s, offset_in: [0, 0, z_in], spacing }
}

/// A cell of Tables 4 and 5.
const fn panels(
    offset_in: [i8; 3],
    dumps: i64,
    extremes_d: (f64, f64),
    typical_d: Option<(f64, f64)>,
) -> PaperRow {
    let row = cylinder(Reactive, 5.5, 0, dumps, Some(extremes_d), typical_d);
    PaperRow { shade: Shade::PlatesAndPanels, offset_in, ..row }
}

/// What the paper prints of a case.
pub(super) enum Published {
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
    /// Of a case; the paper prints nothing for plates alone, for the physical momentum, nor for dumps to anything but what its
    /// text says. Dumps to 0.9 of the threshold are compared all the same, as the nearest that is well conditioned.
    pub(super) fn of(case: &MomentumCase) -> Option<Self> {
        let is_papers = matches!(case.dumps_to, DumpsTo::PAPER | DumpsTo::OWN);
        if case.convention != Convention::BodyIntegral || !is_papers {
            return None;
        }
        let with = |shade: Shade| {
            let same = move |row: &&PaperRow| {
                row.shade == shade && row.strategy == case.strategy && row.offset_in == case.offset_in
            };
            ROWS.iter().filter(same)
        };
        let own = with(case.shade).find(|row| row.threshold_n_m_s == case.threshold_n_m_s);
        if own.is_some() || case.shade != Shade::PlatesAndPanels {
            return own.map(Self::Row);
        }
        let counts: Vec<i64> = with(Shade::Cylinder).map(|row| row.spacing.dumps).collect();
        Some(Self::Comparable { fewest: *counts.iter().min()?, most: *counts.iter().max()? })
    }

    /// For tables.
    pub(super) fn dumps(&self) -> String {
        match self {
            Self::Row(row) => row.spacing.dumps.to_string(),
            Self::Comparable { fewest, most } => format!("{fewest} to {most}"),
        }
    }

    /// How a number of dumps compares.
    pub(super) fn against(&self, dumps: i64) -> &'static str {
        match self {
            Self::Row(row) if (dumps - row.spacing.dumps).abs() <= COUNT_TOLERANCE => "within 2",
            Self::Comparable { fewest, most } if (*fewest..=*most).contains(&dumps) => "comparable",
            Self::Row(_) | Self::Comparable { .. } => "off",
        }
    }

    /// The gaps between dumps, where the paper prints them.
    pub(super) fn spacing(&self) -> Option<&'static Spacing> {
        match self {
            Self::Row(row) => Some(&row.spacing),
            Self::Comparable { .. } => None,
        }
    }
}

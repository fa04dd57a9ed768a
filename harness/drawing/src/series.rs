//! Data of a chart: series in panels.

use super::{
    axes::is_drawable,
    envelope::{self, Envelope},
};

/// How a series is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Mark {
    /// Straight lines from point to point.
    #[default]
    Line,
    /// The same, drawn as it is however often it swings up and down.
    Curve,
    /// Dots.
    Dots,
    /// Rings, in which the dots of another series can sit.
    Rings,
    /// A dashed line, as for a limit.
    Dashed,
    /// A staircase: each value holds until the next, as flags and counts do.
    Steps,
    /// Bars from zero, each up to the x of the next point, as in a histogram; the last point ends the last bar.
    Bars,
}

/// Opacity of each band about a line; bands darken where they overlap.
pub(super) const BAND_OPACITY: f64 = 0.18;

/// A range about a line, such as that between two percentiles.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Band {
    /// Text of the legend; empty for no entry.
    pub label: String,
    /// Its edges, with the same x each.
    pub range: Envelope,
}

/// One line of a panel.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Series {
    /// Text of the legend; empty for no entry.
    pub label: String,
    /// Points in ascending x; a point that is not finite interrupts the line.
    pub points: Vec<(f64, f64)>,
    /// Line or dots.
    pub mark: Mark,
    /// Ranges about the line, in its colour under it, the widest first.
    pub bands: Vec<Band>,
}

impl Series {
    /// A line through `points`.
    pub fn line(label: impl Into<String>, points: Vec<(f64, f64)>) -> Self {
        Self { label: label.into(), points, mark: Mark::Line, bands: Vec::new() }
    }

    /// A line through `points` that is compared with another and so never drawn as an envelope.
    pub fn curve(label: impl Into<String>, points: Vec<(f64, f64)>) -> Self {
        Self { label: label.into(), points, mark: Mark::Curve, bands: Vec::new() }
    }

    /// Dots at `points`.
    pub fn dots(label: impl Into<String>, points: Vec<(f64, f64)>) -> Self {
        Self { label: label.into(), points, mark: Mark::Dots, bands: Vec::new() }
    }

    /// Rings about `points`.
    pub fn rings(label: impl Into<String>, points: Vec<(f64, f64)>) -> Self {
        Self { label: label.into(), points, mark: Mark::Rings, bands: Vec::new() }
    }

    /// A dashed line through `points`.
    pub fn dashed(label: impl Into<String>, points: Vec<(f64, f64)>) -> Self {
        Self { label: label.into(), points, mark: Mark::Dashed, bands: Vec::new() }
    }

    /// A staircase through `points`.
    pub fn steps(label: impl Into<String>, points: Vec<(f64, f64)>) -> Self {
        Self { label: label.into(), points, mark: Mark::Steps, bands: Vec::new() }
    }

    /// Bars from zero over the spans between `points`.
    pub fn bars(label: impl Into<String>, points: Vec<(f64, f64)>) -> Self {
        Self { label: label.into(), points, mark: Mark::Bars, bands: Vec::new() }
    }

    /// The series with ranges about it, the widest first.
    #[must_use]
    pub fn with_bands(self, bands: impl IntoIterator<Item = Band>) -> Self {
        Self { bands: bands.into_iter().collect(), ..self }
    }

    /// The series drawn otherwise.
    #[must_use]
    pub fn drawn(self, mark: Mark) -> Self {
        Self { mark, ..self }
    }

    /// The corners of the staircase.
    pub(super) fn corners(&self) -> Vec<(f64, f64)> {
        let mut corners: Vec<(f64, f64)> = Vec::with_capacity(2 * self.points.len());
        for &(x, y) in &self.points {
            // The value before holds up to here.
            if let Some(&(_, held)) = corners.last()
                && held != y
            {
                corners.push((x, held));
            }
            corners.push((x, y));
        }
        corners
    }
}

impl Series {
    /// Whether a part of it is drawn by its extremes.
    pub(super) fn has_band(&self) -> bool {
        self.mark == Mark::Line && pieces(&self.points).any(|piece| envelope::envelope(piece).is_some())
    }
}

/// One of a chart's stacked panels.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Panel {
    /// Above its lines, to the left; empty for none.
    pub title: String,
    /// Label of the vertical axis, with its unit in brackets.
    pub y_label: String,
    /// The lines.
    pub series: Vec<Series>,
    /// Vertical range; otherwise that of the data with a margin.
    pub y_range: Option<(f64, f64)>,
    /// Values marked by a dashed horizontal line, such as limits.
    pub marks: Vec<f64>,
    /// Label of the marks in the legend; empty without one.
    pub mark_label: String,
    /// Spans of the horizontal axis that are shaded, such as eclipses.
    pub shades: Vec<(f64, f64)>,
    /// Label of the shades in the legend; empty without one.
    pub shade_label: String,
    /// Whether only whole numbers are ticks.
    pub is_whole: bool,
    /// Values with their names, which stand beside the vertical axis in place of numbers; empty: numbers.
    pub names: Vec<(f64, String)>,
}

impl Panel {
    /// An empty panel.
    pub fn new(y_label: impl Into<String>) -> Self {
        Self { y_label: y_label.into(), ..Self::default() }
    }

    /// With these lines.
    #[must_use]
    pub fn with(self, series: impl IntoIterator<Item = Series>) -> Self {
        Self { series: series.into_iter().collect(), ..self }
    }

    /// Over a vertical range.
    #[must_use]
    pub fn range(self, low: f64, high: f64) -> Self {
        Self { y_range: Some((low, high)), ..self }
    }

    /// With marked values, and what the legend says of them.
    #[must_use]
    pub fn marks(self, mark_label: impl Into<String>, marks: Vec<f64>) -> Self {
        Self { mark_label: mark_label.into(), marks, ..self }
    }

    /// With whole numbers as ticks only.
    #[must_use]
    pub fn whole(self) -> Self {
        Self { is_whole: true, ..self }
    }
}

/// The pieces between points that are not finite.
pub(super) fn pieces(points: &[(f64, f64)]) -> impl Iterator<Item = &[(f64, f64)]> {
    points.split(|(x, y)| !is_drawable(*x) || !is_drawable(*y)).filter(|piece| !piece.is_empty())
}

//! What a chart shows: series in panels.

/// How a series is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Mark {
    /// Straight lines from point to point.
    #[default]
    Line,
    /// Dots.
    Dots,
    /// Rings, in which the dots of another series can sit.
    Rings,
    /// A dashed line, as for a limit.
    Dashed,
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
}

impl Series {
    /// A line through `points`.
    pub fn line(label: impl Into<String>, points: Vec<(f64, f64)>) -> Self {
        Self { label: label.into(), points, mark: Mark::Line }
    }

    /// Dots at `points`.
    pub fn dots(label: impl Into<String>, points: Vec<(f64, f64)>) -> Self {
        Self { label: label.into(), points, mark: Mark::Dots }
    }

    /// Rings about `points`.
    pub fn rings(label: impl Into<String>, points: Vec<(f64, f64)>) -> Self {
        Self { label: label.into(), points, mark: Mark::Rings }
    }

    /// A dashed line through `points`.
    pub fn dashed(label: impl Into<String>, points: Vec<(f64, f64)>) -> Self {
        Self { label: label.into(), points, mark: Mark::Dashed }
    }
}

/// One of a chart's stacked panels.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Panel {
    /// Label of the vertical axis, with its unit in brackets.
    pub y_label: String,
    /// The lines.
    pub series: Vec<Series>,
    /// Vertical range; otherwise that of the data with a margin.
    pub y_range: Option<(f64, f64)>,
    /// Values marked by a dashed horizontal line, such as limits.
    pub marks: Vec<f64>,
}

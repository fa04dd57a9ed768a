//! Grouped bars: stacked panels over the same named cases, each bar from zero.

use super::{
    axes::{is_drawable, round_up},
    frame::{Axes, Frame},
    legend::Legend,
    pen::{COLOURS, Pen, TEXT},
    picture::{LABEL, PANEL_HEIGHT, PLOT_LEFT, Picture, RIGHT, TITLE_HEIGHT, WIDTH, X_AXIS_HEIGHT},
};

/// Part of a case's width that its bars take.
const FILLED: f64 = 0.72;

/// A chart: panels over the same cases.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct BarChart {
    /// Title.
    pub title: String,
    /// Names of the cases, left to right.
    pub cases: Vec<String>,
    /// Names of the bars of each case, left to right.
    pub bars: Vec<String>,
    /// The panels, top to bottom.
    pub panels: Vec<BarPanel>,
}

/// One panel.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct BarPanel {
    /// Label of the vertical axis, with its unit in brackets.
    pub y_label: String,
    /// Values of each bar, case by case; one that is not finite is left out.
    pub values: Vec<Vec<f64>>,
}

impl Picture for BarChart {
    fn title(&self) -> &str {
        &self.title
    }

    fn height(&self) -> Option<f64> {
        let panels = self.panels.len() as f64 * PANEL_HEIGHT;
        let height = TITLE_HEIGHT + Legend::of_names(&self.bars).height() + panels + X_AXIS_HEIGHT;
        (!self.cases.is_empty() && !self.panels.is_empty()).then_some(height)
    }

    fn draw(&self, pen: &mut Pen, top: f64) {
        let legend = Legend::of_names(&self.bars);
        legend.draw(pen, top + TITLE_HEIGHT);
        let mut below = top + TITLE_HEIGHT + legend.height() + 8.0;
        for panel in &self.panels {
            let (y, cases) = (panel.range(), self.cases.len() as f64);
            let (width, height) = (WIDTH - PLOT_LEFT - RIGHT, PANEL_HEIGHT - 16.0);
            let frame = Frame { left: PLOT_LEFT, top: below, width, height, x: [-0.5, cases - 0.5], y };
            let steps = [0.0, round_up((y[1] - y[0]) / 5.0)];
            let labels = ["", panel.y_label.as_str()];
            let axes = Axes { labels, steps, label_px: LABEL, ..Axes::default() };
            frame.grid(pen, &axes);
            frame.axes(pen, &axes);
            let width = FILLED / panel.values.len().max(1) as f64;
            for (bar, values) in panel.values.iter().enumerate() {
                let fill = format!("fill=\"{}\"", COLOURS[bar % COLOURS.len()]);
                for (case, value) in values.iter().enumerate().filter(|(_, value)| is_drawable(**value)) {
                    let from = case as f64 - 0.5 * FILLED + bar as f64 * width;
                    let (upper, lower) = (value.max(0.0), value.min(0.0));
                    pen.rect(frame.at([from, upper]), frame.at([from + 0.92 * width, lower]), &fill);
                }
            }
            frame.line(pen, &frame.x.map(|x| [x, 0.0]), "stroke=\"#9aa2ac\"");
            below += PANEL_HEIGHT;
        }
        let share = (WIDTH - PLOT_LEFT - RIGHT) / self.cases.len() as f64;
        for (case, name) in self.cases.iter().enumerate() {
            let at = (PLOT_LEFT + share * (case as f64 + 0.5), below + 8.0);
            pen.text(at, 12.0, "middle", TEXT, name);
        }
    }
}

impl BarPanel {
    /// From zero, with room at the end.
    fn range(&self) -> [f64; 2] {
        let finite = || self.values.iter().flatten().copied().filter(|value| is_drawable(*value));
        let (low, high) = (finite().fold(0.0, f64::min), finite().fold(0.0, f64::max));
        let margin = 0.08 * (high - low).max(f64::MIN_POSITIVE);
        if low == high {
            return [0.0, 1.0];
        }
        [if low < 0.0 { low - margin } else { 0.0 }, if high > 0.0 { high + margin } else { 0.0 }]
    }
}

#[cfg(test)]
mod tests {
    //! Bars begin at zero, and every case is named.

    use super::*;

    #[test]
    fn bars_begin_at_zero() {
        let range =
            |values: &[f64]| BarPanel { values: vec![values.to_vec()], ..BarPanel::default() }.range();
        assert_eq!(range(&[3.0, 5.0])[0], 0.0);
        assert!(range(&[3.0, 5.0])[1] > 5.0);
        assert_eq!(range(&[-3.0, -5.0])[1], 0.0);
        assert!(range(&[-3.0, 5.0])[0] < -3.0);
        assert_eq!(range(&[f64::NAN, 0.0]), [0.0, 1.0]);
    }

    #[test]
    fn every_case_is_named_and_every_value_a_bar() {
        let chart = BarChart {
            title: "greatest".to_owned(),
            cases: vec!["summer".to_owned(), "winter".to_owned()],
            bars: vec!["paper".to_owned(), "ours".to_owned()],
            panels: vec![BarPanel {
                y_label: "force [N]".to_owned(),
                values: vec![vec![1.0, 2.0], vec![f64::NAN, 2.5]],
            }],
        };
        let svg = crate::svg(&[&chart]).unwrap();
        for text in ["greatest", "summer", "winter", "paper", "ours", "force [N]"] {
            assert!(svg.contains(text), "{text}");
        }
        // White ground, three bars, the frame.
        assert_eq!(svg.matches("<rect").count(), 5, "{svg}");
        assert!(crate::svg(&[&BarChart::default()]).is_err());
    }
}

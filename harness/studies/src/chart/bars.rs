//! Grouped bars as SVG: stacked panels over the same named cases, each bar from zero.

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::style::*;
use super::{ChartError, Panel, Series, finished, legend, tick_step, tick_text};

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

impl BarChart {
    /// The picture as SVG text.
    pub fn to_svg(&self) -> Result<String, ChartError> {
        if self.cases.is_empty() || self.panels.is_empty() {
            return Err(ChartError::Empty(self.title.clone()));
        }
        let mut svg = String::new();
        finished(&self.title, self.draw(&mut svg), svg, self.height())
    }

    fn top(&self) -> u32 {
        TITLE_HEIGHT + legend::height(&self.legend())
    }

    fn height(&self) -> u32 {
        self.top() + u32::try_from(self.panels.len()).unwrap_or(1) * PANEL_HEIGHT + X_AXIS_HEIGHT
    }

    fn legend(&self) -> Panel {
        let series = self.bars.iter().map(|label| Series::line(label.as_str(), Vec::new())).collect();
        Panel { series, ..Panel::default() }
    }

    fn draw(&self, svg: &mut String) -> Drawn {
        let root = SVGBackend::with_string(svg, (WIDTH, self.height())).into_drawing_area();
        root.fill(&WHITE)?;
        let style = (FONT, 20 * FINE).into_font().style(FontStyle::Bold).color(&INK);
        let style = style.pos(Pos::new(HPos::Left, VPos::Center));
        root.draw_text(&self.title, &style, (pixel(LEFT + Y_AXIS_WIDTH), pixel(TITLE_HEIGHT / 2)))?;
        let legend = self.legend();
        legend::draw(&root.clone().shrink((0, TITLE_HEIGHT), (WIDTH, legend::height(&legend))), &legend)?;
        let mut top = self.top();
        for (index, panel) in self.panels.iter().enumerate() {
            let last = index + 1 == self.panels.len();
            let height = PANEL_HEIGHT + if last { X_AXIS_HEIGHT } else { 0 };
            self.draw_panel(&root.clone().shrink((0, top), (WIDTH, height)), panel, last)?;
            top += PANEL_HEIGHT;
        }
        root.present()?;
        Ok(())
    }

    fn draw_panel(&self, area: &Area<'_>, panel: &BarPanel, last: bool) -> Drawn {
        let cases = self.cases.len() as f64;
        let y_range = panel.range();
        let mut chart = ChartBuilder::on(area)
            .margin_top(8 * FINE)
            .margin_bottom(if last { BOTTOM } else { 8 * FINE })
            .margin_left(LEFT)
            .margin_right(RIGHT)
            .x_label_area_size(if last { X_AXIS_HEIGHT - BOTTOM } else { 0 })
            .y_label_area_size(Y_AXIS_WIDTH)
            .build_cartesian_2d(-0.5..cases - 0.5, y_range.0..y_range.1)?;
        let step = tick_step(y_range, 5);
        let format = |value: &f64| tick_text(*value, step);
        let label_style = (FONT, 13 * FINE).into_font().color(&QUIET);
        chart
            .configure_mesh()
            .set_all_tick_mark_size(pixel(5 * FINE))
            .disable_x_mesh()
            .disable_x_axis()
            .light_line_style(TRANSPARENT)
            .bold_line_style(GRID.stroke_width(FINE))
            .axis_style(FRAME.stroke_width(FINE))
            .y_labels(5)
            .y_label_formatter(&format)
            .y_label_style(label_style)
            .axis_desc_style((FONT, 14 * FINE).into_font().color(&INK))
            .y_desc(panel.y_label.as_str())
            .draw()?;
        let width = FILLED / panel.values.len().max(1) as f64;
        for (bar, values) in panel.values.iter().enumerate() {
            let colour = COLOURS[bar % COLOURS.len()];
            let bars =
                values.iter().enumerate().filter(|(_, value)| value.is_finite()).map(|(case, value)| {
                    let from = case as f64 - 0.5 * FILLED + bar as f64 * width;
                    Rectangle::new([(from, 0.0), (from + 0.92 * width, *value)], colour.filled())
                });
            chart.draw_series(bars)?;
        }
        let zero = [(-0.5, 0.0), (cases - 0.5, 0.0)];
        chart.draw_series(LineSeries::new(zero, FRAME.stroke_width(FINE)))?;
        if last {
            let style = (FONT, 14 * FINE).into_font().color(&INK).pos(Pos::new(HPos::Center, VPos::Top));
            for (case, name) in self.cases.iter().enumerate() {
                let (x, y) = chart.backend_coord(&(case as f64, y_range.0));
                let (left, top) = area.get_base_pixel();
                area.draw_text(name, &style, (x - left, y - top + 8 * pixel(FINE)))?;
            }
        }
        Ok(())
    }
}

impl BarPanel {
    /// From zero, with room at the end.
    fn range(&self) -> (f64, f64) {
        let finite = || self.values.iter().flatten().copied().filter(|value| value.is_finite());
        let (low, high) = (finite().fold(0.0, f64::min), finite().fold(0.0, f64::max));
        let margin = 0.08 * (high - low).max(f64::MIN_POSITIVE);
        if low == high {
            return (0.0, 1.0);
        }
        (if low < 0.0 { low - margin } else { 0.0 }, if high > 0.0 { high + margin } else { 0.0 })
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
        assert_eq!(range(&[3.0, 5.0]).0, 0.0);
        assert!(range(&[3.0, 5.0]).1 > 5.0);
        assert_eq!(range(&[-3.0, -5.0]).1, 0.0);
        assert!(range(&[-3.0, 5.0]).0 < -3.0);
        assert_eq!(range(&[f64::NAN, 0.0]), (0.0, 1.0));
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
        let svg = chart.to_svg().unwrap();
        for text in ["greatest", "summer", "winter", "paper", "ours", "force [N]"] {
            assert!(svg.contains(text), "{text}");
        }
        // White ground and three bars.
        assert_eq!(svg.matches("<rect").count(), 4, "{svg}");
        assert!(BarChart::default().to_svg().is_err());
    }
}

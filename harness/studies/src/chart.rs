//! Line charts as SVG: stacked panels over one horizontal axis, each with its own unit and legend.
//!
//! Used by `heliotorque run --plot` and by the studies. The text is SVG text, so no font is needed to draw it.

pub mod bars;
mod envelope;
mod legend;
pub mod plane;
mod series;
mod style;
#[cfg(test)]
mod tests;

use plotters::{
    coord::types::RangedCoordf64,
    prelude::*,
    style::text_anchor::{HPos, Pos, VPos},
};

pub use series::{Mark, Panel, Series};
pub use style::COLOURS;
use style::*;

/// A chart: panels over one horizontal axis.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Chart {
    /// Title; empty for none.
    pub title: String,
    /// Label of the horizontal axis, with its unit in brackets.
    pub x_label: String,
    /// The panels, top to bottom.
    pub panels: Vec<Panel>,
    /// What the lines of the same place in all panels without labels are, beside the title.
    pub legend: Vec<String>,
}

/// A chart that cannot be drawn.
#[derive(Debug, thiserror::Error)]
pub enum ChartError {
    /// There is nothing to draw.
    #[error("the chart {0:?} has no finite point to draw")]
    Empty(String),
    /// The drawing library refuses.
    #[error("the chart {title:?} cannot be drawn: {reason}")]
    Drawing {
        /// The chart's title.
        title: String,
        /// What the library reports.
        reason: String,
    },
}

impl Chart {
    /// The chart as SVG text.
    pub fn to_svg(&self) -> Result<String, ChartError> {
        let range = self.x_range().ok_or_else(|| ChartError::Empty(self.title.clone()))?;
        let mut svg = String::new();
        let drawn = self.draw(&mut svg, range);
        finished(&self.title, drawn, svg, self.height())
    }

    /// Horizontal range of the finite points of all panels.
    fn x_range(&self) -> Option<(f64, f64)> {
        let points = self.panels.iter().flat_map(|panel| &panel.series).flat_map(|series| &series.points);
        let finite = points.filter(|(x, y)| x.is_finite() && y.is_finite()).map(|(x, _)| *x);
        let (low, high) = extremes(finite)?;
        Some(if low < high { (low, high) } else { padded(low, high) })
    }

    fn title_height(&self) -> u32 {
        if self.title.is_empty() && self.legend.is_empty() { TOP } else { TITLE_HEIGHT }
    }

    /// Of the lines of a panel with one row of legend.
    fn panel_height(&self) -> u32 {
        if self.panels.len() == 1 { SINGLE_HEIGHT } else { PANEL_HEIGHT }
    }

    fn height(&self) -> u32 {
        let panels: u32 = self.panels.iter().map(|panel| panel.height(self.panel_height())).sum();
        self.title_height() + panels + X_AXIS_HEIGHT
    }

    fn draw(&self, svg: &mut String, x_range: (f64, f64)) -> Drawn {
        let (title_height, panel_height) = (self.title_height(), self.panel_height());
        let root = SVGBackend::with_string(svg, (WIDTH, self.height())).into_drawing_area();
        root.fill(&WHITE)?;
        if !self.title.is_empty() {
            let style = (FONT, 20 * FINE).into_font().style(FontStyle::Bold).color(&INK);
            let style = style.pos(Pos::new(HPos::Left, VPos::Center));
            root.draw_text(&self.title, &style, (pixel(LEFT + Y_AXIS_WIDTH), pixel(title_height / 2)))?;
        }
        let shared = self.legend.iter().map(|label| Series::line(label.as_str(), Vec::new()));
        let row = root
            .clone()
            .shrink((0, title_height.saturating_sub(legend::ROW_HEIGHT)), (WIDTH, legend::ROW_HEIGHT));
        legend::draw(&row, &Panel { series: shared.collect(), ..Panel::default() })?;
        let mut top = title_height;
        for (index, panel) in self.panels.iter().enumerate() {
            let last = index + 1 == self.panels.len();
            let height = panel.height(panel_height) + if last { X_AXIS_HEIGHT } else { 0 };
            let area = root.clone().shrink((0, top), (WIDTH, height));
            self.draw_panel(&area, panel, x_range, last)?;
            top += height;
        }
        root.present()?;
        Ok(())
    }

    fn draw_panel(&self, area: &Area<'_>, panel: &Panel, x_range: (f64, f64), last: bool) -> Drawn {
        let y_range = panel.y_range.unwrap_or_else(|| panel.data_range());
        let axis_height = if last { X_AXIS_HEIGHT - BOTTOM } else { 0 };
        let mut chart = ChartBuilder::on(area)
            .margin_top(panel.top())
            .margin_bottom(if last { BOTTOM } else { 8 * FINE })
            .margin_left(LEFT)
            .margin_right(RIGHT)
            .x_label_area_size(axis_height)
            .y_label_area_size(Y_AXIS_WIDTH)
            .build_cartesian_2d(x_range.0..x_range.1, y_range.0..y_range.1)?;
        let y_ticks = panel.ticks(y_range, if self.panels.len() == 1 { 8 } else { 5 });
        let x_step = tick_step(x_range, 10);
        let y_step = tick_step(y_range, y_ticks);
        let (x_format, y_format) = (|x: &f64| tick_text(*x, x_step), |y: &f64| panel.tick_text(*y, y_step));
        let label_style = (FONT, 13 * FINE).into_font().color(&QUIET);
        for (from, to) in &panel.shades {
            let corners = [(from.max(x_range.0), y_range.0), (to.min(x_range.1), y_range.1)];
            chart.draw_series([Rectangle::new(corners, SHADE.filled())])?;
        }
        let mut mesh = chart.configure_mesh();
        mesh.set_all_tick_mark_size(pixel(5 * FINE))
            .light_line_style(TRANSPARENT)
            .bold_line_style(GRID.stroke_width(FINE))
            .axis_style(FRAME.stroke_width(FINE))
            .x_labels(10)
            .y_labels(y_ticks)
            .x_label_formatter(&x_format)
            .y_label_formatter(&y_format)
            .x_label_style(label_style.clone())
            .y_label_style(label_style)
            .axis_desc_style((FONT, 14 * FINE).into_font().color(&INK))
            .y_desc(panel.y_label.as_str());
        if last {
            mesh.x_desc(self.x_label.as_str());
        }
        mesh.draw()?;
        for mark in &panel.marks {
            let ends = [(x_range.0, *mark), (x_range.1, *mark)];
            chart.draw_series(DashedLineSeries::new(ends, 6 * FINE, 5 * FINE, QUIET.stroke_width(FINE)))?;
        }
        let columns = 2 * (WIDTH - LEFT - Y_AXIS_WIDTH - RIGHT) / FINE;
        for (index, series) in panel.series.iter().enumerate() {
            draw_series(&mut chart, index, series, |points| thinned(points, x_range, columns))?;
        }
        legend::draw(area, panel)
    }
}

impl Panel {
    /// Height above the lines: the legend's rows, or a margin.
    fn top(&self) -> u32 {
        legend::height(self).max(8 * FINE)
    }

    /// The panel's whole height with lines `height` high.
    fn height(&self, height: u32) -> u32 {
        // The first row of the legend counts as part of every panel, so that panels are alike.
        height + self.top().saturating_sub(legend::ROW_HEIGHT)
    }

    /// How many ticks to ask for, so that their distance is one at least where only whole numbers are.
    fn ticks(&self, (low, high): (f64, f64), ticks: usize) -> usize {
        if self.is_whole { ticks.min((high - low) as usize + 1) } else { ticks }
    }

    /// A tick's text; none between whole numbers where only these are.
    fn tick_text(&self, value: f64, step: f64) -> String {
        let is_between = self.is_whole && (value - value.round()).abs() > 1e-6;
        if is_between { String::new() } else { tick_text(value, step) }
    }

    fn data_range(&self) -> (f64, f64) {
        let data = self.series.iter().flat_map(|series| series.points.iter().map(|(_, y)| *y));
        match extremes(data.chain(self.marks.iter().copied()).filter(|y| y.is_finite())) {
            Some((low, high)) => padded(low, high),
            None => (0.0, 1.0),
        }
    }
}

/// Whether a text begins as the charts do that are drawn here.
pub fn is_chart(text: &str) -> bool {
    text.starts_with(&format!("<svg width=\"{}\" height=", WIDTH / FINE))
        && text.lines().next().is_some_and(|line| line.contains(&format!("viewBox=\"0 0 {WIDTH} ")))
}

/// The SVG text of a picture `height` high, shown at its size in pixels.
fn finished(title: &str, drawn: Drawn, svg: String, height: u32) -> Result<String, ChartError> {
    let cannot = |reason: String| ChartError::Drawing { title: title.to_owned(), reason };
    drawn.map_err(|error| cannot(error.to_string()))?;
    let fine = format!("<svg width=\"{WIDTH}\" height=\"{height}\" ");
    let Some(rest) = svg.strip_prefix(&fine) else {
        return Err(cannot(format!("its picture does not begin with {fine}")));
    };
    // The view box keeps the fine units.
    Ok(format!("<svg width=\"{}\" height=\"{}\" {rest}", WIDTH / FINE, height / FINE))
}

type Plot<'a> = ChartContext<'a, SVGBackend<'a>, Cartesian2d<RangedCoordf64, RangedCoordf64>>;

/// Draws a series in the colour of its place; `thin` leaves the points of a piece that are drawn.
fn draw_series(
    chart: &mut Plot<'_>,
    index: usize,
    series: &Series,
    thin: impl Fn(&[(f64, f64)]) -> Vec<(f64, f64)>,
) -> Drawn {
    let colour = COLOURS[index % COLOURS.len()];
    let finite = || series.points.iter().filter(|(x, y)| x.is_finite() && y.is_finite());
    match series.mark {
        Mark::Line | Mark::Curve => {
            for piece in pieces(&series.points) {
                let band = if series.mark == Mark::Line { envelope::of(piece) } else { None };
                match band {
                    Some(band) => {
                        chart.draw_series([Polygon::new(band.outline(), colour.mix(0.25))])?;
                        for edge in [band.lowest, band.greatest] {
                            chart.draw_series(LineSeries::new(edge, colour.stroke_width(FINE)))?;
                        }
                    }
                    None => {
                        chart.draw_series(LineSeries::new(thin(piece), colour.stroke_width(2 * FINE)))?;
                    }
                }
            }
        }
        Mark::Steps => {
            for piece in pieces(&series.corners()) {
                chart.draw_series(LineSeries::new(piece.iter().copied(), colour.stroke_width(2 * FINE)))?;
            }
        }
        Mark::Dots => {
            chart.draw_series(finite().map(|point| Circle::new(*point, 3 * FINE, colour.filled())))?;
        }
        Mark::Rings => {
            let ring = colour.stroke_width(FINE);
            chart.draw_series(finite().map(|point| Circle::new(*point, 5 * FINE, ring)))?;
        }
        Mark::Dashed => {
            for piece in pieces(&series.points) {
                let pen = colour.stroke_width(2 * FINE);
                chart.draw_series(DashedLineSeries::new(thin(piece), 6 * FINE, 5 * FINE, pen))?;
            }
        }
    }
    Ok(())
}

fn extremes(values: impl Iterator<Item = f64>) -> Option<(f64, f64)> {
    values.fold(None, |range: Option<(f64, f64)>, value| {
        Some(range.map_or((value, value), |(low, high)| (low.min(value), high.max(value))))
    })
}

/// The range with a margin; a single value gets a margin of its own size.
fn padded(low: f64, high: f64) -> (f64, f64) {
    let span = high - low;
    let magnitude = low.abs().max(high.abs());
    // Differences too small for the axis to write are drawn as a flat line.
    let margin = match span > 1e-5 * magnitude {
        true => 0.06 * span,
        // Nothing but zero has no size of its own.
        false if magnitude < f64::MIN_POSITIVE => 1.0,
        false => 0.1 * magnitude,
    };
    (low - margin, high + margin)
}

/// The pieces between points that are not finite.
fn pieces(points: &[(f64, f64)]) -> impl Iterator<Item = &[(f64, f64)]> {
    points.split(|(x, y)| !x.is_finite() || !y.is_finite()).filter(|piece| !piece.is_empty())
}

/// At most four points a column: first, lowest, highest, last, so that nothing visible is lost.
fn thinned(points: &[(f64, f64)], x_range: (f64, f64), columns: u32) -> Vec<(f64, f64)> {
    if points.len() <= 4 * columns as usize {
        return points.to_vec();
    }
    let column = |x: f64| ((x - x_range.0) / (x_range.1 - x_range.0) * f64::from(columns)).floor();
    let mut kept: Vec<(f64, f64)> = Vec::new();
    for group in points.chunk_by(|a, b| column(a.0) == column(b.0)) {
        let mut indices = [0, 0, 0, group.len() - 1];
        for (index, point) in group.iter().enumerate() {
            if point.1 < group[indices[1]].1 {
                indices[1] = index;
            }
            if point.1 > group[indices[2]].1 {
                indices[2] = index;
            }
        }
        indices.sort_unstable();
        for (position, &index) in indices.iter().enumerate() {
            if position == 0 || indices[position - 1] != index {
                kept.push(group[index]);
            }
        }
    }
    kept
}

/// A step of 1, 2 or 5 times a power of ten that gives about `ticks` ticks.
fn tick_step(range: (f64, f64), ticks: usize) -> f64 {
    let rough = (range.1 - range.0) / ticks as f64;
    let power = 10f64.powf(rough.log10().floor());
    let step = [1.0, 2.0, 5.0, 10.0].into_iter().find(|factor| factor * power >= rough * 0.999);
    step.unwrap_or(10.0) * power
}

/// A tick with as many digits as its step needs.
fn tick_text(value: f64, step: f64) -> String {
    // A tick within rounding of zero is zero.
    let value = if value.abs() < step * 1e-6 { 0.0 } else { value };
    let magnitude = value.abs().max(step);
    if (1e-3..1e6).contains(&magnitude) && step >= 1e-5 {
        let digits = (-step.log10().floor()).clamp(0.0, 6.0);
        return format!("{value:.*}", digits as usize);
    }
    if value == 0.0 {
        return "0".to_owned();
    }
    let digits = (magnitude.log10().floor() - step.log10().floor()).clamp(0.0, 6.0);
    format!("{value:.*e}", digits as usize)
}

//! Charts of lines, dots and bars: stacked panels over one horizontal axis, each with its own unit and legend.

use std::collections::BTreeSet;

use super::{
    axes::{is_drawable, round_up},
    envelope::{self, Envelope},
    frame::{Axes, Frame},
    legend::{Legend, ROW_HEIGHT},
    pen::{COLOURS, GREY, Pen, Pixel},
    picture::{LABEL, PANEL_HEIGHT, PLOT_LEFT, Picture, RIGHT, SHADE, TITLE_HEIGHT, WIDTH, X_AXIS_HEIGHT},
    series::{BAND_OPACITY, Mark, Panel, Series, pieces},
};

const SINGLE_HEIGHT: f64 = 420.0;
/// Above a chart without title, and above and below the lines of a panel.
const TOP: f64 = 14.0;
const MARGIN: f64 = 8.0;
const PLOT_WIDTH: f64 = WIDTH - PLOT_LEFT - RIGHT;
/// Number of columns, half a pixel wide; a line keeps its visible points in each.
const COLUMNS: f64 = 2.0 * PLOT_WIDTH;

/// Dots from which on those that others hide are left out, and their distance in px.
const MANY_DOTS: usize = 2000;
const HIDDEN_PX: f64 = 1.5;

/// A chart: panels over one horizontal axis.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Chart {
    /// Title; empty for none.
    pub title: String,
    /// Label of the horizontal axis, with its unit in brackets.
    pub x_label: String,
    /// The panels, top to bottom.
    pub panels: Vec<Panel>,
    /// Labels of the lines by their position, for all panels without labels of their own; drawn at the title.
    pub legend: Vec<String>,
    /// Places of the horizontal axis with their names, such as dates, in place of numbers; empty: numbers.
    pub x_names: Vec<(f64, String)>,
}

impl Chart {
    /// A chart without panels.
    pub fn new(title: impl Into<String>, x_label: impl Into<String>) -> Self {
        Self { title: title.into(), x_label: x_label.into(), ..Self::default() }
    }

    /// With these panels, top to bottom.
    #[must_use]
    pub fn with(self, panels: impl IntoIterator<Item = Panel>) -> Self {
        Self { panels: panels.into_iter().collect(), ..self }
    }

    /// Horizontal range of the finite points of all panels.
    fn x_range(&self) -> Option<[f64; 2]> {
        let points = self.panels.iter().flat_map(|panel| &panel.series).flat_map(|series| &series.points);
        let finite = points.filter(|(x, y)| is_drawable(*x) && is_drawable(*y)).map(|(x, _)| *x);
        let [low, high] = extremes(finite)?;
        Some(if low < high { [low, high] } else { padded(low, high) })
    }

    /// The axes of a panel with the vertical label beside its ticks, and its vertical range.
    fn axes(&self, index: usize, x: [f64; 2]) -> (Axes<'_>, [f64; 2]) {
        let panel = &self.panels[index];
        let y = panel.y_range.map_or_else(|| panel.data_range(), |(low, high)| [low, high]);
        let y_ticks = panel.ticks(y, if self.panels.len() == 1 { 8.0 } else { 5.0 });
        let is_last = index + 1 == self.panels.len();
        let axes = Axes {
            labels: [if is_last { &self.x_label } else { "" }, &panel.y_label],
            steps: [round_up((x[1] - x[0]) / 10.0), round_up((y[1] - y[0]) / y_ticks)],
            label_px: LABEL,
            is_whole: panel.is_whole,
            named: [&self.x_names, &panel.names],
        };
        (axes.beside(y), y)
    }

    fn title_height(&self) -> f64 {
        if self.title.is_empty() && self.legend.is_empty() { TOP } else { TITLE_HEIGHT }
    }

    /// The legend of each panel; the first with a band says what that is.
    fn legends(&self) -> Vec<Legend<'_>> {
        let with_band = self.panels.iter().position(|panel| panel.series.iter().any(Series::has_band));
        let panels = self.panels.iter().enumerate();
        panels.map(|(index, panel)| Legend::new(panel, with_band == Some(index))).collect()
    }

    /// Height of the lines of a panel with one row of legend.
    fn panel_height(&self) -> f64 {
        if self.panels.len() == 1 { SINGLE_HEIGHT } else { PANEL_HEIGHT }
    }
}

impl Picture for Chart {
    fn title(&self) -> &str {
        &self.title
    }

    fn height(&self) -> Option<f64> {
        self.x_range()?;
        let panels: f64 = self.legends().iter().map(|legend| height(legend, self.panel_height())).sum();
        Some(self.title_height() + panels + X_AXIS_HEIGHT)
    }

    fn draw(&self, pen: &mut Pen, top: f64) {
        let Some(x) = self.x_range() else { return };
        let mut below = top + self.title_height();
        let axes: Vec<(Axes<'_>, [f64; 2])> =
            (0..self.panels.len()).map(|index| self.axes(index, x)).collect();
        // One below the other, whatever their ticks are.
        let label_px = axes.iter().map(|(axes, _)| axes.label_px).fold(0.0, f64::max);
        Legend::of_names(&self.legend).draw(pen, below - ROW_HEIGHT);
        for (index, ((panel, legend), (axes, y))) in
            self.panels.iter().zip(self.legends()).zip(axes).enumerate()
        {
            let is_last = index + 1 == self.panels.len();
            let height = height(&legend, self.panel_height());
            let (left, top) = (PLOT_LEFT, below + above(&legend));
            let plot = height - above(&legend) - if is_last { 0.0 } else { MARGIN };
            let frame = Frame { left, top, width: PLOT_WIDTH, height: plot, x, y };
            panel.draw(pen, &frame, &Axes { label_px, ..axes });
            legend.draw(pen, below);
            below += height;
        }
    }
}

/// Height above the lines of a panel: the legend's rows, or a margin.
fn above(legend: &Legend<'_>) -> f64 {
    legend.height().max(MARGIN)
}

/// A panel's whole height with lines `lines_px` high.
fn height(legend: &Legend<'_>, lines_px: f64) -> f64 {
    // The first row of the legend counts as part of every panel, so that panels are alike.
    lines_px + (above(legend) - ROW_HEIGHT).max(0.0)
}

impl Panel {
    /// How many ticks to ask for, so that their distance is one at least where only whole numbers are.
    fn ticks(&self, [low, high]: [f64; 2], ticks: f64) -> f64 {
        if self.is_whole { ticks.min((high - low).floor() + 1.0) } else { ticks }
    }

    fn data_range(&self) -> [f64; 2] {
        let bands = self.series.iter().flat_map(|series| &series.bands);
        let edges = bands.flat_map(|band| band.range.lowest.iter().chain(&band.range.greatest));
        let points = self.series.iter().flat_map(|series| &series.points);
        let data = points.chain(edges).map(|(_, y)| *y);
        let finite = data.chain(self.marks.iter().copied()).filter(|y| is_drawable(*y));
        extremes(finite).map_or([0.0, 1.0], |[low, high]| padded(low, high))
    }

    fn draw(&self, pen: &mut Pen, frame: &Frame, axes: &Axes<'_>) {
        let ([low, high], [_, bottom]) = (frame.corners(), frame.y);
        pen.within(low, high, |pen| {
            for (from, to) in &self.shades {
                pen.rect((frame.at([*from, bottom]).0, low.1), (frame.at([*to, bottom]).0, high.1), SHADE);
            }
        });
        frame.grid(pen, axes);
        for mark in &self.marks {
            let dashes = format!("stroke=\"{GREY}\" stroke-dasharray=\"6 5\"");
            pen.within(low, high, |pen| frame.line(pen, &frame.x.map(|x| [x, *mark]), &dashes));
        }
        frame.axes(pen, axes);
        for (index, series) in self.series.iter().enumerate() {
            draw_series(pen, frame, index, series, |points| thinned(points, frame.x));
        }
    }
}

/// Draws a series in the colour of its place; `thin` leaves the points of a piece that are drawn.
pub(super) fn draw_series(
    pen: &mut Pen,
    frame: &Frame,
    index: usize,
    series: &Series,
    thin: impl Fn(&[(f64, f64)]) -> Vec<(f64, f64)>,
) {
    let colour = COLOURS[index % COLOURS.len()];
    let stroke = |width: u32| format!("stroke=\"{colour}\" stroke-width=\"{width}\"");
    let filled = |opacity: f64| format!("fill=\"{colour}\" fill-opacity=\"{opacity}\"");
    let place = |points: Vec<(f64, f64)>| -> Vec<Pixel> {
        points.into_iter().map(|(x, y)| frame.at([x, y])).collect()
    };
    let dots = || series.points.iter().map(|(x, y)| [*x, *y]).filter(|point| frame.holds(*point));
    let [low, high] = frame.corners();
    if !series.bands.is_empty() {
        pen.within(low, high, |pen| {
            let pieces = series.bands.iter().flat_map(|band| band.range.pieces());
            pieces.for_each(|piece| {
                let edges = Envelope { lowest: thin(&piece.lowest), greatest: thin(&piece.greatest) };
                pen.polygon(&place(edges.outline()), &filled(BAND_OPACITY));
            });
        });
    }
    match series.mark {
        Mark::Dots => {
            let fill = format!("fill=\"{colour}\"");
            let places: Vec<Pixel> = dots().map(|at| frame.at(at)).collect();
            distinct(places).into_iter().for_each(|at| pen.circle(at, 3.0, &fill));
        }
        Mark::Bars => pen.within(low, high, |pen| {
            let bars = series.points.windows(2).filter(|pair| pair[0].1 != 0.0 && is_drawable(pair[0].1));
            bars.for_each(|pair| {
                let ((from, value), to) = (pair[0], pair[1].0);
                let corners = [[from, value.max(0.0)], [to, value.min(0.0)]].map(|corner| frame.at(corner));
                let edged = format!("fill=\"{colour}\" stroke=\"#ffffff\" stroke-width=\"0.6\"");
                pen.rect(corners[0], corners[1], &edged);
            });
        }),
        Mark::Rings => dots().for_each(|at| {
            pen.circle(frame.at(at), 5.0, &format!("fill=\"none\" stroke=\"{colour}\""));
        }),
        mark => pen.within(low, high, |pen| {
            let corners = if mark == Mark::Steps { series.corners() } else { Vec::new() };
            let points = if mark == Mark::Steps { &corners } else { &series.points };
            let (mut lines, mut edges) = (Vec::new(), Vec::new());
            for piece in pieces(points) {
                match envelope::envelope(piece).filter(|_| mark == Mark::Line) {
                    Some(band) => {
                        pen.polygon(&place(band.outline()), &filled(0.25));
                        edges.extend([band.lowest, band.greatest].map(place));
                        lines.push(place(envelope::mean(piece)));
                    }
                    None if mark == Mark::Steps => lines.push(place(piece.to_vec())),
                    None => lines.push(place(thin(piece))),
                }
            }
            let dashes = if mark == Mark::Dashed { " stroke-dasharray=\"6 5\"" } else { "" };
            pen.lines(edges, &stroke(1));
            let round = format!("{} stroke-linejoin=\"round\"{dashes}", stroke(2));
            pen.lines(lines, &round);
        }),
    }
}

/// Dots without those that others hide, where there are many.
fn distinct(dots: Vec<Pixel>) -> Vec<Pixel> {
    if dots.len() <= MANY_DOTS {
        return dots;
    }
    let cell = |(x, y): &Pixel| [*x, *y].map(|place| (place / HIDDEN_PX).round() as i64);
    let mut taken = BTreeSet::new();
    dots.into_iter().filter(|dot| taken.insert(cell(dot))).collect()
}

fn extremes(values: impl Iterator<Item = f64>) -> Option<[f64; 2]> {
    values.fold(None, |range: Option<[f64; 2]>, value| {
        Some(range.map_or([value, value], |[low, high]| [low.min(value), high.max(value)]))
    })
}

/// The range with a margin; a single value gets a margin of its own size.
pub(super) fn padded(low: f64, high: f64) -> [f64; 2] {
    let span = high - low;
    let magnitude = low.abs().max(high.abs());
    // Differences too small for the axis to write are drawn as a flat line.
    let margin = match span > 1e-5 * magnitude {
        true => 0.06 * span,
        // Nothing but zero has no size of its own.
        false if magnitude < f64::MIN_POSITIVE => 1.0,
        false => 0.1 * magnitude,
    };
    [low - margin, high + margin]
}

/// At most four points a column: first, lowest, highest, last, so that nothing visible is lost.
pub(super) fn thinned(points: &[(f64, f64)], x: [f64; 2]) -> Vec<(f64, f64)> {
    if points.len() as f64 <= 4.0 * COLUMNS {
        return points.to_vec();
    }
    let column = |at: f64| ((at - x[0]) / (x[1] - x[0]) * COLUMNS).floor();
    let mut kept: Vec<(f64, f64)> = Vec::new();
    for group in points.chunk_by(|a, b| column(a.0) == column(b.0)) {
        let by_value = |a: &&usize, b: &&usize| group[**a].1.total_cmp(&group[**b].1);
        let all: Vec<usize> = (0..group.len()).collect();
        let extreme = [all.iter().min_by(by_value), all.iter().max_by(by_value)];
        let mut indices = vec![0, group.len() - 1];
        indices.extend(extreme.into_iter().flatten());
        indices.sort_unstable();
        indices.dedup();
        kept.extend(indices.into_iter().map(|index| group[index]));
    }
    kept
}

//! Pictures of a plane: square panels side by side, the same scale along both axes unless stated, one legend.

use core::f64::consts::TAU;

use super::{
    axes::round_up,
    chart::draw_series,
    frame::{Axes, Frame},
    labels::{Labels, NAME_SIZE},
    legend::Legend,
    pen::{INK, Pen, Pixel, TEXT, width_px},
    picture::{LABEL, PLOT_LEFT, Picture, RIGHT, SHADE, TITLE_HEIGHT, WIDTH, X_AXIS_HEIGHT},
    series::{Series, pieces},
    shading::{SCALE_WIDTH, Shading},
};

/// Panels side by side; the legend is that of the first.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct PlaneChart {
    /// Title.
    pub title: String,
    /// Label of the horizontal axes, with its unit in brackets.
    pub x_label: String,
    /// Label of the vertical axes, with its unit in brackets.
    pub y_label: String,
    /// The panels, left to right. Series of the same place have the same colour.
    pub panels: Vec<PlanePanel>,
    /// Quantity of the panels' cells, with a scale to the right.
    pub shading: Option<Shading>,
}

impl PlaneChart {
    /// Chart of panels without cells that are shaded.
    pub fn new(title: impl Into<String>, [x_label, y_label]: [&str; 2], panels: Vec<PlanePanel>) -> Self {
        let [x_label, y_label] = [x_label, y_label].map(str::to_owned);
        Self { title: title.into(), x_label, y_label, panels, shading: None }
    }
}

/// One square of the plane.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct PlanePanel {
    /// Above it.
    pub title: String,
    /// Polygons, shaded, under the series.
    pub areas: Vec<Vec<(f64, f64)>>,
    /// Polygons with the value that each is shaded by, under the series.
    pub cells: Vec<(Vec<(f64, f64)>, f64)>,
    /// Thin lines under the series, such as meridians; a point that is not finite interrupts them.
    pub grid: Vec<(f64, f64)>,
    /// Curves of any course and dots.
    pub series: Vec<Series>,
    /// Short texts and the points they are centred on.
    pub texts: Vec<((f64, f64), String)>,
    /// Names of points, each beside its own inside the panel, where it covers no other.
    pub names: Vec<((f64, f64), String)>,
    /// Its middle.
    pub centre: (f64, f64),
    /// Half its side.
    pub half_width: f64,
    /// Half its side along the vertical axis, where that has another scale.
    pub half_height: Option<f64>,
}

/// Points of an ellipse: its middle, its semi-axes, and the angle of the first of them from the horizontal axis.
pub fn ellipse(middle: (f64, f64), [first, second]: [f64; 2], angle_rad: f64) -> Vec<(f64, f64)> {
    let (sine, cosine) = angle_rad.sin_cos();
    let point = |k: u32| {
        let (y, x) = (TAU * f64::from(k) / f64::from(POINTS)).sin_cos();
        let (along, across) = (first * x, second * y);
        (middle.0 + along * cosine - across * sine, middle.1 + along * sine + across * cosine)
    };
    (0..=POINTS).map(point).collect()
}

/// Points of an ellipse.
const POINTS: u32 = 360;
/// Greatest side of a panel.
const GREATEST_SIDE: f64 = 600.0;
const PANEL_TITLE_HEIGHT: f64 = 26.0;

impl PlaneChart {
    /// Width that a panel takes with its axis.
    fn panel_width(&self) -> f64 {
        let scale = if self.shading.is_some() { SCALE_WIDTH } else { 0.0 };
        (WIDTH - 14.0 - RIGHT - scale) / self.panels.len().max(1) as f64
    }

    fn side(&self) -> f64 {
        (self.panel_width() - (PLOT_LEFT - 14.0)).min(GREATEST_SIDE)
    }

    fn legend(&self) -> Legend<'_> {
        Legend::of_series(self.panels.first().map_or(&[], |panel| &panel.series))
    }
}

impl Picture for PlaneChart {
    fn title(&self) -> &str {
        &self.title
    }

    fn height(&self) -> Option<f64> {
        let drawable = |panel: &PlanePanel| panel.half_sides().iter().all(|it| it.is_finite() && *it > 0.0);
        let is_drawable = !self.panels.is_empty() && self.panels.iter().all(drawable);
        let around = TITLE_HEIGHT + self.legend().height() + PANEL_TITLE_HEIGHT + X_AXIS_HEIGHT;
        is_drawable.then_some(around + self.side())
    }

    fn draw(&self, pen: &mut Pen, top: f64) {
        let (legend, side) = (self.legend(), self.side());
        legend.draw(pen, top + TITLE_HEIGHT);
        let top = top + TITLE_HEIGHT + legend.height() + PANEL_TITLE_HEIGHT;
        for (index, panel) in self.panels.iter().enumerate() {
            let left = PLOT_LEFT + self.panel_width() * index as f64;
            let halves = panel.half_sides();
            let [x, y] = [(panel.centre.0, halves[0]), (panel.centre.1, halves[1])]
                .map(|(middle, half)| [middle - half, middle + half]);
            let frame = Frame { left, top, width: side, height: side, x, y };
            let labels = [self.x_label.as_str(), self.y_label.as_str()];
            let steps = halves.map(|half| round_up(half / 3.0));
            let axes = Axes { labels, steps, label_px: LABEL - 20.0, ..Axes::default() };
            let axes = axes.beside(y);
            pen.text((left + 0.5 * side, top - 8.0), 13.0, "middle", TEXT, &panel.title);
            panel.draw(pen, &frame, &axes, self.shading.as_ref());
            if let Some(shading) = self.shading.as_ref().filter(|_| index + 1 == self.panels.len()) {
                shading.draw_scale(pen, &frame);
            }
        }
    }
}

impl PlanePanel {
    /// Along both axes.
    fn half_sides(&self) -> [f64; 2] {
        [self.half_width, self.half_height.unwrap_or(self.half_width)]
    }

    fn draw(&self, pen: &mut Pen, frame: &Frame, axes: &Axes<'_>, shading: Option<&Shading>) {
        let at = |points: &[(f64, f64)]| -> Vec<Pixel> {
            points.iter().map(|(x, y)| frame.at([*x, *y])).collect()
        };
        let [low, high] = frame.corners();
        if let Some(shading) = shading {
            let cells: Vec<_> = self.cells.iter().map(|(corners, value)| (at(corners), *value)).collect();
            shading.draw(pen, &cells);
        }
        pen.within(low, high, |pen| self.areas.iter().for_each(|area| pen.polygon(&at(area), SHADE)));
        frame.grid(pen, axes);
        frame.axes(pen, axes);
        pen.within(low, high, |pen| {
            pen.lines(pieces(&self.grid).map(at), "stroke=\"#9aa2ac\" stroke-width=\"0.5\"");
        });
        for (index, series) in self.series.iter().enumerate() {
            draw_series(pen, frame, index, series, <[(f64, f64)]>::to_vec);
        }
        for ((x, y), text) in self.texts.iter().filter(|((x, y), _)| frame.holds([*x, *y])) {
            let (x, y) = frame.at([*x, *y]);
            pen.text((x, y + 4.0), 11.0, "middle", TEXT, text);
        }
        self.draw_names(pen, frame);
    }
}

impl PlanePanel {
    /// Names above, below or beside their points; one without a free place has the first.
    fn draw_names(&self, pen: &mut Pen, frame: &Frame) {
        const AWAY: f64 = 13.0;
        let shown: Vec<_> = self.names.iter().filter(|((x, y), _)| frame.holds([*x, *y])).collect();
        let [low, high] = frame.corners();
        let is_inside = |(x, y): Pixel| x > low.0 && x < high.0 && y > low.1 && y < high.1;
        let mut taken = Labels::default();
        for ((x, y), _) in &shown {
            taken.keep_off_sign(frame.at([*x, *y]), 10.0);
        }
        for ((x, y), name) in shown {
            let (x, y) = frame.at([*x, *y]);
            let across = 0.5 * width_px(name, NAME_SIZE) + AWAY;
            let around = [
                (0.0, -1.0),
                (0.0, 1.0),
                (1.0, 0.0),
                (-1.0, 0.0),
                (1.0, -1.0),
                (-1.0, -1.0),
                (1.0, 1.0),
                (-1.0, 1.0),
            ];
            let candidates = around.map(|(right, down)| (x + right * across, y + down * AWAY));
            let (x, y) = taken.place(name, candidates, is_inside).unwrap_or(candidates[0]);
            pen.label((x, y), NAME_SIZE, INK, name);
        }
    }
}

#[cfg(test)]
mod tests;

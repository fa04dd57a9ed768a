//! A rectangle of a picture and what its edges mean: where points are on it, its grid and its axes.

use super::{
    axes::{tick_text, ticks},
    pen::{BESIDE, Pen, Pixel, TEXT, width_px},
};

/// Pixels beyond this are as good as infinitely far.
const FAR_PX: f64 = 1e6;
/// Points of a line nearer than this are one, in pixels.
const NEAR_PX: f64 = 0.4;
/// Size of the texts of ticks, and their distance from the frame, in px.
const TICK_SIZE: f64 = 11.0;
const BESIDE_TICK: f64 = 8.0;
/// How far named ticks may reach beyond the right edge, in px.
const BEYOND: f64 = 20.0;
const GRID: &str = "stroke=\"#e3e6ea\"";
const BORDER: &str = "stroke=\"#9aa2ac\"";

/// A rectangle of the sheet, and what its edges mean.
#[derive(Clone, Copy, Debug)]
pub struct Frame {
    /// Left edge in px.
    pub left: f64,
    /// Upper edge in px.
    pub top: f64,
    /// Width in px.
    pub width: f64,
    /// Height in px.
    pub height: f64,
    /// Least and greatest value from left to right.
    pub x: [f64; 2],
    /// Least and greatest value from the bottom up.
    pub y: [f64; 2],
}

/// Labels of the axes of a frame.
#[derive(Default)]
pub struct Axes<'a> {
    /// Labels of the horizontal and the vertical axis; without the first, its ticks have no numbers.
    pub labels: [&'a str; 2],
    /// Spacing of ticks; 0 for none.
    pub steps: [f64; 2],
    /// Distance of the vertical label from the frame in px; of [`Axes::beside`] the greatest.
    pub label_px: f64,
    /// Whether only whole numbers have a text.
    pub is_whole: bool,
    /// Ticks with their texts in place of the multiples of a step, along and across; without any, those.
    pub named: [&'a [(f64, String)]; 2],
}

impl Axes<'_> {
    /// With the vertical label beside the texts of its ticks over this range.
    #[must_use]
    pub fn beside(self, y: [f64; 2]) -> Self {
        let widths = self.ticks(1, y).into_iter().map(|(_, text)| width_px(&text, TICK_SIZE));
        let label_px = widths.fold(0.0, f64::max) + BESIDE_TICK + TICK_SIZE;
        Self { label_px: self.label_px.min(label_px), ..self }
    }

    /// The ticks of an axis over its range, with their texts.
    fn ticks(&self, axis: usize, range: [f64; 2]) -> Vec<(f64, String)> {
        let step = self.steps[axis];
        let is_whole = axis == 1 && self.is_whole;
        if self.named[axis].is_empty() {
            let is_shown = |value: f64| !is_whole || (value - value.round()).abs() < 1e-6;
            let text = |value| if is_shown(value) { tick_text(value, step) } else { String::new() };
            return ticks(range, step).into_iter().map(|value| (value, text(value))).collect();
        }
        let within = self.named[axis].iter().filter(|(value, _)| (range[0]..=range[1]).contains(value));
        within.cloned().collect()
    }
}

impl Frame {
    /// Returns the position of a point on the sheet.
    pub fn at(&self, [x, y]: [f64; 2]) -> Pixel {
        let part = |value: f64, [low, high]: [f64; 2]| (value - low) / (high - low);
        let (x, y) =
            (self.left + self.width * part(x, self.x), self.top + self.height * (1.0 - part(y, self.y)));
        (x.clamp(-FAR_PX, FAR_PX), y.clamp(-FAR_PX, FAR_PX))
    }

    /// Whether a point is in it.
    pub fn holds(&self, [x, y]: [f64; 2]) -> bool {
        (self.x[0]..=self.x[1]).contains(&x) && (self.y[0]..=self.y[1]).contains(&y)
    }

    /// Its upper left and lower right corner.
    pub fn corners(&self) -> [Pixel; 2] {
        [(self.left, self.top), (self.left + self.width, self.top + self.height)]
    }

    /// A line of places.
    pub fn line(&self, pen: &mut Pen, places: &[[f64; 2]], attributes: &str) {
        let line = thinned(places.iter().map(|place| self.at(*place)));
        pen.lines([line], attributes);
    }

    /// Thin lines at the ticks of both axes.
    pub fn grid(&self, pen: &mut Pen, axes: &Axes<'_>) {
        let across = axes.ticks(1, self.y).into_iter().map(|(y, _)| self.x.map(|x| self.at([x, y])));
        let along = axes.ticks(0, self.x).into_iter().map(|(x, _)| self.y.map(|y| self.at([x, y])));
        pen.lines(across.chain(along), GRID);
    }

    /// Border, ticks, numbers, labels.
    pub fn axes(&self, pen: &mut Pen, axes: &Axes<'_>) {
        let [low, high] = self.corners();
        pen.rect(low, high, &format!("fill=\"none\" {BORDER}"));
        let mut marks: Vec<[Pixel; 2]> = Vec::new();
        let [x_label, y_label] = axes.labels;
        for (tick, text) in axes.ticks(0, self.x).into_iter().filter(|_| !x_label.is_empty()) {
            let (x, y) = self.at([tick, self.y[0]]);
            marks.push([(x, y), (x, y + 4.0)]);
            // A long text at the right edge stays on the sheet.
            let half = 0.5 * width_px(&text, TICK_SIZE);
            let x = if axes.named[0].is_empty() { x } else { x.min(high.0 + BEYOND - half) };
            pen.text((x, y + 17.0), TICK_SIZE, "middle", BESIDE, &text);
        }
        // Beside the label, however long a name is.
        let room = axes.label_px - BESIDE_TICK - TICK_SIZE;
        let mut last_y = f64::INFINITY;
        for (tick, text) in axes.ticks(1, self.y) {
            let (x, y) = self.at([self.x[0], tick]);
            marks.push([(x - 4.0, y), (x, y)]);
            if !axes.named[1].is_empty() && last_y - y < TICK_SIZE {
                continue;
            }
            last_y = y;
            let size = TICK_SIZE * (room / width_px(&text, TICK_SIZE)).min(1.0);
            pen.text((x - BESIDE_TICK, y + 4.0), size, "end", BESIDE, &text);
        }
        pen.lines(marks, BORDER);
        if !x_label.is_empty() {
            pen.text((self.left + 0.5 * self.width, high.1 + 34.0), 12.0, "middle", TEXT, x_label);
        }
        let (x, y) = (self.left - axes.label_px, self.top + 0.5 * self.height);
        let turned = format!("{TEXT} transform=\"rotate(-90 {x:.1} {y:.1})\"");
        pen.text((x, y), 12.0, "middle", &turned, y_label);
    }
}

/// Points without those that are near the one before; the last one stays.
pub fn thinned(points: impl Iterator<Item = Pixel>) -> Vec<Pixel> {
    let mut kept: Vec<Pixel> = Vec::new();
    let mut last = None;
    for point in points {
        let is_near = kept.last().is_some_and(|(x, y)| (point.0 - x).hypot(point.1 - y) < NEAR_PX);
        if !is_near {
            kept.push(point);
        }
        last = is_near.then_some(point);
    }
    kept.extend(last);
    kept
}

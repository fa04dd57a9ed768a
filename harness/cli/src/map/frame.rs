//! A rectangle of the picture with its axes, what is drawn in it in its own coordinates.

use super::{
    colours::{Bands, tick_text, ticks},
    contour::{self, Edge},
};
use crate::draw::pen::{GREY, INK, Pen, Pixel};

/// Points of a line nearer than this are one, in pixels.
const NEAR_PX: f64 = 0.4;

/// A rectangle of the sheet, and what its edges mean.
#[derive(Clone, Copy, Debug)]
pub struct Frame {
    pub left: f64,
    pub top: f64,
    pub width: f64,
    pub height: f64,
    /// Least and greatest along both axes.
    pub x: [f64; 2],
    pub y: [f64; 2],
}

/// Labels of both axes and their spacing.
pub struct Axes<'a> {
    pub labels: [&'a str; 2],
    pub steps: [f64; 2],
}

impl Frame {
    /// Where a point is on the sheet.
    pub fn at(&self, [x, y]: [f64; 2]) -> Pixel {
        let part = |value: f64, [low, high]: [f64; 2]| (value - low) / (high - low);
        (self.left + self.width * part(x, self.x), self.top + self.height * (1.0 - part(y, self.y)))
    }

    /// Whether a point is in it.
    pub fn holds(&self, [x, y]: [f64; 2]) -> bool {
        (self.x[0]..=self.x[1]).contains(&x) && (self.y[0]..=self.y[1]).contains(&y)
    }

    /// Bands of values at nodes from corner to corner, the lowest below all others.
    pub fn bands(
        &self,
        pen: &mut Pen,
        steps: [usize; 2],
        value: &impl Fn(usize, usize) -> f64,
        bands: Bands,
    ) {
        let corners = [[0, 0], [1, 0], [1, 1], [0, 1]].map(|[x, y]| self.at([self.x[x], self.y[y]]));
        for number in bands.numbers() {
            let colour = bands.colour(number);
            if number == -bands.count {
                pen.polygon(&corners, &format!("fill=\"{colour}\""));
                continue;
            }
            let level = f64::from(number) * bands.step;
            let lines = self.enclosing(steps, &|column, row| value(column, row) - level);
            pen.area(lines.iter().map(Vec::as_slice), &colour);
        }
    }

    /// The nodes of which something holds.
    pub fn area(
        &self,
        pen: &mut Pen,
        steps: [usize; 2],
        holds: &impl Fn(usize, usize) -> bool,
        colour: &str,
    ) {
        let lines = self.enclosing(steps, &|column, row| if holds(column, row) { 1.0 } else { -1.0 });
        pen.area(lines.iter().map(Vec::as_slice), colour);
    }

    /// Closed lines around nodes that are not below 0: a rim of nodes below everything closes them at the border.
    fn enclosing(&self, steps: [usize; 2], value: &impl Fn(usize, usize) -> f64) -> Vec<Vec<Pixel>> {
        let inner = |node: usize, of: usize| node.checked_sub(1).filter(|node| *node <= steps[of]);
        let rimmed = |column: usize, row: usize| match (inner(column, 0), inner(row, 1)) {
            (Some(column), Some(row)) => value(column, row),
            _ => f64::NEG_INFINITY,
        };
        let lines = contour::lines([steps[0] + 2, steps[1] + 2], rimmed, |_| true);
        let place = |edge: &Edge| {
            let ([column, row], [other_column, other_row]) = ([edge.column, edge.row], edge.end());
            let (a, b) = (rimmed(column, row), rimmed(other_column, other_row));
            let part = match (a.is_finite(), b.is_finite()) {
                (true, true) => a / (a - b),
                (true, false) => 0.0,
                _ => 1.0,
            };
            let along = |from: usize, to: usize, of: usize, [low, high]: [f64; 2]| {
                let [from, to] = [from, to].map(|node| (node as f64 - 1.0) / steps[of] as f64);
                low + (high - low) * (from + part * (to - from))
            };
            self.at([along(column, other_column, 0, self.x), along(row, other_row, 1, self.y)])
        };
        lines.iter().map(|line| thinned(line.iter().map(place))).collect()
    }

    /// A line of places.
    pub fn line(&self, pen: &mut Pen, places: &[[f64; 2]], attributes: &str) {
        let line = thinned(places.iter().map(|place| self.at(*place)));
        pen.lines([line.as_slice()], attributes);
    }

    /// Border, ticks, numbers, labels.
    pub fn axes(&self, pen: &mut Pen, axes: &Axes<'_>) {
        let border = [[0, 0], [1, 0], [1, 1], [0, 1]].map(|[x, y]| self.at([self.x[x], self.y[y]]));
        pen.polygon(&border, &format!("fill=\"none\" stroke=\"{GREY}\" stroke-width=\"1\""));
        let fill = format!("fill=\"{GREY}\"");
        let bottom = self.top + self.height;
        for tick in ticks(self.x[0], self.x[1], axes.steps[0]) {
            let (x, _) = self.at([tick, self.y[0]]);
            pen.lines([&[(x, bottom), (x, bottom + 4.0)][..]], &format!("stroke=\"{GREY}\""));
            pen.text((x, bottom + 16.0), 11.0, "middle", &fill, &tick_text(tick, axes.steps[0]));
        }
        for tick in ticks(self.y[0], self.y[1], axes.steps[1]) {
            let (_, y) = self.at([self.x[0], tick]);
            pen.lines([&[(self.left - 4.0, y), (self.left, y)][..]], &format!("stroke=\"{GREY}\""));
            pen.text((self.left - 7.0, y + 4.0), 11.0, "end", &fill, &tick_text(tick, axes.steps[1]));
        }
        let ink = format!("fill=\"{INK}\"");
        pen.text((self.left + 0.5 * self.width, bottom + 33.0), 12.0, "middle", &ink, axes.labels[0]);
        let (x, y) = (self.left - 42.0, self.top + 0.5 * self.height);
        let turned = format!("{ink} transform=\"rotate(-90 {x:.1} {y:.1})\"");
        pen.text((x, y), 12.0, "middle", &turned, axes.labels[1]);
    }

    /// The bands' colours with their edges, to the right.
    pub fn scale(&self, pen: &mut Pen, bands: Bands, unit: &str) {
        let (left, width) = (self.left + self.width + 10.0, 12.0);
        let count = f64::from(2 * bands.count);
        let y = |number: i32| self.top + self.height * (f64::from(bands.count - number) / count);
        let every = (bands.count + 3) / 4;
        for number in bands.numbers() {
            let corners = [
                (left, y(number)),
                (left + width, y(number)),
                (left + width, y(number + 1)),
                (left, y(number + 1)),
            ];
            pen.polygon(&corners, &format!("fill=\"{}\"", bands.colour(number)));
        }
        for number in (-bands.count..=bands.count).filter(|number| number % every == 0) {
            let text = tick_text(f64::from(number) * bands.step, bands.step);
            pen.text(
                (left + width + 4.0, y(number) + 4.0),
                11.0,
                "start",
                &format!("fill=\"{GREY}\""),
                &text,
            );
        }
        pen.text((left, self.top - 6.0), 11.0, "start", &format!("fill=\"{GREY}\""), unit);
    }
}

/// Without points that are near the one before; the last one stays.
fn thinned(points: impl Iterator<Item = Pixel>) -> Vec<Pixel> {
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

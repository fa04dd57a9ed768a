//! Bands of a quantity on a grid of nodes that fills a frame, and their scale.

use drawing::{BESIDE, Frame, Pen, Pixel, thinned, tick_text};

use super::colours::Bands;
use crate::torque_map::{self, Edge};

/// Bands of values at nodes from corner to corner, the lowest below all others.
pub(super) fn draw(
    frame: &Frame,
    pen: &mut Pen,
    steps: [usize; 2],
    value: &impl Fn(usize, usize) -> f64,
    bands: Bands,
) {
    let [low, high] = frame.corners();
    for number in bands.numbers() {
        let colour = bands.colour(number);
        if number == -bands.count {
            pen.rect(low, high, &format!("fill=\"{colour}\""));
            continue;
        }
        let level = f64::from(number) * bands.step;
        let lines = enclosing(frame, steps, &|column, row| value(column, row) - level);
        pen.area(lines.iter().map(Vec::as_slice), &colour);
    }
}

/// Nodes at which a condition holds.
pub(super) fn area(
    frame: &Frame,
    pen: &mut Pen,
    steps: [usize; 2],
    holds: &impl Fn(usize, usize) -> bool,
    colour: &str,
) {
    let lines = enclosing(frame, steps, &|column, row| if holds(column, row) { 1.0 } else { -1.0 });
    pen.area(lines.iter().map(Vec::as_slice), colour);
}

/// Closed lines around nodes that are not below 0: a rim of nodes below everything closes them at the border.
fn enclosing(frame: &Frame, steps: [usize; 2], value: &impl Fn(usize, usize) -> f64) -> Vec<Vec<Pixel>> {
    let inner = |node: usize, of: usize| node.checked_sub(1).filter(|node| *node <= steps[of]);
    let rimmed = |column: usize, row: usize| match (inner(column, 0), inner(row, 1)) {
        (Some(column), Some(row)) => value(column, row),
        _ => f64::NEG_INFINITY,
    };
    let lines = torque_map::lines([steps[0] + 2, steps[1] + 2], rimmed, |_| true);
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
        frame.at([along(column, other_column, 0, frame.x), along(row, other_row, 1, frame.y)])
    };
    lines.iter().map(|line| thinned(line.iter().map(place))).collect()
}

/// The bands' colours with their edges, to the right.
pub(super) fn scale(frame: &Frame, pen: &mut Pen, bands: Bands, unit: &str) {
    let (left, width) = (frame.left + frame.width + 10.0, 12.0);
    let count = f64::from(2 * bands.count);
    let y = |number: i32| frame.top + frame.height * (f64::from(bands.count - number) / count);
    let every = (bands.count + 3) / 4;
    for number in bands.numbers() {
        pen.rect(
            (left, y(number + 1)),
            (left + width, y(number)),
            &format!("fill=\"{}\"", bands.colour(number)),
        );
    }
    for number in (-bands.count..=bands.count).filter(|number| number % every == 0) {
        let text = tick_text(f64::from(number) * bands.step, bands.step);
        pen.text((left + width + 4.0, y(number) + 4.0), 11.0, "start", BESIDE, &text);
    }
    pen.text((left, frame.top - 6.0), 11.0, "start", BESIDE, unit);
}

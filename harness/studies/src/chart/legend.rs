//! The legend: above the panel, right-aligned, in as many rows as it takes.

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::{
    series::{Mark, Panel, Series},
    style::{Area, COLOURS, Drawn, FINE, FONT, INK, LEFT, RIGHT, WIDTH, Y_AXIS_WIDTH, pixel},
};

/// Height of a row in drawing units.
pub(super) const ROW_HEIGHT: u32 = 26 * FINE;
const SWATCH: i32 = 18 * UNITS;
const DASH: i32 = 7 * UNITS;
const GAP: i32 = 6 * UNITS;
const BETWEEN: i32 = 20 * UNITS;
const UNITS: i32 = FINE as i32;

/// Height of the panel's legend in drawing units; 0 for none.
pub(super) fn height(panel: &Panel) -> u32 {
    u32::try_from(rows(panel).len()).unwrap_or(0) * ROW_HEIGHT
}

/// Draws it.
pub(super) fn draw(area: &Area<'_>, panel: &Panel) -> Drawn {
    let style = (FONT, 13 * FINE).into_font().color(&INK).pos(Pos::new(HPos::Left, VPos::Center));
    let mut y = pixel(ROW_HEIGHT / 2);
    for row in rows(panel) {
        let width: i32 = row.iter().map(|(_, series)| entry_width(series)).sum();
        let mut x = pixel(WIDTH - RIGHT) - width + BETWEEN;
        for (index, series) in row {
            let colour = COLOURS[index % COLOURS.len()];
            match series.mark {
                Mark::Line | Mark::Steps => {
                    area.draw(&PathElement::new([(x, y), (x + SWATCH, y)], colour.stroke_width(3 * FINE)))?;
                }
                Mark::Dashed => {
                    for from in [x, x + SWATCH - DASH] {
                        let dash = [(from, y), (from + DASH, y)];
                        area.draw(&PathElement::new(dash, colour.stroke_width(3 * FINE)))?;
                    }
                }
                Mark::Rings => {
                    area.draw(&Circle::new((x + SWATCH / 2, y), 5 * UNITS, colour.stroke_width(FINE)))?
                }
                Mark::Dots => area.draw(&Circle::new((x + SWATCH / 2, y), 4 * UNITS, colour.filled()))?,
            }
            area.draw_text(&series.label, &style, (x + SWATCH + GAP, y))?;
            x += entry_width(series);
        }
        y += pixel(ROW_HEIGHT);
    }
    Ok(())
}

/// The labelled series with their places, row by row.
fn rows(panel: &Panel) -> Vec<Vec<(usize, &Series)>> {
    let width_available = pixel(WIDTH - LEFT - Y_AXIS_WIDTH - RIGHT);
    let (mut rows, mut used): (Vec<Vec<(usize, &Series)>>, i32) = (Vec::new(), 0);
    for (index, series) in panel.series.iter().enumerate().filter(|(_, series)| !series.label.is_empty()) {
        let width = entry_width(series);
        match rows.last_mut() {
            Some(row) if used + width - BETWEEN <= width_available => {
                row.push((index, series));
                used += width;
            }
            _ => {
                rows.push(vec![(index, series)]);
                used = width;
            }
        }
    }
    rows
}

fn entry_width(series: &Series) -> i32 {
    SWATCH + GAP + text_width(&series.label) + BETWEEN
}

/// Width of a legend label in drawing units, estimated: the font is the viewer's.
fn text_width(text: &str) -> i32 {
    let eighths: i32 = text
        .chars()
        .map(|c| match c {
            'i' | 'j' | 'l' | '.' | ',' | '[' | ']' | '(' | ')' | ' ' | 't' | 'f' => 32,
            'm' | 'w' | 'M' | 'W' => 84,
            _ => 58,
        })
        .sum();
    eighths * UNITS / 8
}

#[cfg(test)]
mod tests {
    //! No entry is lost, and no row is wider than the panel.
    use super::*;

    #[test]
    fn long_legends_take_several_rows() {
        let series = (1..=9).map(|k| Series::line(format!("plate[{k}].temperature"), vec![])).collect();
        let panel = Panel { series, ..Panel::default() };
        let rows = rows(&panel);
        assert!(rows.len() > 1 && height(&panel) == ROW_HEIGHT * rows.len() as u32);
        let shown: Vec<usize> = rows.iter().flatten().map(|(index, _)| *index).collect();
        assert_eq!(shown, (0..9).collect::<Vec<_>>());
        for row in rows {
            let width: i32 = row.iter().map(|(_, series)| entry_width(series)).sum();
            assert!(width - BETWEEN <= pixel(WIDTH - LEFT - Y_AXIS_WIDTH - RIGHT));
        }
        assert_eq!(height(&Panel::default()), 0);
    }
}

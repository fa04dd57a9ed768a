//! The legend: above the panel, right-aligned, in as many rows as it takes.

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::{
    series::{Mark, Panel},
    style::{Area, COLOURS, Drawn, FINE, FONT, INK, LEFT, QUIET, RIGHT, SHADE, WIDTH, Y_AXIS_WIDTH, pixel},
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
        let width: i32 = row.iter().map(Entry::width).sum();
        let mut x = pixel(WIDTH - RIGHT) - width + BETWEEN;
        for entry in row {
            entry.swatch.draw(area, x, y)?;
            area.draw_text(entry.label, &style, (x + SWATCH + GAP, y))?;
            x += entry.width();
        }
        y += pixel(ROW_HEIGHT);
    }
    Ok(())
}

/// What stands before a label.
#[derive(Clone, Copy)]
enum Swatch {
    /// A series by its place and how it is drawn.
    Series(usize, Mark),
    /// The dashed lines of marked values.
    Marks,
    /// Shaded spans.
    Shades,
}

impl Swatch {
    /// Draws it from `x` on about the height `y`.
    fn draw(self, area: &Area<'_>, x: i32, y: i32) -> Drawn {
        let dashes = |pen: ShapeStyle| -> Drawn {
            for from in [x, x + SWATCH - DASH] {
                area.draw(&PathElement::new([(from, y), (from + DASH, y)], pen))?;
            }
            Ok(())
        };
        let colour = |index: usize| COLOURS[index % COLOURS.len()];
        match self {
            Self::Series(index, Mark::Line | Mark::Curve | Mark::Steps) => {
                let pen = colour(index).stroke_width(3 * FINE);
                area.draw(&PathElement::new([(x, y), (x + SWATCH, y)], pen))?;
            }
            Self::Series(index, Mark::Dashed) => dashes(colour(index).stroke_width(3 * FINE))?,
            Self::Series(index, Mark::Rings) => {
                area.draw(&Circle::new((x + SWATCH / 2, y), 5 * UNITS, colour(index).stroke_width(FINE)))?;
            }
            Self::Series(index, Mark::Dots) => {
                area.draw(&Circle::new((x + SWATCH / 2, y), 4 * UNITS, colour(index).filled()))?;
            }
            Self::Marks => dashes(QUIET.stroke_width(FINE))?,
            Self::Shades => {
                let corners = [(x, y - SWATCH / 3), (x + SWATCH, y + SWATCH / 3)];
                area.draw(&Rectangle::new(corners, SHADE.filled()))?;
            }
        }
        Ok(())
    }
}

/// A label with what stands before it.
struct Entry<'a> {
    swatch: Swatch,
    label: &'a str,
}

impl Entry<'_> {
    /// Width in drawing units, with the space to the next one.
    fn width(&self) -> i32 {
        SWATCH + GAP + text_width(self.label) + BETWEEN
    }
}

/// Everything with a label, row by row.
fn rows(panel: &Panel) -> Vec<Vec<Entry<'_>>> {
    let series = panel.series.iter().enumerate();
    let series = series.map(|(k, it)| (Swatch::Series(k, it.mark), it.label.as_str()));
    let others = [(Swatch::Marks, panel.mark_label.as_str()), (Swatch::Shades, panel.shade_label.as_str())];
    let entries = series.chain(others).filter(|(_, label)| !label.is_empty());
    let width_available = pixel(WIDTH - LEFT - Y_AXIS_WIDTH - RIGHT);
    let (mut rows, mut used): (Vec<Vec<Entry<'_>>>, i32) = (Vec::new(), 0);
    for (swatch, label) in entries {
        let entry = Entry { swatch, label };
        let width = entry.width();
        match rows.last_mut() {
            Some(row) if used + width - BETWEEN <= width_available => {
                row.push(entry);
                used += width;
            }
            _ => {
                rows.push(vec![entry]);
                used = width;
            }
        }
    }
    rows
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
    use super::super::series::Series;
    use super::*;

    #[test]
    fn long_legends_take_several_rows() {
        let series = (1..=9).map(|k| Series::line(format!("plate[{k}].temperature"), vec![])).collect();
        let panel = Panel { series, mark_label: "limit".to_owned(), ..Panel::default() };
        let rows = rows(&panel);
        assert!(rows.len() > 1 && height(&panel) == ROW_HEIGHT * rows.len() as u32);
        let shown: Vec<&str> = rows.iter().flatten().map(|entry| entry.label).collect();
        let labels = panel.series.iter().map(|series| series.label.as_str());
        assert_eq!(shown, labels.chain(["limit"]).collect::<Vec<_>>());
        for row in rows {
            let width: i32 = row.iter().map(Entry::width).sum();
            assert!(width - BETWEEN <= pixel(WIDTH - LEFT - Y_AXIS_WIDTH - RIGHT));
        }
        assert_eq!(height(&Panel::default()), 0);
    }
}

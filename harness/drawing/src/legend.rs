//! The legend: above a panel, right-aligned, in as many rows as it takes.

use super::{
    pen::{COLOURS, GREY, Pen, TEXT, width_px},
    picture::{PLOT_LEFT, RIGHT, SHADE, WIDTH},
    series::{BAND_OPACITY, Mark, Panel, Series},
};

/// Height of a row.
pub(super) const ROW_HEIGHT: f64 = 26.0;
const SIZE: f64 = 12.0;
const TITLE_SIZE: f64 = 13.0;
const SWATCH: f64 = 18.0;
const GAP: f64 = 6.0;
const BETWEEN: f64 = 20.0;

/// Symbol before a label.
#[derive(Clone, Copy)]
enum Swatch {
    /// A series by its place and how it is drawn.
    Series(usize, Mark),
    /// The dashed lines of marked values.
    Marks,
    /// Shaded spans.
    Shades,
    /// The extremes of an oscillation.
    Band,
    /// A range about a series: index of the series, number of wider ranges beneath it.
    Range(usize, usize),
}

/// Label of a band.
const BAND: &str = "range and mean of an oscillation";

/// Labels with what stands before them, row by row, and what stands at the left of the first.
pub(super) struct Legend<'a> {
    title: &'a str,
    rows: Vec<Vec<(Swatch, &'a str)>>,
}

impl<'a> Legend<'a> {
    /// Legend of a panel's lines, marks and shades, and of its bands where they are to be named.
    pub(crate) fn new(panel: &'a Panel, names_bands: bool) -> Self {
        let marks = (Swatch::Marks, panel.mark_label.as_str());
        let shades = (Swatch::Shades, panel.shade_label.as_str());
        let band = names_bands.then_some((Swatch::Band, BAND));
        Self::rows(&panel.title, series(&panel.series).chain([marks, shades]).chain(band))
    }

    /// Legend of lines alone.
    pub(crate) fn of_series(all: &'a [Series]) -> Self {
        Self::rows("", series(all))
    }

    /// Legend of lines of these names in the order of colours.
    pub(crate) fn of_names(names: &'a [String]) -> Self {
        let lines = names.iter().enumerate();
        Self::rows("", lines.map(|(k, name)| (Swatch::Series(k, Mark::Line), name.as_str())))
    }

    fn rows(title: &'a str, entries: impl Iterator<Item = (Swatch, &'a str)>) -> Self {
        let (mut rows, mut used): (Vec<Vec<_>>, f64) = (Vec::new(), 0.0);
        if !title.is_empty() {
            rows.push(Vec::new());
            used = width_px(title, TITLE_SIZE) + BETWEEN;
        }
        for entry in entries.filter(|(_, label)| !label.is_empty()) {
            let width = width(entry.1);
            match rows.last_mut() {
                Some(row) if used + width - BETWEEN <= WIDTH - PLOT_LEFT - RIGHT => row.push(entry),
                _ => {
                    rows.push(vec![entry]);
                    used = 0.0;
                }
            }
            used += width;
        }
        Self { title, rows }
    }

    pub(crate) fn height(&self) -> f64 {
        ROW_HEIGHT * self.rows.len() as f64
    }

    pub(crate) fn draw(&self, pen: &mut Pen, top: f64) {
        if !self.title.is_empty() {
            let at = (PLOT_LEFT, top + 0.5 * ROW_HEIGHT + 4.0);
            pen.text(at, TITLE_SIZE, "start", TEXT, self.title);
        }
        for (index, row) in self.rows.iter().enumerate() {
            let y = top + ROW_HEIGHT * (index as f64 + 0.5);
            let mut x = WIDTH - RIGHT + BETWEEN - row.iter().map(|(_, label)| width(label)).sum::<f64>();
            for (swatch, label) in row {
                swatch.draw(pen, x, y);
                pen.text((x + SWATCH + GAP, y + 4.0), SIZE, "start", TEXT, label);
                x += width(label);
            }
        }
    }
}

fn series(all: &[Series]) -> impl Iterator<Item = (Swatch, &str)> {
    all.iter().enumerate().flat_map(|(k, it)| {
        let bands = it.bands.iter().enumerate();
        let bands = bands.map(move |(wider, band)| (Swatch::Range(k, wider), band.label.as_str()));
        std::iter::once((Swatch::Series(k, it.mark), it.label.as_str())).chain(bands)
    })
}

/// Width of an entry with the space to the next one.
fn width(label: &str) -> f64 {
    SWATCH + GAP + width_px(label, SIZE) + BETWEEN
}

impl Swatch {
    fn draw(self, pen: &mut Pen, x: f64, y: f64) {
        let line = |pen: &mut Pen, stroke: &str| pen.lines([[(x, y), (x + SWATCH, y)]], stroke);
        match self {
            Self::Shades => pen.rect((x, y - 6.0), (x + SWATCH, y + 6.0), SHADE),
            Self::Band => {
                let corners = [(x, y - 6.0), (x + SWATCH, y - 6.0), (x + SWATCH, y + 6.0), (x, y + 6.0)];
                pen.polygon(&corners, &format!("fill=\"{GREY}\" fill-opacity=\"0.25\""));
                for y in [y - 6.0, y + 6.0] {
                    pen.lines([[(x, y), (x + SWATCH, y)]], &format!("stroke=\"{GREY}\""));
                }
                line(pen, &format!("stroke=\"{GREY}\" stroke-width=\"2\""));
            }
            Self::Range(index, wider) => {
                let colour = COLOURS[index % COLOURS.len()];
                // On the wider ones, as in the panel.
                for _ in 0..=wider {
                    let fill = format!("fill=\"{colour}\" fill-opacity=\"{BAND_OPACITY}\"");
                    pen.rect((x, y - 6.0), (x + SWATCH, y + 6.0), &fill);
                }
            }
            Self::Marks => line(pen, &format!("stroke=\"{GREY}\" stroke-dasharray=\"7 4\"")),
            Self::Series(index, mark) => {
                let colour = COLOURS[index % COLOURS.len()];
                let middle = (x + 0.5 * SWATCH, y);
                match mark {
                    Mark::Line | Mark::Curve | Mark::Steps => {
                        line(pen, &format!("stroke=\"{colour}\" stroke-width=\"3\""))
                    }
                    Mark::Dashed => {
                        line(pen, &format!("stroke=\"{colour}\" stroke-width=\"3\" stroke-dasharray=\"7 4\""))
                    }
                    Mark::Rings => pen.circle(middle, 5.0, &format!("fill=\"none\" stroke=\"{colour}\"")),
                    Mark::Dots => pen.circle(middle, 4.0, &format!("fill=\"{colour}\"")),
                    Mark::Bars => {
                        pen.rect((x, y - 6.0), (x + SWATCH, y + 6.0), &format!("fill=\"{colour}\""))
                    }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    //! No entry is lost, and no row is wider than the panel.
    use super::*;

    #[test]
    fn long_legends_take_several_rows() {
        let series = (1..=9).map(|k| Series::line(format!("plate[{k}].temperature"), vec![])).collect();
        let panel = Panel { series, mark_label: "limit".to_owned(), ..Panel::default() };
        let legend = Legend::new(&panel, false);
        assert!(legend.rows.len() > 1 && legend.height() == ROW_HEIGHT * legend.rows.len() as f64);
        let shown: Vec<&str> = legend.rows.iter().flatten().map(|(_, label)| *label).collect();
        let labels = panel.series.iter().map(|series| series.label.as_str());
        assert_eq!(shown, labels.chain(["limit"]).collect::<Vec<_>>());
        for row in legend.rows {
            let wide: f64 = row.iter().map(|(_, label)| width(label)).sum();
            assert!(wide - BETWEEN <= WIDTH - PLOT_LEFT - RIGHT);
        }
        assert_eq!(Legend::new(&Panel::default(), false).height(), 0.0);
    }

    #[test]
    fn a_title_has_its_own_room_in_the_first_row() {
        let few = Panel { title: "by approximation".to_owned(), ..Panel::default() };
        let few = few.with([Series::line("a", vec![])]);
        assert_eq!(Legend::new(&few, false).height(), ROW_HEIGHT);
        let wide = "a".repeat(90);
        let with = |title: &str| Panel { title: title.to_owned(), ..Panel::default() };
        let with = |title: &str| with(title).with([Series::line(wide.clone(), vec![])]);
        assert_eq!(Legend::new(&with(""), false).height(), ROW_HEIGHT);
        assert_eq!(Legend::new(&with("sampled every 8 spins"), false).height(), 2.0 * ROW_HEIGHT);
    }
}

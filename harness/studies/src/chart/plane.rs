//! Pictures of a plane as SVG: square panels side by side, the same scale along both axes, one legend.

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::style::*;
use super::{ChartError, Mark, Panel, Series, draw_series, finished, legend, tick_step, tick_text};

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
}

/// One square of the plane.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct PlanePanel {
    /// Above it.
    pub title: String,
    /// Polygons, shaded, under the series.
    pub areas: Vec<Vec<(f64, f64)>>,
    /// Thin lines under the series, such as meridians; a point that is not finite interrupts them.
    pub grid: Vec<(f64, f64)>,
    /// Curves of any course and dots.
    pub series: Vec<Series>,
    /// Short texts and the points they are centred on.
    pub texts: Vec<((f64, f64), String)>,
    /// Its middle.
    pub centre: (f64, f64),
    /// Half its side.
    pub half_width: f64,
}

/// Greatest side of a panel.
const GREATEST_SIDE: u32 = 600 * FINE;

impl PlaneChart {
    /// The picture as SVG text.
    pub fn to_svg(&self) -> Result<String, ChartError> {
        let drawable = |panel: &PlanePanel| panel.half_width.is_finite() && panel.half_width > 0.0;
        if self.panels.is_empty() || !self.panels.iter().all(drawable) {
            return Err(ChartError::Empty(self.title.clone()));
        }
        let mut svg = String::new();
        finished(&self.title, self.draw(&mut svg), svg, self.height())
    }

    /// Width that a panel takes with its axis.
    fn panel_width(&self) -> u32 {
        (WIDTH - LEFT - RIGHT) / u32::try_from(self.panels.len()).unwrap_or(1).max(1)
    }

    fn side(&self) -> u32 {
        (self.panel_width() - Y_AXIS_WIDTH).min(GREATEST_SIDE)
    }

    fn legend(&self) -> Panel {
        let first = self.panels.first();
        Panel { series: first.map_or_else(Vec::new, |panel| panel.series.clone()), ..Panel::default() }
    }

    fn top(&self) -> u32 {
        TITLE_HEIGHT + legend::height(&self.legend()) + PANEL_TITLE_HEIGHT
    }

    fn height(&self) -> u32 {
        self.top() + self.side() + X_AXIS_HEIGHT
    }

    fn draw(&self, svg: &mut String) -> Drawn {
        let root = SVGBackend::with_string(svg, (WIDTH, self.height())).into_drawing_area();
        root.fill(&WHITE)?;
        let style = (FONT, 20 * FINE).into_font().style(FontStyle::Bold).color(&INK);
        let style = style.pos(Pos::new(HPos::Left, VPos::Center));
        root.draw_text(&self.title, &style, (pixel(LEFT + Y_AXIS_WIDTH), pixel(TITLE_HEIGHT / 2)))?;
        let legend = self.legend();
        legend::draw(&root.clone().shrink((0, TITLE_HEIGHT), (WIDTH, legend::height(&legend))), &legend)?;
        let mut left = LEFT;
        for panel in &self.panels {
            let size = (Y_AXIS_WIDTH + self.side(), self.side() + X_AXIS_HEIGHT + PANEL_TITLE_HEIGHT);
            self.draw_panel(&root.clone().shrink((left, self.top() - PANEL_TITLE_HEIGHT), size), panel)?;
            left += self.panel_width();
        }
        root.present()?;
        Ok(())
    }

    fn draw_panel(&self, area: &Area<'_>, panel: &PlanePanel) -> Drawn {
        let ((x, y), half) = (panel.centre, panel.half_width);
        let window = Window { centre: panel.centre, half };
        let mut chart = ChartBuilder::on(area)
            .margin_top(PANEL_TITLE_HEIGHT)
            .margin_bottom(BOTTOM)
            .x_label_area_size(X_AXIS_HEIGHT - BOTTOM)
            .y_label_area_size(Y_AXIS_WIDTH)
            .build_cartesian_2d(x - half..x + half, y - half..y + half)?;
        let middle = pixel(Y_AXIS_WIDTH + self.side() / 2);
        let style = (FONT, 15 * FINE).into_font().color(&INK).pos(Pos::new(HPos::Center, VPos::Center));
        area.draw_text(&panel.title, &style, (middle, pixel(PANEL_TITLE_HEIGHT / 2)))?;
        for polygon in
            panel.areas.iter().map(|polygon| window.polygon(polygon)).filter(|polygon| !polygon.is_empty())
        {
            chart.draw_series([Polygon::new(polygon, SHADE)])?;
        }
        let ticks = 6;
        let step = tick_step((-half, half), ticks);
        let format = |value: &f64| tick_text(*value, step);
        let label_style = (FONT, 13 * FINE).into_font().color(&QUIET);
        chart
            .configure_mesh()
            .set_all_tick_mark_size(pixel(5 * FINE))
            .light_line_style(TRANSPARENT)
            .bold_line_style(GRID.stroke_width(FINE))
            .axis_style(FRAME.stroke_width(FINE))
            .x_labels(ticks)
            .y_labels(ticks)
            .x_label_formatter(&format)
            .y_label_formatter(&format)
            .x_label_style(label_style.clone())
            .y_label_style(label_style)
            .axis_desc_style((FONT, 14 * FINE).into_font().color(&INK))
            .x_desc(self.x_label.as_str())
            .y_desc(self.y_label.as_str())
            .draw()?;
        for piece in window.line(&panel.grid).split(|(x, _)| !x.is_finite()) {
            chart.draw_series(LineSeries::new(piece.iter().copied(), FRAME.stroke_width(FINE / 2)))?;
        }
        for (index, series) in panel.series.iter().enumerate() {
            let points = match series.mark {
                Mark::Line | Mark::Curve | Mark::Dashed | Mark::Steps => window.line(&series.points),
                Mark::Dots | Mark::Rings => window.dots(&series.points),
            };
            draw_series(&mut chart, index, &Series { points, ..series.clone() }, <[(f64, f64)]>::to_vec)?;
        }
        let style = (FONT, 12 * FINE).into_font().color(&INK).pos(Pos::new(HPos::Center, VPos::Center));
        chart
            .draw_series(panel.texts.iter().map(|(at, text)| Text::new(text.clone(), *at, style.clone())))?;
        Ok(())
    }
}

const PANEL_TITLE_HEIGHT: u32 = 26 * FINE;

/// What a panel shows. The drawing library moves points outside onto the border, so they are cut off before.
struct Window {
    centre: (f64, f64),
    half: f64,
}

impl Window {
    /// How far inside each of the four sides a point is.
    fn inside(&self, (x, y): (f64, f64)) -> [f64; 4] {
        let (x, y) = (x - self.centre.0, y - self.centre.1);
        [self.half - x, self.half + x, self.half - y, self.half + y]
    }

    fn dots(&self, points: &[(f64, f64)]) -> Vec<(f64, f64)> {
        points.iter().copied().filter(|point| self.inside(*point).iter().all(|side| *side >= 0.0)).collect()
    }

    /// The pieces of a line inside, with gaps between (Liang and Barsky).
    fn line(&self, points: &[(f64, f64)]) -> Vec<(f64, f64)> {
        let mut kept: Vec<(f64, f64)> = Vec::with_capacity(points.len());
        let is_finite = |(x, y): &(f64, f64)| x.is_finite() && y.is_finite();
        for pair in points.windows(2).filter(|pair| pair.iter().all(is_finite)) {
            let (a, b) = (self.inside(pair[0]), self.inside(pair[1]));
            let (mut from, mut to) = (0.0_f64, 1.0_f64);
            for (a, b) in a.into_iter().zip(b) {
                match (a >= 0.0, b >= 0.0) {
                    (true, true) => {}
                    (true, false) => to = to.min(a / (a - b)),
                    (false, true) => from = from.max(a / (a - b)),
                    (false, false) => to = -1.0,
                }
            }
            if from > to {
                continue;
            }
            let (first, last) = (between(pair[0], pair[1], from), between(pair[0], pair[1], to));
            if kept.last() != Some(&first) {
                kept.extend([(f64::NAN, f64::NAN), first]);
            }
            kept.push(last);
        }
        kept
    }

    /// The part of a polygon inside, side by side (Sutherland and Hodgman).
    fn polygon(&self, corners: &[(f64, f64)]) -> Vec<(f64, f64)> {
        (0..4).fold(corners.to_vec(), |corners, side| {
            let mut kept = Vec::with_capacity(corners.len());
            for (a, b) in corners.iter().zip(corners.iter().cycle().skip(1)) {
                let (from, to) = (self.inside(*a)[side], self.inside(*b)[side]);
                if from >= 0.0 {
                    kept.push(*a);
                }
                if (from >= 0.0) != (to >= 0.0) {
                    kept.push(between(*a, *b, from / (from - to)));
                }
            }
            kept
        })
    }
}

fn between(a: (f64, f64), b: (f64, f64), part: f64) -> (f64, f64) {
    if part == 1.0 { b } else { (a.0 + part * (b.0 - a.0), a.1 + part * (b.1 - a.1)) }
}

#[cfg(test)]
mod tests {
    //! A panel is square, what lies outside is cut off at its border, and nothing to show is an error.
    use super::*;

    #[test]
    fn a_panel_is_square_and_an_empty_picture_an_error() {
        let panel = PlanePanel { half_width: 2.0, title: "left".to_owned(), ..PlanePanel::default() };
        let chart = PlaneChart { title: "two".to_owned(), panels: vec![panel; 2], ..PlaneChart::default() };
        let svg = chart.to_svg().unwrap();
        assert!(svg.starts_with("<svg width=\"960\" ") && svg.matches("left").count() == 2);
        assert!(PlaneChart::default().to_svg().is_err());
    }

    #[test]
    fn what_lies_outside_is_cut_off_at_the_border() {
        let window = Window { centre: (1.0, 0.0), half: 1.0 };
        let line = window.line(&[
            (-1.0, 0.0),
            (1.0, 0.0),
            (1.0, 4.0),
            (3.0, 4.0),
            (f64::NAN, 0.0),
            (0.5, 0.5),
            (1.5, 0.5),
        ]);
        let finite: Vec<_> = line.iter().filter(|(x, _)| x.is_finite()).copied().collect();
        assert_eq!(finite, [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.5, 0.5), (1.5, 0.5)]);
        assert_eq!(line.len() - finite.len(), 2);
        assert_eq!(window.dots(&[(1.0, 0.5), (1.0, 1.5)]), [(1.0, 0.5)]);
        let quarter = window.polygon(&[(1.0, 0.0), (5.0, 0.0), (5.0, 5.0), (1.0, 5.0)]);
        let twice_area: f64 =
            quarter.iter().zip(quarter.iter().cycle().skip(1)).map(|(a, b)| a.0 * b.1 - a.1 * b.0).sum();
        assert!((twice_area - 2.0).abs() < 1e-12, "{quarter:?}");
        assert!(window.polygon(&[(5.0, 5.0), (6.0, 5.0), (6.0, 6.0)]).is_empty());
    }
}

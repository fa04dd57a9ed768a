//! Tornado charts: what each of several causes changes, as bars across from zero, a row a cause.

use super::{
    axes::{is_drawable, round_up},
    frame::{Axes, Frame},
    legend::Legend,
    pen::{COLOURS, Pen, width_px},
    picture::{Picture, RIGHT, TITLE_HEIGHT, WIDTH, X_AXIS_HEIGHT},
};

/// Height of a row, and the part of it that its bars take.
const ROW: f64 = 30.0;
const FILLED: f64 = 0.76;
/// Size of the names, the room about them, and what they may take at most, in px.
const NAME_SIZE: f64 = 11.0;
const ABOUT_NAME: f64 = 30.0;
const MAX_NAME: f64 = 420.0;
/// Limits with which a range without extent is drawn.
const NO_RANGE: [f64; 2] = [-1.0, 1.0];

/// Causes by what they change.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct TornadoChart {
    /// Title.
    pub title: String,
    /// Label of the horizontal axis, with its unit in brackets.
    pub x_label: String,
    /// Labels of the two bars of a row.
    pub bars: [String; 2],
    /// Names of the causes with their changes, top to bottom; one that is not finite has no bar.
    pub rows: Vec<(String, [f64; 2])>,
}

impl TornadoChart {
    /// With room on both sides.
    fn range(&self) -> [f64; 2] {
        let changes =
            || self.rows.iter().flat_map(|(_, changes)| changes).copied().filter(|it| is_drawable(*it));
        let (low, high) = (changes().fold(0.0, f64::min), changes().fold(0.0, f64::max));
        let margin = 0.06 * (high - low);
        if margin > 0.0 { [low - margin, high + margin] } else { NO_RANGE }
    }

    fn name_width(&self) -> f64 {
        let widths = self.rows.iter().map(|(name, _)| width_px(name, NAME_SIZE));
        widths.fold(0.0, f64::max).min(MAX_NAME)
    }
}

impl Picture for TornadoChart {
    fn title(&self) -> &str {
        &self.title
    }

    fn height(&self) -> Option<f64> {
        let rows = self.rows.len() as f64 * ROW;
        let height = TITLE_HEIGHT + Legend::of_names(&self.bars).height() + rows + X_AXIS_HEIGHT;
        (!self.rows.is_empty()).then_some(height)
    }

    fn draw(&self, pen: &mut Pen, top: f64) {
        let legend = Legend::of_names(&self.bars);
        legend.draw(pen, top + TITLE_HEIGHT);
        let count = self.rows.len() as f64;
        // From the bottom up, as the axis counts.
        let place = |row: usize| count - 1.0 - row as f64;
        let named = self.rows.iter().enumerate().rev();
        let names: Vec<(f64, String)> = named.map(|(row, (name, _))| (place(row), name.clone())).collect();
        let left = self.name_width() + ABOUT_NAME;
        let x = self.range();
        let frame = Frame {
            left,
            top: top + TITLE_HEIGHT + legend.height(),
            width: WIDTH - left - RIGHT,
            height: ROW * count,
            x,
            y: [-0.5, count - 0.5],
        };
        let axes = Axes {
            labels: [&self.x_label, ""],
            steps: [round_up((x[1] - x[0]) / 8.0), 1.0],
            label_px: left,
            named: [&[], &names],
            ..Axes::default()
        };
        frame.grid(pen, &axes);
        frame.axes(pen, &axes);
        let share = FILLED / self.bars.len() as f64;
        for (row, (_, changes)) in self.rows.iter().enumerate() {
            for (bar, change) in changes.iter().enumerate().filter(|(_, change)| is_drawable(**change)) {
                let upper = place(row) + 0.5 * FILLED - share * bar as f64;
                let corners = [[change.min(0.0), upper], [change.max(0.0), upper - share]];
                let [low, high] = corners.map(|corner| frame.at(corner));
                pen.rect(low, high, &format!("fill=\"{}\"", COLOURS[bar % COLOURS.len()]));
            }
        }
        frame.line(pen, &frame.y.map(|y| [0.0, y]), "stroke=\"#9aa2ac\"");
    }
}

#[cfg(test)]
mod tests {
    //! Every cause is named, and bars begin at zero.

    use super::*;

    #[test]
    fn every_cause_has_its_name_and_bars_that_begin_at_zero() {
        let row = |name: &str, changes: [f64; 2]| (name.to_owned(), changes);
        let chart = TornadoChart {
            title: "momentum".to_owned(),
            x_label: "change [N.m.s]".to_owned(),
            bars: ["- sigma", "+ sigma"].map(str::to_owned),
            rows: vec![row("large", [-4.0, 6.0]), row("small", [0.5, f64::NAN])],
        };
        let svg = crate::svg(&[&chart]).unwrap();
        for text in ["momentum", "change [N.m.s]", "- sigma", "+ sigma", ">large<", ">small<"] {
            assert!(svg.contains(text), "{text}");
        }
        let of = |key: &str, tag: &str| -> f64 {
            tag.split(&format!("{key}=\"")).nth(1).unwrap().split('"').next().unwrap().parse().unwrap()
        };
        let bars: Vec<[f64; 2]> = svg
            .split("<rect ")
            .skip(1)
            .filter(|tag| COLOURS[..2].iter().any(|colour| tag.contains(&format!("fill=\"{colour}\""))))
            .map(|tag| (of("x", tag), of("x", tag) + of(" width", tag)).into())
            .collect();
        let [minus, plus, small] = &bars[..] else { panic!("{bars:?}") };
        assert!((minus[1] - plus[0]).abs() < 0.2 && (small[0] - plus[0]).abs() < 0.2, "{bars:?}");
        let size = |bar: &[f64; 2]| bar[1] - bar[0];
        assert!(
            (size(plus) / size(minus) - 1.5).abs() < 0.01 && (size(plus) / size(small) - 12.0).abs() < 0.1
        );
        assert!(crate::svg(&[&TornadoChart::default()]).is_err());
    }
}

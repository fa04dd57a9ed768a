//! Long oscillations: where a line would only blacken the panel, its extremes are drawn as a band.

use super::axes::is_drawable;

/// Reversals in a column from which on its line cannot be distinguished.
const REVERSALS_PER_COLUMN: usize = 3;
/// Points that a reversal of an oscillation has; noise has fewer.
const POINTS_PER_REVERSAL: usize = 2;
/// Part of the panel's height that the band has at least on average; a ripple on something slower stays a line.
const HEIGHT: f64 = 0.2;
/// Reversals in the window that a mean is taken over: some ten oscillations, which the window damps to 1e-3.
const REVERSALS_OF_MEAN: f64 = 20.0;
/// Widest window as part of the line, and points of a mean.
const WIDEST: f64 = 1.0 / 12.0;
const MEANS: usize = 200;
/// Numbers of columns that are tried: of two pixels each, and of ten.
const COLUMNS: [usize; 2] = [400, 80];

/// Two edges: the extremes of a line over its columns, or any range over the same x.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Envelope {
    /// The least values.
    pub lowest: Vec<(f64, f64)>,
    /// The greatest values.
    pub greatest: Vec<(f64, f64)>,
}

impl Envelope {
    /// Around the band.
    pub(crate) fn outline(&self) -> Vec<(f64, f64)> {
        self.greatest.iter().chain(self.lowest.iter().rev()).copied().collect()
    }

    /// The parts between points at which one edge is not finite.
    pub(crate) fn pieces(&self) -> Vec<Self> {
        let mut pieces = vec![Self::default()];
        for (low, high) in self.lowest.iter().zip(&self.greatest) {
            let is_finite = [low.0, low.1, high.0, high.1].into_iter().all(is_drawable);
            match pieces.last_mut() {
                Some(piece) if is_finite => {
                    piece.lowest.push(*low);
                    piece.greatest.push(*high);
                }
                Some(piece) if piece.lowest.is_empty() => {}
                _ => pieces.push(Self::default()),
            }
        }
        pieces.retain(|piece| !piece.lowest.is_empty());
        pieces
    }
}

/// The envelope of a line that swings up and down several times in each column; `None` for any other.
pub(super) fn envelope(points: &[(f64, f64)]) -> Option<Envelope> {
    COLUMNS.into_iter().find_map(|columns| over(points, columns))
}

/// Mean of a line that swings up and down, over a window of some ten oscillations, which falls to 0 at its ends; from half a window
/// after the first point to half a window before the last.
pub(super) fn mean(points: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let (Some(first), Some(last)) = (points.first(), points.last()) else { return Vec::new() };
    let length = last.0 - first.0;
    let half = 0.5 * length * (REVERSALS_OF_MEAN / reversals(points) as f64).min(WIDEST);
    let middle = |at: usize| 0.5 * (points[at].0 + points[at + 1].0);
    let intervals: Vec<usize> = (0..points.len() - 1).collect();
    let at = |k: usize| {
        let x = first.0 + half + (length - 2.0 * half) * k as f64 / MEANS as f64;
        let begin = intervals.partition_point(|at| middle(*at) <= x - half);
        let within = intervals[begin..].iter().take_while(|at| middle(**at) < x + half);
        let (sum, weights) = within.fold((0.0, 0.0), |(sum, weights), &at| {
            let place = (middle(at) - x) / half;
            let weight = (1.0 - place * place).powi(2) * (points[at + 1].0 - points[at].0);
            (sum + weight * 0.5 * (points[at].1 + points[at + 1].1), weights + weight)
        });
        (x, sum / weights)
    };
    (0..=MEANS).map(at).collect()
}

/// How often a line turns from rising to falling or back.
fn reversals(points: &[(f64, f64)]) -> usize {
    let rises = |window: &[(f64, f64)]| (window[1].1 - window[0].1).signum();
    points.windows(3).filter(|window| rises(&window[..2]) * rises(&window[1..]) < 0.0).count()
}

fn over(points: &[(f64, f64)], columns: usize) -> Option<Envelope> {
    let (first, last) = (points.first()?.0, points.last()?.0);
    let last_column = columns as f64 - 1.0;
    let column = |x: f64| ((x - first) / (last - first) * columns as f64).floor().min(last_column);
    let mut band = Envelope { lowest: Vec::new(), greatest: Vec::new() };
    let mut dense = 0;
    for group in points.chunk_by(|a, b| column(a.0) == column(b.0)) {
        let middle = 0.5 * (group[0].0 + group[group.len() - 1].0);
        let values = || group.iter().map(|(_, y)| *y);
        band.lowest.push((middle, values().fold(f64::INFINITY, f64::min)));
        band.greatest.push((middle, values().fold(f64::NEG_INFINITY, f64::max)));
        let reversals = reversals(group);
        let is_resolved = group.len() >= POINTS_PER_REVERSAL * reversals;
        dense += usize::from(is_resolved && reversals >= REVERSALS_PER_COLUMN);
    }
    let extreme =
        |from: f64, edge: &[(f64, f64)], of: fn(f64, f64) -> f64| edge.iter().map(|(_, y)| *y).fold(from, of);
    let range =
        extreme(f64::NEG_INFINITY, &band.greatest, f64::max) - extreme(f64::INFINITY, &band.lowest, f64::min);
    let heights = band.greatest.iter().zip(&band.lowest).map(|(greatest, lowest)| greatest.1 - lowest.1);
    let is_high = heights.sum::<f64>() >= HEIGHT * range * band.lowest.len() as f64;
    // Nearly everywhere: a line with one burst of oscillation stays a line.
    (is_high && 10 * dense > 9 * band.lowest.len() && band.lowest.len() > 10).then_some(band)
}

#[cfg(test)]
mod tests {
    //! Against curves whose extremes are known.

    use super::*;

    fn line(count: u32, value: impl Fn(f64) -> f64) -> Vec<(f64, f64)> {
        (0..count).map(|k| f64::from(k) / f64::from(count)).map(|x| (x, value(x))).collect()
    }

    #[test]
    fn a_decaying_oscillation_is_drawn_by_its_extremes() {
        let drawn = envelope(&line(100_000, |x| (-x).exp() * (1e4 * x).sin())).unwrap();
        for &(x, greatest) in &drawn.greatest {
            assert!((greatest / (-x).exp() - 1.0).abs() < 0.01, "{x}: {greatest}");
        }
        for &(x, lowest) in &drawn.lowest {
            assert!((lowest / (-x).exp() + 1.0).abs() < 0.01, "{x}: {lowest}");
        }
        assert_eq!(drawn.outline().len(), 2 * drawn.lowest.len());
        // Two hundred orbits in as many hundredths of a panel.
        let slow = envelope(&line(2_000, |x| (std::f64::consts::TAU * 200.0 * x).sin())).unwrap();
        assert!(slow.greatest.iter().all(|(_, y)| (0.9..=1.0).contains(y)), "{slow:?}");
    }

    #[test]
    fn a_mean_follows_what_an_oscillation_swings_about() {
        // Sunlight that fades over the year and is cut off for a third of each of 300 orbits: its mean is known in closed form.
        let orbit = |x: f64| if (300.0 * x).fract() < 1.0 / 3.0 { 0.0 } else { 1.0 - 0.5 * x };
        let means = mean(&line(60_000, orbit));
        assert_eq!(means.len(), MEANS + 1);
        for (x, mean) in &means {
            assert!((mean - 2.0 / 3.0 * (1.0 - 0.5 * x)).abs() < 2e-3, "{x}: {mean}");
        }
        assert!(means[0].0 < 0.05 && means[MEANS].0 > 0.95, "{means:?}");
    }

    #[test]
    fn what_can_be_reported_apart_stays_a_line() {
        assert_eq!(envelope(&line(100_000, |x| (50.0 * x).sin())), None);
        assert_eq!(envelope(&line(1_000, |x| (1e4 * x).sin())), None);
        assert_eq!(envelope(&line(2_000, |x| 5.0 * x + 0.1 * (1200.0 * x).sin())), None);
        let burst = |x: f64| if (0.4..0.6).contains(&x) { (1e4 * x).sin() } else { x };
        assert_eq!(envelope(&line(100_000, burst)), None);
        assert_eq!(envelope(&[]), None);
    }
}

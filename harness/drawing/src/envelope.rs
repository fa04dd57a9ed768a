//! Long oscillations: where a line would only blacken the panel, its extremes are drawn as a band.

use super::axes::is_drawable;

/// Reversals in a column from which on its line cannot be distinguished.
const REVERSALS_PER_COLUMN: usize = 3;
/// Points that a reversal of an oscillation has; noise has fewer.
const POINTS_PER_REVERSAL: usize = 2;
/// Part of the panel's height that the band has at least on average; a ripple on something slower stays a line.
const HEIGHT: f64 = 0.2;
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
pub(super) fn of(points: &[(f64, f64)]) -> Option<Envelope> {
    COLUMNS.into_iter().find_map(|columns| over(points, columns))
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
        let rises = |window: &[(f64, f64)]| (window[1].1 - window[0].1).signum();
        let reversals =
            group.windows(3).filter(|window| rises(&window[..2]) * rises(&window[1..]) < 0.0).count();
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
        let envelope = of(&line(100_000, |x| (-x).exp() * (1e4 * x).sin())).unwrap();
        for &(x, greatest) in &envelope.greatest {
            assert!((greatest / (-x).exp() - 1.0).abs() < 0.01, "{x}: {greatest}");
        }
        for &(x, lowest) in &envelope.lowest {
            assert!((lowest / (-x).exp() + 1.0).abs() < 0.01, "{x}: {lowest}");
        }
        assert_eq!(envelope.outline().len(), 2 * envelope.lowest.len());
        // Two hundred orbits in as many hundredths of a panel.
        let slow = of(&line(2_000, |x| (std::f64::consts::TAU * 200.0 * x).sin())).unwrap();
        assert!(slow.greatest.iter().all(|(_, y)| (0.9..=1.0).contains(y)), "{slow:?}");
    }

    #[test]
    fn what_can_be_reported_apart_stays_a_line() {
        assert_eq!(of(&line(100_000, |x| (50.0 * x).sin())), None);
        assert_eq!(of(&line(1_000, |x| (1e4 * x).sin())), None);
        assert_eq!(of(&line(2_000, |x| 5.0 * x + 0.1 * (1200.0 * x).sin())), None);
        let burst = |x: f64| if (0.4..0.6).contains(&x) { (1e4 * x).sin() } else { x };
        assert_eq!(of(&line(100_000, burst)), None);
        assert_eq!(of(&[]), None);
    }
}

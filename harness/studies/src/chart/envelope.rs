//! Long oscillations: where a line would only blacken the panel, its extremes are drawn as a band.

/// Reversals in a column from which on its line cannot be told apart.
const REVERSALS_PER_COLUMN: usize = 3;

/// The extremes of a line over its columns.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Envelope {
    /// The least values.
    pub lowest: Vec<(f64, f64)>,
    /// The greatest values.
    pub greatest: Vec<(f64, f64)>,
}

impl Envelope {
    /// Around the band.
    pub fn outline(&self) -> Vec<(f64, f64)> {
        self.greatest.iter().chain(self.lowest.iter().rev()).copied().collect()
    }
}

/// The envelope of a line that swings up and down several times in each of `columns` columns; `None` for any other.
pub(super) fn of(points: &[(f64, f64)], columns: usize) -> Option<Envelope> {
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
        dense += usize::from(reversals >= REVERSALS_PER_COLUMN);
    }
    // Nearly everywhere: a line with one burst of oscillation stays a line.
    (10 * dense > 9 * band.lowest.len() && band.lowest.len() > 10).then_some(band)
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
        let envelope = of(&line(100_000, |x| (-x).exp() * (1e4 * x).sin()), 400).unwrap();
        for &(x, greatest) in &envelope.greatest {
            assert!((greatest / (-x).exp() - 1.0).abs() < 0.01, "{x}: {greatest}");
        }
        for &(x, lowest) in &envelope.lowest {
            assert!((lowest / (-x).exp() + 1.0).abs() < 0.01, "{x}: {lowest}");
        }
        assert_eq!(envelope.outline().len(), 2 * envelope.lowest.len());
    }

    #[test]
    fn what_can_be_told_apart_stays_a_line() {
        assert_eq!(of(&line(100_000, |x| (50.0 * x).sin()), 400), None);
        assert_eq!(of(&line(1_000, |x| (1e4 * x).sin()), 400), None);
        let burst = |x: f64| if (0.4..0.6).contains(&x) { (1e4 * x).sin() } else { x };
        assert_eq!(of(&line(100_000, burst), 400), None);
        assert_eq!(of(&[], 400), None);
    }
}

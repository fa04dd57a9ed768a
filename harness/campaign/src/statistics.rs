//! Statistics of time series.

/// Shares in percent that are kept of many runs.
pub const PERCENTILES: [u8; 7] = [1, 5, 25, 50, 75, 95, 99];

/// The extremes of a series.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extremes {
    /// The smallest value.
    pub min: f64,
    /// The largest.
    pub max: f64,
    /// The largest magnitude.
    pub largest: f64,
    /// When it is first reached, in s.
    pub time_of_largest_s: f64,
}

impl Default for Extremes {
    fn default() -> Self {
        Self { min: f64::INFINITY, max: f64::NEG_INFINITY, largest: -1.0, time_of_largest_s: f64::NAN }
    }
}

impl Extremes {
    /// Takes one more value.
    pub fn update(&mut self, time_s: f64, value: f64) {
        self.min = self.min.min(value);
        self.max = self.max.max(value);
        if value.abs() > self.largest {
            self.largest = value.abs();
            self.time_of_largest_s = time_s;
        }
    }
}

/// The values below which the shares of [`PERCENTILES`] lie, linearly between two values; NaN without values. Sorts them.
pub fn percentiles(values: &mut [f64]) -> [f64; PERCENTILES.len()] {
    values.sort_by(f64::total_cmp);
    let last = values.len().saturating_sub(1);
    PERCENTILES.map(|percent| {
        let Some(largest) = values.last() else { return f64::NAN };
        let place = f64::from(percent) / 100.0 * last as f64;
        let below = place.floor();
        let low = values[below as usize];
        let high = values.get(below as usize + 1).unwrap_or(largest);
        low + (high - low) * (place - below)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn extremes_are_those_of_the_series() {
        let mut extremes = Extremes::default();
        for (time_s, value) in [(0.0, 1.0), (10.0, -3.0), (20.0, 3.0), (30.0, 2.0)] {
            extremes.update(time_s, value);
        }
        assert_eq!(extremes, Extremes { min: -3.0, max: 3.0, largest: 3.0, time_of_largest_s: 10.0 });
    }

    #[test]
    fn percentiles_lie_linearly_between_values() {
        let mut values: Vec<f64> = (0..=100).rev().map(f64::from).collect();
        assert_eq!(percentiles(&mut values), [1.0, 5.0, 25.0, 50.0, 75.0, 95.0, 99.0]);
        // NumPy's percentile of [1, 2, 4, 8].
        let [first, .., median, _, _, last] = percentiles(&mut [8.0, 1.0, 4.0, 2.0]);
        approx::assert_relative_eq!(first, 1.03, max_relative = 1e-15);
        assert_eq!(median, 3.0);
        approx::assert_relative_eq!(last, 7.88, max_relative = 1e-15);
        assert_eq!(percentiles(&mut [7.0]), [7.0; 7]);
        assert!(percentiles(&mut []).iter().all(|it| it.is_nan()));
    }
}

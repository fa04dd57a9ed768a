//! Statistics of time series.

/// Shares in percent that are kept of many runs.
pub const PERCENTILES: [f64; 7] = [1.0, 5.0, 25.0, 50.0, 75.0, 95.0, 99.0];

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
}

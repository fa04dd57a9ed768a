//! Percentiles of values, linear between neighbours.
//!
//! Equation: in sorted values x_0 to x_n the percentile p is x at p n / 100, linear between the two nearest (`linear` of NumPy;
//! Hyndman and Fan, 1996, type 7).

/// Values below which these percents of all lie; NaN without values. Sorts the values.
pub fn percentiles<const N: usize>(values: &mut [f64], percents: [f64; N]) -> [f64; N] {
    values.sort_by(f64::total_cmp);
    let last = values.len().saturating_sub(1);
    percents.map(|percent| {
        let Some(largest) = values.last() else { return f64::NAN };
        let place = percent / 100.0 * last as f64;
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
    fn percentiles_lie_linearly_between_values() {
        let percents = [1.0, 5.0, 25.0, 50.0, 75.0, 95.0, 99.0];
        let mut values: Vec<f64> = (0..=100).rev().map(f64::from).collect();
        assert_eq!(percentiles(&mut values, percents), percents);
        // NumPy's percentile of [1, 2, 4, 8].
        let [first, median, last] = percentiles(&mut [8.0, 1.0, 4.0, 2.0], [1.0, 50.0, 99.0]);
        assert!((first - 1.03).abs() < 1e-15 && (last - 7.88).abs() < 1e-14, "{first} {last}");
        assert_eq!(median, 3.0);
        assert_eq!(percentiles(&mut [7.0], percents), [7.0; 7]);
        assert!(percentiles(&mut [], percents).iter().all(|it| it.is_nan()));
    }
}

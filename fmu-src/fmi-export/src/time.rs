//! When two times count as the same.

/// Whether `time_s` is `expected_s` for a step of `step_size_s`: they differ by a few roundings of the larger of the times and the
/// step, and a millionth of the step. False for anything that is not finite.
///
/// Masters compute communication points as sums, as products or from integer nanoseconds; all of these agree
/// to within this, and no real mistake does.
pub fn is_same(time_s: f64, expected_s: f64, step_size_s: f64) -> bool {
    let greatest_s = time_s.abs().max(expected_s.abs()).max(step_size_s.abs());
    (time_s - expected_s).abs() <= 16.0 * f64::EPSILON * greatest_s + 1e-6 * step_size_s.abs()
}

#[cfg(test)]
mod tests {
    //! Whatever way a master computes its communication points, they are accepted; a wrong one is not.
    use super::*;

    #[test]
    fn sums_products_and_nanoseconds_agree() {
        for rate_hz in [50.0, 60.0, 30.0, 1.0 / 60.0, 1e3] {
            let h = 1.0 / rate_hz;
            let mut internal_s = 0.1;
            for i in 0..10_000_u32 {
                let product_s = 0.1 + f64::from(i) * h;
                assert!(is_same(product_s, internal_s, h), "{rate_hz} Hz, step {i}");
                internal_s = product_s + h;
            }
        }
        let (mut nanoseconds, mut internal_s) = (0_u64, 0.0);
        for _ in 0..100_000 {
            let time_s = nanoseconds as f64 / 1e9;
            assert!(is_same(time_s, internal_s, 1.0 / 60.0));
            internal_s = time_s + 16_666_667.0 / 1e9;
            nanoseconds += 16_666_667;
        }
    }

    #[test]
    fn a_missed_step_is_no_rounding() {
        assert!(!is_same(1.0, 1.0 + 1e-4, 0.1));
        assert!(!is_same(7_776_000.0, 7_776_060.0, 60.0));
        assert!(!is_same(f64::NAN, 1.0, 0.1));
        assert!(!is_same(f64::INFINITY, f64::INFINITY, 0.1));
    }
}

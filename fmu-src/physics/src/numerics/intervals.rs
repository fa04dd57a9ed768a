//! End of an interval of time: the next multiple of a step, or the time at which something changes.

/// The first multiple of `step_s` clearly after `time_s`.
pub fn next_multiple_s(time_s: f64, step_s: f64) -> f64 {
    let count = (time_s / step_s).floor() + 1.0;
    let edge_s = count * step_s;
    // The quotient of an edge may round below its own number.
    let next_s =
        if edge_s - time_s <= 8.0 * f64::EPSILON * time_s.abs() { (count + 1.0) * step_s } else { edge_s };
    // So late that doubles are further apart than the step, each is an edge of its own.
    next_s.max(time_s.next_up())
}

/// The earliest time found at which something is no longer the same, between a time at which it is and one at which it
/// is not: the two neighbouring numbers that differ, by bisection.
pub fn first_change_s(mut same_s: f64, mut other_s: f64, mut is_same: impl FnMut(f64) -> bool) -> f64 {
    loop {
        let middle_s = 0.5 * (same_s + other_s);
        if middle_s <= same_s || middle_s >= other_s {
            return other_s;
        }
        if is_same(middle_s) {
            same_s = middle_s;
        } else {
            other_s = middle_s;
        }
    }
}

/// Intervals of [`sampled_range`].
const INTERVALS: u32 = 16;

/// Least and greatest of 17 values of `at`, evenly from 0 to 1: of what turns slowly over that range.
pub fn sampled_range(mut at: impl FnMut(f64) -> f64) -> [f64; 2] {
    let values = (0..=INTERVALS).map(|k| at(f64::from(k) / f64::from(INTERVALS)));
    values.fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], it| [least.min(it), most.max(it)])
}

#[cfg(test)]
mod tests {
    //! Edges are multiples of the step, for any time a double can count; changes are found to the last bit.
    use super::*;

    #[test]
    fn edges_follow_one_another_without_drift() {
        let step_s = 0.1;
        let mut time_s = 0.0;
        for k in 1..100_000 {
            time_s = next_multiple_s(time_s, step_s);
            assert_eq!(time_s, f64::from(k) * step_s);
        }
        assert_eq!(next_multiple_s(-0.05, 0.1), 0.0);
        assert_eq!(next_multiple_s(1e9 + 1.0, 60.0), 1_000_000_020.0);
        for time_s in [1e16, -1e18, 1e20, 1e300] {
            assert!(next_multiple_s(time_s, 600.0) > time_s, "{time_s}");
        }
    }

    #[test]
    fn a_change_is_found_to_the_last_bit() {
        for edge_s in [0.1, 123.456, 599.999_999] {
            assert_eq!(first_change_s(0.0, 600.0, |at_s| at_s < edge_s), edge_s);
        }
    }
}

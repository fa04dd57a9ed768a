//! Sign changes are found where they were built in, and short dips are not overlooked.

use nalgebra::Vector1;
use proptest::prelude::*;

use super::*;
use crate::numerics::spacing::spacing;

#[test]
fn a_function_of_nothing_but_rounding_ends_the_search() {
    let mut evaluations = 0;
    let mut noise = |at: f64| {
        evaluations += 1;
        let bits = at.to_bits().wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 40;
        Vector1::new(1e-16 * (bits as f64 / f64::from(1 << 24) - 0.5))
    };
    let samples = Segment::<1, 8>::nodes(0.0, 600.0).map(&mut noise);
    first_event([0.0, 0.0, 600.0], 0.0, &samples, &mut noise);
    assert!(evaluations <= 16 * 2 * MOST_FITS, "{evaluations}");
}

/// The first event of sin and of a dip of a thousandth of the interval, whose nodes do not see it.
#[test]
fn the_first_event_is_found_between_the_nodes_and_to_the_last_bit() {
    let (from, to) = (0.1, 1.1);
    for center in [0.35, 0.611, 0.87] {
        let values = |t: f64| {
            SVector::from([(t - 3.0).sin(), 2.0 * (2.0 * (t - center)).sin().powi(2) - 2e-6, f64::INFINITY])
        };
        let samples = Segment::<3, 8>::nodes(from, to).map(values);
        assert!(samples.iter().all(|sample| sample[1] > 0.0), "the nodes see the dip");
        let edge = first_event([from + 1e-6, from, to], 0.0, &samples, values).unwrap();
        assert!((edge - (center - 0.5e-3)).abs() < 1e-7, "{edge}");
        assert!(values(edge)[1] <= 0.0 && values(edge.next_down())[1] > 0.0);
        // From within the dip on the next event is its end.
        let samples = Segment::<3, 8>::nodes(edge, to).map(values);
        let end = first_event([edge + 1e-6, edge, to], 0.0, &samples, values).unwrap();
        assert!((end - (center + 0.5e-3)).abs() < 1e-7, "{end}");
    }
}

/// Time counted from an epoch far away is rounded to 6e-8 s.
#[test]
fn rounded_time_costs_no_halving() {
    let epoch = 3.5e8;
    let rounding = spacing(epoch);
    let mut evaluations = 0;
    let mut values = |t: f64| {
        evaluations += 1;
        let at = (t + epoch) - epoch;
        Vector1::new(1e-2 * (1e-3 * (at - 31.0)).sin() * (2.0 + (0.01 * at).cos()))
    };
    let samples = Segment::<1, 8>::nodes(0.0, 45.0).map(&mut values);
    let edge = first_event([1e-4, 0.0, 45.0], rounding, &samples, &mut values).unwrap();
    assert!((edge - 31.0).abs() <= rounding, "{edge}");
    assert!(values(edge)[0] * values(edge.next_down())[0] <= 0.0);
    assert!(evaluations < 8 + 16 + 80, "{evaluations}");
}

#[test]
fn without_an_event_only_the_samples_are_used() {
    let samples = Segment::<1, 8>::nodes(0.0, 1.0).map(|t| Vector1::new(2.0 + t.sin()));
    let found = first_event([0.0, 0.0, 1.0], 0.0, &samples, |_| panic!("evaluated"));
    assert_eq!(found, None);
}

proptest! {
    #[test]
    fn grazing_dips_are_found(center in 0.05..0.7f64, log_depth in -8.0..-1.0f64) {
        // cos(8 (t - center)) - (1 - depth) > 0 only for |t - center| < acos(1 - depth) / 8.
        let depth = 10.0_f64.powf(log_depth);
        let values = |t: f64| Vector1::new(depth - 2.0 * (4.0 * (t - center)).sin().powi(2));
        let half = (depth / 2.0).sqrt().asin() / 4.0;
        let built_in = if center > half { center - half } else { center + half };
        let samples = Segment::<1, 8>::nodes(0.0, 1.0).map(values);
        let found = first_event([0.0, 0.0, 1.0], 0.0, &samples, values).unwrap();
        prop_assert!((found - built_in).abs() < 1e-11 / half, "{} {}", found, built_in);
    }
}

#[test]
fn a_crossing_is_the_first_fall_through_zero() {
    // Rises at 1, falls at 2, rises at 4 and falls at 5.
    let function = |t: f64| -(t - 1.0) * (t - 2.0) * (t - 4.0) * (t - 5.0);
    for (start_s, end_s, expected) in [
        (0.0, 6.0, Some(2.0)),
        (1.5, 6.0, Some(2.0)),
        (2.5, 6.0, Some(5.0)),
        (2.5, 4.5, None),
        (0.0, 1.5, None),
    ] {
        let found = first_crossing(Span::new(start_s, end_s), 0.0, function);
        assert_eq!(found.is_some(), expected.is_some(), "{start_s} {end_s}: {found:?}");
        if let (Some(found), Some(expected)) = (found, expected) {
            assert!((found - expected).abs() < 1e-12, "{found} {expected}");
        }
    }
}

#[test]
fn a_short_passage_within_a_sphere_is_found() {
    // A straight path 1 m within the edge of a sphere of 1e8 m, in a span of a day.
    let radius_m = 1e8_f64;
    let across_m = radius_m - 1.0;
    let along_m = |t: f64| 1e4 * (t - 43_210.0);
    let outside = |t: f64| across_m * across_m + along_m(t) * along_m(t) - radius_m * radius_m;
    let found = first_crossing(Span::new(0.0, 86_400.0), 1.2e-7, outside).unwrap();
    let expected_s = 43_210.0 - (radius_m * radius_m - across_m * across_m).sqrt() / 1e4;
    assert!((found - expected_s).abs() < 1e-6, "{found} {expected_s}");
    assert_eq!(first_crossing(Span::new(44_000.0, 86_400.0), 1.2e-7, outside), None);
}

//! A segment reproduces every polynomial up to its degree, its derivative and its integral, and finds all roots.

use nalgebra::{Vector1, Vector2};
use proptest::prelude::*;

use super::*;

fn horner(c: &[f64], x: f64) -> f64 {
    c.iter().rev().fold(0.0, |sum, c| sum * x + c)
}

#[test]
fn reproduces_polynomials_derivative_and_integral() {
    // p = 3 - x + 2 x^2 - x^5/7 in x = t - 9, primitives written out by hand.
    let p = |t: f64| 3.0 - (t - 9.0) + 2.0 * (t - 9.0).powi(2) - (t - 9.0).powi(5) / 7.0;
    let derivative = |t: f64| -1.0 + 4.0 * (t - 9.0) - 5.0 * (t - 9.0).powi(4) / 7.0;
    let primitive = |t: f64| {
        let x = t - 9.0;
        3.0 * x - x * x / 2.0 + 2.0 * x.powi(3) / 3.0 - x.powi(6) / 42.0
    };
    let segment = Segment::<2, 6>::fit(7.5, 12.0, |t| Vector2::new(p(t), 1.0));
    let integral: Segment<2, 7> = segment.integral(Vector2::new(primitive(7.5), 4.0));
    for i in 0..=50 {
        let t = 7.5 + 4.5 * f64::from(i) / 50.0;
        let (value, rate) = segment.value_and_derivative(t);
        assert!((value - Vector2::new(p(t), 1.0)).norm() < 1e-12);
        assert!((rate - Vector2::new(derivative(t), 0.0)).norm() < 1e-11);
        assert!((segment.value(t) - value).norm() < 1e-13);
        assert!((integral.value(t) - Vector2::new(primitive(t), 4.0 + t - 7.5)).norm() < 1e-12);
    }
    assert_eq!((segment.start(), segment.end()), (7.5, 12.0));
}

#[test]
fn nodes_are_cosines_to_the_last_place() {
    fn largest_error<const N: usize>() -> f64 {
        let error = |(j, node): (usize, f64)| (node - (PI * (j as f64 + 0.5) / N as f64).cos()).abs();
        Segment::<1, N>::nodes(-1.0, 1.0).into_iter().enumerate().map(error).fold(0.0, f64::max)
    }
    let errors = [largest_error::<2>(), largest_error::<8>(), largest_error::<12>(), largest_error::<256>()];
    assert!(errors.iter().all(|error| *error <= 0.5 * f64::EPSILON), "{errors:?}");
    // Zero itself, which the cosine of the rounded angle is not.
    assert_eq!(Segment::<1, 13>::nodes(-1.0, 1.0)[6], 0.0);
}

#[test]
fn error_of_a_sine_is_below_the_interpolation_bound() {
    // Interpolation at Chebyshev nodes: |error| <= h^N / (2^(N-1) N!) with half length h, derivatives within 1.
    let segment = Segment::<1, 12>::fit(-1.0, 1.0, |t| Vector1::new(t.sin()));
    let bound = 1.0 / (2048.0 * 479_001_600.0) + 5e-16;
    for i in 0..=200 {
        let t = -1.0 + f64::from(i) / 100.0;
        assert!((segment.value(t)[0] - t.sin()).abs() < bound);
    }
}

#[test]
fn ends_are_met_between_polynomials_and_nodes_kept() {
    // A polynomial of degree 10 is found from 7 nodes, values and slopes at the ends; of a sine both ends are met.
    let p = |t: f64| 2.0 - 3.0 * (t - 4.0) + (t - 4.0).powi(7) / 9.0 - (t - 4.0).powi(10) / 50.0;
    let slope = |t: f64| -3.0 + 7.0 * (t - 4.0).powi(6) / 9.0 - (t - 4.0).powi(9) / 5.0;
    let ends = [2.5, 5.0].map(|t| [p, slope].map(|f| Vector1::new(f(t))));
    let found: Segment<1, 11> = Segment::<1, 7>::fit(2.5, 5.0, |t| Vector1::new(p(t))).with_ends(&ends);
    for i in 0..=50 {
        let t = 2.5 + 2.5 * f64::from(i) / 50.0;
        let (value, rate) = found.value_and_derivative(t);
        assert!((value[0] - p(t)).abs() < 1e-12 && (rate[0] - slope(t)).abs() < 1e-11);
    }
    let within = Segment::<1, 8>::fit(0.0, 2.0, |t| Vector1::new(t.sin()));
    let ends = [[0.0, 1.0], [0.9, -0.4]].map(|end| end.map(Vector1::new));
    let found: Segment<1, 12> = within.with_ends(&ends);
    for (t, [value, rate]) in [0.0, 2.0].into_iter().zip(ends) {
        let at = found.value_and_derivative(t);
        assert!((at.0 - value).norm() < 1e-14 && (at.1 - rate).norm() < 1e-12);
    }
    for node in Segment::<1, 8>::nodes(0.0, 2.0) {
        assert!((found.value(node) - within.value(node)).norm() < 1e-14);
    }
}

#[test]
fn survives_serialisation_to_the_bit() {
    let segment = Segment::<3, 9>::fit(0.0, 3.0, |t| nalgebra::Vector3::new(t.exp(), t.sin(), t * t));
    let text = toml::to_string(&segment).unwrap();
    assert_eq!(toml::from_str::<Segment<3, 9>>(&text).unwrap(), segment);
}

#[test]
fn finds_a_close_pair_and_ignores_a_touch() {
    let pair = Segment::<1, 8>::fit(0.0, 1.0, |t| Vector1::new((t - 0.3) * (t - 0.3001) * (t + 2.0)));
    let found: Vec<f64> = pair.sign_changes(0.0, 1.0).iter().collect();
    assert_eq!(found.len(), 2);
    assert!((found[0] - 0.3).abs() < 1e-10 && (found[1] - 0.3001).abs() < 1e-10);
    let touch = Segment::<1, 8>::fit(0.0, 1.0, |t| Vector1::new((t - 0.3) * (t - 0.3) + 1e-9));
    assert!(touch.sign_changes(0.0, 1.0).is_empty());
}

#[test]
fn interval_ends_belong_to_the_later_side() {
    let line = Segment::<1, 4>::fit(0.0, 4.0, |t| Vector1::new(t - 2.0));
    assert_eq!(line.sign_changes(0.0, 4.0).iter().count(), 1);
    assert_eq!(line.sign_changes(2.0 + 1e-9, 4.0).iter().count(), 0);
    assert_eq!(line.sign_changes(0.0, 2.0 - 1e-9).iter().count(), 0);
}

proptest! {
    #[test]
    fn bernstein_form_is_the_same_polynomial(c in prop::array::uniform9(-1.0..1.0f64), u in 0.0..1.0f64) {
        let bernstein = bernstein_from_chebyshev(&c);
        let series = Segment::<1, 9> {
            center: 0.5,
            half_length: 0.5,
            coefficients: SMatrix::from_row_slice(&c),
        };
        let mut binomial = 1.0;
        let mut value = 0.0;
        for (i, b) in bernstein.iter().enumerate() {
            value += b * binomial * u.powi(i as i32) * (1.0 - u).powi(8 - i as i32);
            binomial *= (8 - i) as f64 / (i + 1) as f64;
        }
        prop_assert!((value - series.value(u)[0]).abs() < 1e-11);
    }

    #[test]
    fn all_constructed_roots_are_found(mut at in prop::collection::vec(0.01..0.99f64, 1..6)) {
        at.sort_by(f64::total_cmp);
        prop_assume!(at.windows(2).all(|w| w[1] - w[0] > 1e-3));
        let mut c = vec![1.0];
        for root in &at {
            let mut next = vec![0.0; c.len() + 1];
            for (i, v) in c.iter().enumerate() {
                next[i + 1] += v;
                next[i] -= root * v;
            }
            c = next;
        }
        let segment = Segment::<1, 7>::fit(0.0, 1.0, |t| Vector1::new(horner(&c, t)));
        let found = segment.sign_changes(0.0, 1.0);
        prop_assert_eq!(found.iter().count(), at.len());
        for (f, a) in found.iter().zip(&at) {
            // Coefficients are rounded: a root moves by 1e-16 over the slope there.
            let slope: f64 = at.iter().filter(|b| *b != a).map(|b| (a - b).abs()).product();
            prop_assert!((f - a).abs() < 1e-14 / slope + 1e-13);
        }
    }
}

//! Kepler's equation against a Bessel series, against bisection, and against integrating dM/dE.

use proptest::prelude::*;

use super::*;
use crate::numerics::{quadrature::Rule, roots};

fn eccentric(mean_anomaly_rad: f64, e: f64) -> Anomaly {
    eccentric_anomaly(mean_anomaly_rad, e, 1.0 - e)
}

fn hyperbolic(mean_anomaly_rad: f64, e: f64) -> f64 {
    hyperbolic_anomaly(mean_anomaly_rad, e, e - 1.0).angle_rad
}

/// Bessel's J_n by its integral representation, trapezoid on a period (spectrally exact).
fn bessel(n: f64, x: f64) -> f64 {
    (0..200).map(|k| PI * (f64::from(k) + 0.5) / 200.0).map(|t| (n * t - x * t.sin()).cos()).sum::<f64>()
        / 200.0
}

#[test]
fn fourier_bessel_series() {
    // E = M + sum (2/n) J_n(n e) sin(n M), which never uses the equation's inverse.
    for e in [0.01, 0.2056, 0.45] {
        for i in 1..20 {
            let m = f64::from(i) * 0.31;
            let series =
                (1..120).map(f64::from).fold(m, |sum, n| sum + 2.0 / n * bessel(n, n * e) * (n * m).sin());
            assert!((eccentric(m, e).angle_rad - series).abs() < 1e-13, "e {e} M {m}");
        }
    }
}

#[test]
fn zero_and_whole_turns() {
    for turns in -3..=3 {
        let m = f64::from(turns) * TAU;
        assert!((eccentric(m, 0.7).angle_rad - m).abs() < 4e-15);
        let half = m + PI;
        assert!((eccentric(half, 0.7).angle_rad - half).abs() < 4e-15);
    }
    assert_eq!(hyperbolic(0.0, 1.5), 0.0);
}

proptest! {
    #[test]
    fn residual_is_rounding(m in -50.0..50.0f64, e in 0.0..0.99f64) {
        let anomaly = eccentric(m, e).angle_rad;
        prop_assert!((anomaly - e * anomaly.sin() - m).abs() < 4e-15 + 1e-15 * m.abs());
    }

    #[test]
    fn anomalies_are_exact_near_a_parabola(log_gap in -15.0..-1.0f64, log_m in -12.0..0.4f64) {
        // Barker's equation and what is next to it: M = gap E + e E^3 / 6 less e E^5 / 120, or more, and so on.
        let (gap, angle) = (10.0_f64.powf(log_gap), 10.0_f64.powf(log_m));
        for sign in [-1.0, 1.0] {
            let e = 1.0 + sign * gap;
            let (mut term, mut rest) = (angle, 0.0);
            for k in 1..30 {
                let k = f64::from(k);
                term *= sign * angle * angle / (2.0 * k * (2.0 * k + 1.0));
                rest += sign * term;
            }
            let m = gap * angle + e * rest;
            let found = match sign < 0.0 {
                true => eccentric_anomaly(m, e, gap),
                false => hyperbolic_anomaly(m, e, gap),
            };
            prop_assert!((found.angle_rad / angle - 1.0).abs() < 4e-15, "{sign} {:e}", found.angle_rad / angle - 1.0);
        }
    }

    #[test]
    fn agrees_with_bisection(m in 0.0..PI, e in 0.0..0.95f64) {
        let root = roots::bracketed(-0.1, PI + 0.1, |x| x - e * x.sin() - m).unwrap();
        prop_assert!((eccentric(m, e).angle_rad - root).abs() < 1e-14 / (1.0 - e));
    }

    #[test]
    fn hyperbolic_against_quadrature(h in 0.001..6.0f64, e in 1.01..8.0f64) {
        // M = integral of (e cosh - 1).
        let rule = Rule::<20>::gauss_legendre();
        let m = rule.integrate(0.0, h, |x| e * x.cosh() - 1.0);
        prop_assert!((hyperbolic(m, e) / h - 1.0).abs() < 1e-11);
        prop_assert!((hyperbolic(-m, e) / -h - 1.0).abs() < 1e-11);
    }

    #[test]
    fn hyperbolic_extremes_converge(log_m in -12.0..60.0f64, log_e in -6.0..4.0f64) {
        let (m, e) = (10.0_f64.powf(log_m), 1.0 + 10.0_f64.powf(log_e));
        let h = hyperbolic(m, e);
        let slope = e * h.cosh() - 1.0;
        prop_assert!((e * h.sinh() - h - m).abs() < 1e-14 * (slope * h.abs() + m + h), "h {h}");
    }
}

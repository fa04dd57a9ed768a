//! Kepler's equation, elliptic and hyperbolic, solved to the last bits.

use core::f64::consts::{PI, TAU};

/// Eccentric anomaly E of `M = E - e sin E` for `0 <= e < 1`, in rad, on the same revolution as M.
///
/// Markley's method (Celestial Mechanics 63, 1995): a cubic start and one correction of fifth order, no iteration.
/// The residual of Kepler's equation stays below 4e-15 + 1e-15 |M| with any good sine and cosine (tested for e up to 0.99).
pub fn eccentric_anomaly_rad(mean_anomaly_rad: f64, eccentricity: f64) -> f64 {
    let e = eccentricity;
    let turns = (mean_anomaly_rad / TAU).round();
    let m = mean_anomaly_rad - turns * TAU;
    if m == 0.0 {
        return mean_anomaly_rad;
    }
    let alpha = (3.0 * PI * PI + 1.6 * PI * (PI - m.abs()) / (1.0 + e)) / (PI * PI - 6.0);
    let d = 3.0 * (1.0 - e) + alpha * e;
    let q = 2.0 * alpha * d * (1.0 - e) - m * m;
    let r = 3.0 * alpha * d * (d - 1.0 + e) * m + m * m * m;
    let cube_root = (r.abs() + (q * q * q + r * r).max(0.0).sqrt()).cbrt();
    let w = cube_root * cube_root;
    let start = (2.0 * r * w / (w * w + w * q + q * q) + m) / d;
    let (sin, cos) = start.sin_cos();
    let f0 = start - e * sin - m;
    let f1 = 1.0 - e * cos;
    let (f2, f3) = (e * sin, e * cos);
    let d3 = -f0 / (f1 - 0.5 * f0 * f2 / f1);
    let d4 = -f0 / (f1 + 0.5 * d3 * f2 + d3 * d3 * f3 / 6.0);
    let d5 = -f0 / (f1 + 0.5 * d4 * f2 + d4 * d4 * f3 / 6.0 - d4 * d4 * d4 * f2 / 24.0);
    start + d5 + turns * TAU
}

/// Hyperbolic anomaly H of `M = e sinh H - H` for `e > 1`.
///
/// Halley's iteration from a start above the root, where it falls monotonically; 3 to 8 rounds.
pub fn hyperbolic_anomaly(mean_anomaly_rad: f64, eccentricity: f64) -> f64 {
    let (e, m) = (eccentricity, mean_anomaly_rad.abs());
    if m == 0.0 || !m.is_finite() {
        return mean_anomaly_rad;
    }
    // e sinh H - H >= (e - 1) H + e H^3 / 6 >= each term alone, and sinh H >= M / e.
    let mut h = (m / (e - 1.0)).min((6.0 * m / e).cbrt()).min((2.0 * m / e + 2.0).ln() + 1.0);
    h = h.max(libm::asinh(m / e));
    for _ in 0..60 {
        let (f2, f3) = (e * h.sinh(), e * h.cosh());
        let (f0, f1) = (f2 - h - m, f3 - 1.0);
        let change = -f0 / (f1 - 0.5 * f0 * f2 / f1);
        h += change;
        if change.abs() <= 4e-16 * h.abs() {
            break;
        }
    }
    h.copysign(mean_anomaly_rad)
}

#[cfg(test)]
mod tests {
    //! Kepler's equation against a Bessel series, against bisection, and against integrating dM/dE.

    use proptest::prelude::*;

    use super::*;
    use crate::numerics::{quadrature::Rule, roots};

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
                let series = (1..120)
                    .map(f64::from)
                    .fold(m, |sum, n| sum + 2.0 / n * bessel(n, n * e) * (n * m).sin());
                assert!((eccentric_anomaly_rad(m, e) - series).abs() < 1e-13, "e {e} M {m}");
            }
        }
    }

    #[test]
    fn zero_and_whole_turns() {
        for turns in -3..=3 {
            let m = f64::from(turns) * TAU;
            assert!((eccentric_anomaly_rad(m, 0.7) - m).abs() < 4e-15);
            let half = m + PI;
            assert!((eccentric_anomaly_rad(half, 0.7) - half).abs() < 4e-15);
        }
        assert_eq!(hyperbolic_anomaly(0.0, 1.5), 0.0);
    }

    proptest! {
        #[test]
        fn residual_is_rounding(m in -50.0..50.0f64, e in 0.0..0.99f64) {
            let anomaly = eccentric_anomaly_rad(m, e);
            prop_assert!((anomaly - e * anomaly.sin() - m).abs() < 4e-15 + 1e-15 * m.abs());
        }

        #[test]
        fn agrees_with_bisection(m in 0.0..PI, e in 0.0..0.95f64) {
            let root = roots::bracketed(-0.1, PI + 0.1, 0.0, |x| x - e * x.sin() - m).unwrap();
            prop_assert!((eccentric_anomaly_rad(m, e) - root).abs() < 1e-14 / (1.0 - e));
        }

        #[test]
        fn hyperbolic_against_quadrature(h in 0.001..6.0f64, e in 1.01..8.0f64) {
            // M = integral of (e cosh - 1).
            let rule = Rule::<20>::gauss_legendre();
            let m = rule.integrate(0.0, h, |x| e * x.cosh() - 1.0);
            prop_assert!((hyperbolic_anomaly(m, e) / h - 1.0).abs() < 1e-11);
            prop_assert!((hyperbolic_anomaly(-m, e) / -h - 1.0).abs() < 1e-11);
        }

        #[test]
        fn hyperbolic_extremes_converge(log_m in -12.0..60.0f64, log_e in -6.0..4.0f64) {
            let (m, e) = (10.0_f64.powf(log_m), 1.0 + 10.0_f64.powf(log_e));
            let h = hyperbolic_anomaly(m, e);
            let slope = e * h.cosh() - 1.0;
            prop_assert!((e * h.sinh() - h - m).abs() < 1e-14 * (slope * h.abs() + m + h), "h {h}");
        }
    }
}

//! Kepler's equation, elliptic and hyperbolic, solved to the last bits.

use core::f64::consts::{PI, TAU};

use crate::math;

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
    let cube_root = math::cbrt(r.abs() + (q * q * q + r * r).max(0.0).sqrt());
    let w = cube_root * cube_root;
    let start = (2.0 * r * w / (w * w + w * q + q * q) + m) / d;
    let (sin, cos) = math::sin_cos(start);
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
    let mut h = (m / (e - 1.0)).min(math::cbrt(6.0 * m / e)).min(math::ln(2.0 * m / e + 2.0) + 1.0);
    h = h.max(math::asinh(m / e));
    for _ in 0..60 {
        let (f2, f3) = (e * math::sinh(h), e * math::cosh(h));
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
mod tests;

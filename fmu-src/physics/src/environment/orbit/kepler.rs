//! Kepler's equation, elliptic and hyperbolic, solved to the last bits.

use core::f64::consts::{PI, TAU};

use crate::math;

/// An eccentric anomaly, in rad, with its sine and cosine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EccentricAnomaly {
    /// In rad.
    pub angle_rad: f64,
    /// Its sine.
    pub sin: f64,
    /// Its cosine.
    pub cos: f64,
}

/// Eccentric anomaly E of `M = E - e sin E` for `0 <= e < 1`, on the same revolution as M.
///
/// Markley's method (Celestial Mechanics 63, 1995): a cubic start and one correction of fifth order, no iteration.
/// The residual of Kepler's equation stays below 4e-15 + 1e-15 |M| with any good sine and cosine (tested for e up to 0.99).
pub fn eccentric_anomaly(mean_anomaly_rad: f64, eccentricity: f64) -> EccentricAnomaly {
    let e = eccentricity;
    let turns = math::nearest_integer(mean_anomaly_rad * (1.0 / TAU));
    let m = mean_anomaly_rad - turns * TAU;
    if m == 0.0 {
        return EccentricAnomaly { angle_rad: mean_anomaly_rad, sin: 0.0, cos: 1.0 };
    }
    let alpha = (3.0 * PI * PI + 1.6 * PI * (PI - m.abs()) * (1.0 / (1.0 + e))) * (1.0 / (PI * PI - 6.0));
    let d = 3.0 * (1.0 - e) + alpha * e;
    let q = 2.0 * alpha * d * (1.0 - e) - m * m;
    let r = 3.0 * alpha * d * (d - 1.0 + e) * m + m * m * m;
    let cube_root = math::cbrt_approximate(r.abs() + (q * q * q + r * r).max(0.0).sqrt());
    let w = cube_root * cube_root;
    let divisor = w * w + w * q + q * q;
    let start = (2.0 * r * w + m * divisor) / (divisor * d);
    let (sin, cos) = math::sin_cos(start);
    let f0 = start - e * sin - m;
    let f1 = 1.0 - e * cos;
    let (f2, f3) = (e * sin, e * cos);
    let d3 = -f0 / (f1 - 0.5 * f0 * f2 / f1);
    let (f3, f4) = (f3 * (1.0 / 6.0), f2 * (1.0 / 24.0));
    let d4 = -f0 / (f1 + d3 * (0.5 * f2 + d3 * f3));
    let d5 = -f0 / (f1 + d4 * (0.5 * f2 + d4 * (f3 - d4 * f4)));
    let [sin, cos] = turned([sin, cos], d5);
    EccentricAnomaly { angle_rad: start + d5 + turns * TAU, sin, cos }
}

/// Sine and cosine after a small increment of the angle, in rad; exact to rounding below 0.01 rad.
fn turned([sin, cos]: [f64; 2], by_rad: f64) -> [f64; 2] {
    let square = by_rad * by_rad;
    let by_sin = by_rad * (1.0 - square * (1.0 / 6.0 - square * (1.0 / 120.0 - square * (1.0 / 5040.0))));
    let less_cos = square * (0.5 - square * (1.0 / 24.0 - square * (1.0 / 720.0)));
    [sin + (cos * by_sin - sin * less_cos), cos - (sin * by_sin + cos * less_cos)]
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

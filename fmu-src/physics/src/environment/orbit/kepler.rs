//! Kepler's equation, elliptic and hyperbolic, solved to the last bits for every eccentricity but 1.
//!
//! Equation: M = E - e sin E and M = e sinh H - H. Both are evaluated as gap E + e (E - sin E), gap = |1 - e|, and slopes as gap +
//! e (1 - cos E): sums of positive terms, each exact to rounding, where the plain differences lose all digits near periapsis of
//! an orbit that is nearly a parabola.
//! Error measure: relative to the anomaly, some units in the last place (tested for gaps down to 1e-15).

use core::f64::consts::{PI, TAU};

use crate::math;

/// Eccentric or hyperbolic anomaly, in rad, with its circular or hyperbolic functions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Anomaly {
    /// In rad.
    pub angle_rad: f64,
    /// Sine, or hyperbolic sine.
    pub sin: f64,
    /// Cosine, or hyperbolic cosine.
    pub cos: f64,
    /// 1 less the cosine, or the hyperbolic cosine less 1.
    pub versed: f64,
}

impl Anomaly {
    /// At periapsis.
    const fn periapsis(angle_rad: f64) -> Self {
        Self { angle_rad, sin: 0.0, cos: 1.0, versed: 0.0 }
    }

    /// Eccentric anomaly with its functions.
    pub fn eccentric(angle_rad: f64) -> Self {
        let (sin, cos) = math::sin_cos(angle_rad);
        Self { angle_rad, sin, cos, versed: versed(sin, cos) }
    }

    /// Hyperbolic anomaly with its functions.
    pub fn hyperbolic(angle_rad: f64) -> Self {
        let (sin, cos) = (math::sinh(angle_rad), math::cosh(angle_rad));
        let versed = if angle_rad.abs() < 1.0 { sin * sin / (1.0 + cos) } else { cos - 1.0 };
        Self { angle_rad, sin, cos, versed }
    }

    /// Mean anomaly in rad on an ellipse, `gap` being 1 - e.
    pub fn mean_elliptic_rad(&self, e: f64, gap: f64) -> f64 {
        gap * self.angle_rad + e * less_sine(self.angle_rad, self.sin)
    }

    /// Mean anomaly in rad on a hyperbola, `gap` being e - 1.
    pub fn mean_hyperbolic_rad(&self, e: f64, gap: f64) -> f64 {
        gap * self.angle_rad + e * sinh_less(self.angle_rad, self.sin)
    }
}

/// 1 - cos x, exact to rounding.
fn versed(sin: f64, cos: f64) -> f64 {
    if cos > 0.0 { sin * sin / (1.0 + cos) } else { 1.0 - cos }
}

/// x - sin x, exact to rounding.
fn less_sine(x: f64, sin: f64) -> f64 {
    if x.abs() < 1.0 { cubic_remainder(x, -x * x) } else { x - sin }
}

/// sinh x - x, exact to rounding.
fn sinh_less(x: f64, sinh: f64) -> f64 {
    if x.abs() < 1.0 { cubic_remainder(x, x * x) } else { sinh - x }
}

/// Series x^3 / 3! + x^3 y / 5! + x^3 y^2 / 7! and so on, of x - sin x with y = -x^2 and of sinh x - x with y = x^2, |x| < 1.
fn cubic_remainder(x: f64, y: f64) -> f64 {
    /// One over the product of each two neighbours, (2 k + 2) (2 k + 3).
    const RATIOS: [f64; 7] =
        [1.0 / 272.0, 1.0 / 210.0, 1.0 / 156.0, 1.0 / 110.0, 1.0 / 72.0, 1.0 / 42.0, 1.0 / 20.0];
    let sum = RATIOS.iter().fold(1.0, |sum, ratio| 1.0 + y * ratio * sum);
    x * x * x * (1.0 / 6.0) * sum
}

/// Eccentric anomaly E of `M = E - e sin E` for `0 <= e < 1`, on the same revolution as M; `gap` is 1 - e, which near 1 may be known
/// to more digits than e tells.
///
/// Markley's method (Celestial Mechanics 63, 1995): a cubic start, within 3e-4 of E, and one correction of fifth order, no
/// iteration.
pub fn eccentric_anomaly(mean_anomaly_rad: f64, eccentricity: f64, gap: f64) -> Anomaly {
    let e = eccentricity;
    let turns = math::nearest_integer(mean_anomaly_rad * (1.0 / TAU));
    let m = mean_anomaly_rad - turns * TAU;
    if m == 0.0 {
        return Anomaly::periapsis(mean_anomaly_rad);
    }
    let alpha = (3.0 * PI * PI + 1.6 * PI * (PI - m.abs()) * (1.0 / (1.0 + e))) * (1.0 / (PI * PI - 6.0));
    let d = 3.0 * gap + alpha * e;
    let q = 2.0 * alpha * d * gap - m * m;
    let r = 3.0 * alpha * d * (d - gap) * m + m * m * m;
    let cube_root = math::cbrt_approximate(r.abs() + (q * q * q + r * r).max(0.0).sqrt());
    let w = cube_root * cube_root;
    let divisor = w * w + w * q + q * q;
    let start = (2.0 * r * w + m * divisor) / (divisor * d);
    let anomaly = Anomaly::eccentric(start);
    let f0 = anomaly.mean_elliptic_rad(e, gap) - m;
    let f1 = gap + e * anomaly.versed;
    let (f2, f3) = (e * anomaly.sin, e * anomaly.cos);
    let d3 = -f0 / (f1 - 0.5 * f0 * f2 / f1);
    let (f3, f4) = (f3 * (1.0 / 6.0), f2 * (1.0 / 24.0));
    let d4 = -f0 / (f1 + d3 * (0.5 * f2 + d3 * f3));
    let d5 = -f0 / (f1 + d4 * (0.5 * f2 + d4 * (f3 - d4 * f4)));
    let [sin, cos] = turned([anomaly.sin, anomaly.cos], d5);
    Anomaly { angle_rad: start + d5 + turns * TAU, sin, cos, versed: versed(sin, cos) }
}

/// Sine and cosine after a small increment of the angle, in rad; exact to rounding below 0.01 rad.
fn turned([sin, cos]: [f64; 2], by_rad: f64) -> [f64; 2] {
    let square = by_rad * by_rad;
    let by_sin = by_rad * (1.0 - square * (1.0 / 6.0 - square * (1.0 / 120.0 - square * (1.0 / 5040.0))));
    let less_cos = square * (0.5 - square * (1.0 / 24.0 - square * (1.0 / 720.0)));
    [sin + (cos * by_sin - sin * less_cos), cos - (sin * by_sin + cos * less_cos)]
}

/// Hyperbolic anomaly H of `M = e sinh H - H` for `e > 1`; `gap` is e - 1, which near 1 may be known to more digits than e tells.
///
/// Halley's iteration from a start above the root, where it falls monotonically; 2 to 7 rounds.
pub fn hyperbolic_anomaly(mean_anomaly_rad: f64, eccentricity: f64, gap: f64) -> Anomaly {
    let (e, m) = (eccentricity, mean_anomaly_rad.abs());
    if m == 0.0 || !m.is_finite() {
        return Anomaly::periapsis(mean_anomaly_rad);
    }
    // e sinh H - H >= (e - 1) H + e H^3 / 6 >= each term alone, and sinh H >= M / e.
    let mut h = (m / gap).min(math::cbrt(6.0 * m / e)).min(math::ln(2.0 * m / e + 2.0) + 1.0);
    h = h.max(math::asinh(m / e));
    for _ in 0..60 {
        let anomaly = Anomaly::hyperbolic(h);
        let (f0, f1) = (anomaly.mean_hyperbolic_rad(e, gap) - m, gap + e * anomaly.versed);
        let change = -f0 / (f1 - 0.5 * f0 * e * anomaly.sin / f1);
        h += change;
        // The error after a round is no more than the cube of the change.
        if change.abs() <= 1e-6 * h.abs() {
            break;
        }
    }
    Anomaly::hyperbolic(h.copysign(mean_anomaly_rad))
}

#[cfg(test)]
mod tests;

//! Surface points by their lighting: the subsolar point, and the one of best lighting and viewing (eqs 17 to 19).
//!
//! Optimal lighting maximises F = cos(incidence) cos(emission) on a sphere of `radii[0]`. The point lies in the plane of
//! nadir and subsolar point, at the angle beta from nadir; alpha is the angle between both at the planet's centre, r the
//! spacecraft's distance and q = R/r: F = cos(alpha - beta) (cos beta - q) / sqrt(1 + q^2 - 2 q cos beta). The search keeps to
//! the arc that is seen and lit, max(0, alpha - 90 deg) to min(alpha, acos q), where F has one maximum (beyond it the printed
//! eqs have a spurious one). Golden section brackets it, Newton on F' finishes, kept inside the bracket by bisection. Where
//! no seen point is lit the best is the limb, F = 0.
//!
//! The rate of beta follows from F'(beta, alpha, r) = 0 by one Newton step in moving numbers.

use nalgebra::ComplexField;
use serde::{Deserialize, Serialize};

use super::ephemeris_at_time::EphemerisAtTime;
use super::moving::{Moving, MovingVector, unit, unit_normal};
use super::planet_point::radius_m;
use crate::enumeration::enumeration;
use crate::math;
use crate::numerics::golden_section::{Bracket, golden_section};
use crate::numerics::scalar::{Scalar, sin_cos};

enumeration! {
    /// What the subsolar point of an ellipsoid is.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
    pub enum SubsolarMethod {
        /// Where the line from the planet's centre to the Sun leaves it.
        #[default]
        1 => Line,
        /// Where its normal points at the Sun.
        2 => Normal,
    }
}

/// Subsolar point from the planet's centre, EME2000, in m.
pub fn subsolar_m(ephemeris: &EphemerisAtTime, method: SubsolarMethod) -> Option<MovingVector> {
    let planet_from_inertial = ephemeris.planet.planet_from_inertial(ephemeris.epoch_s);
    let radii_m = &ephemeris.planet.radii_m;
    let sun = unit(&(planet_from_inertial * ephemeris.sun))?;
    let point = match method {
        SubsolarMethod::Line => sun * radius_m(radii_m, &sun),
        SubsolarMethod::Normal => {
            let scaled = sun.zip_map(radii_m, |component, radius_m| component * radius_m);
            unit(&scaled)?.zip_map(radii_m, |component, radius_m| component * radius_m)
        }
    };
    Some(planet_from_inertial.tr_mul(&point))
}

/// Surface point of optimal lighting from the planet's centre, EME2000, in m; `None` inside the planet.
pub fn optimal_lighting_m(ephemeris: &EphemerisAtTime) -> Option<MovingVector> {
    let sphere_m = ephemeris.planet.radii_m.x;
    let (up, sun) = (unit(&ephemeris.position)?, unit(&ephemeris.sun)?);
    let distance_m = ephemeris.position.dot(&up);
    if !(sphere_m > 0.0 && sphere_m < distance_m.re) {
        return None;
    }
    let ratio = Moving::from_re(sphere_m) / distance_m;
    // The horizontal direction of the Sun, and the Sun's angle from nadir; in line with both the nadir is as good as any.
    let Some(toward_sun) = unit_normal(&up, &sun).map(|normal| normal.cross(&up)) else {
        return Some(up * Moving::from_re(sphere_m));
    };
    let alpha_rad = Moving::polar_angle(sun.dot(&toward_sun), sun.dot(&up));
    let beta_rad = nadir_angle_rad(alpha_rad, ratio);
    let (sine, cosine) = sin_cos(beta_rad);
    Some((up * cosine + toward_sun * sine) * Moving::from_re(sphere_m))
}

/// Angle at the planet's centre from nadir to the best point.
fn nadir_angle_rad(alpha_rad: Moving, ratio: Moving) -> Moving {
    let limb_rad = Moving::polar_angle((Moving::from_re(1.0) - ratio * ratio).sqrt(), ratio);
    let low_rad = (alpha_rad.re - core::f64::consts::FRAC_PI_2).max(0.0);
    let high_rad = alpha_rad.re.min(limb_rad.re);
    if low_rad >= limb_rad.re {
        return limb_rad;
    }
    let beta_rad = solve(low_rad, high_rad, alpha_rad.re, ratio.re);
    let beta = Moving::from_re(beta_rad);
    let (_, curvature) = slope_and_curvature(beta_rad, alpha_rad.re, ratio.re);
    if curvature < 0.0 { beta - slope(beta, alpha_rad, ratio) / curvature } else { beta }
}

/// The maximum of F within a bracket on which F' falls from positive to negative.
fn solve(low_rad: f64, high_rad: f64, alpha_rad: f64, ratio: f64) -> f64 {
    // The bracket shrinks to 2 %; from there Newton converges quadratically.
    const GOLDEN_STEPS: usize = 8;
    const NEWTON_STEPS: usize = 60;
    let bracket = Bracket { low: low_rad, high: high_rad };
    let bracket = golden_section(bracket, GOLDEN_STEPS, |beta_rad| -value(beta_rad, alpha_rad, ratio));
    let mut beta_rad = bracket.middle();
    let Bracket { low: mut low_rad, high: mut high_rad } = bracket;
    for _ in 0..NEWTON_STEPS {
        let (slope, curvature) = slope_and_curvature(beta_rad, alpha_rad, ratio);
        if slope > 0.0 {
            low_rad = beta_rad;
        } else {
            high_rad = beta_rad;
        }
        let newton_rad = beta_rad - slope / curvature;
        let inside = curvature < 0.0 && newton_rad >= low_rad && newton_rad <= high_rad;
        let next_rad = if inside { newton_rad } else { 0.5 * (low_rad + high_rad) };
        let step_rad = (next_rad - beta_rad).abs();
        beta_rad = next_rad;
        if step_rad <= 4.0 * f64::EPSILON * beta_rad.abs() {
            break;
        }
    }
    beta_rad
}

/// F (eq 17).
fn value(beta_rad: f64, alpha_rad: f64, ratio: f64) -> f64 {
    let cosine = math::cos(beta_rad);
    math::cos(alpha_rad - beta_rad) * (cosine - ratio) / (1.0 + ratio * (ratio - 2.0 * cosine)).sqrt()
}

/// F' by beta, times d^3 with d the distance to the point over r: it has the same roots, and F' its sign.
fn slope<T: Scalar>(beta_rad: T, alpha_rad: T, ratio: T) -> T {
    let one = T::constant(1.0);
    let (sine, cosine) = sin_cos(beta_rad);
    let (sin_i, cos_i) = sin_cos(alpha_rad - beta_rad);
    let squared = one + ratio * (ratio - cosine * 2.0);
    sin_i * (cosine - ratio) * squared - cos_i * sine * (one - ratio * cosine)
}

/// [`slope`] and its derivative by beta.
fn slope_and_curvature(beta_rad: f64, alpha_rad: f64, ratio: f64) -> (f64, f64) {
    let dual = slope(Moving::new(beta_rad, 1.0), Moving::from_re(alpha_rad), Moving::from_re(ratio));
    (dual.re, dual.eps)
}

#[cfg(test)]
mod tests;

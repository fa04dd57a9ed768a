//! Searches of targeting: a root in two angles by Newton's method, a minimum by golden section.

use nalgebra::{Matrix2, Vector2};

use crate::attitude::SunAngles;
use crate::numerics::golden_section::{Bracket, golden_section};

/// Newton steps.
const NEWTON_STEPS: usize = 30;
/// Half width of central differences, in rad.
const DIFFERENCE_RAD: f64 = 1e-5;
/// Steps of a golden section search.
const GOLDEN_STEPS: usize = 44;

/// A root by Newton's method, steps halved while they make it worse.
pub(super) fn newton(
    start: SunAngles,
    left: impl Fn(f64, f64) -> Vector2<f64>,
    tolerance: f64,
) -> Option<SunAngles> {
    let mut at = Vector2::new(start.azimuth_rad, start.elevation_rad);
    let mut now = left(at.x, at.y);
    for _ in 0..NEWTON_STEPS {
        if now.norm() <= tolerance {
            break;
        }
        let slope = |axis: usize| {
            let step = Vector2::ith(axis, DIFFERENCE_RAD);
            let (ahead, behind) = (at + step, at - step);
            (left(ahead.x, ahead.y) - left(behind.x, behind.y)) / (2.0 * DIFFERENCE_RAD)
        };
        let step = Matrix2::from_columns(&[slope(0), slope(1)]).try_inverse()? * now;
        let mut share = 1.0;
        let (next, then) = loop {
            let next = at - step * share;
            let then = left(next.x, next.y);
            if then.norm() < now.norm() || share < 1e-3 {
                break (next, then);
            }
            share *= 0.5;
        };
        if then.norm() >= now.norm() {
            break;
        }
        (at, now) = (next, then);
    }
    let is_angle = at.amax() < core::f64::consts::FRAC_PI_2;
    (is_angle && now.norm() <= 10.0 * tolerance)
        .then_some(SunAngles { azimuth_rad: at.x, elevation_rad: at.y })
}

/// Returns the position and value of the minimum of a function with one minimum in [`low`, `high`]; the ends count.
pub(super) fn golden(low: f64, high: f64, mut function: impl FnMut(f64) -> f64) -> (f64, f64) {
    let middle = golden_section(Bracket { low, high }, GOLDEN_STEPS, &mut function).middle();
    let ends = [low, high, middle].map(|at| (at, function(at)));
    ends.into_iter().fold((middle, f64::INFINITY), |best, next| if next.1 < best.1 { next } else { best })
}

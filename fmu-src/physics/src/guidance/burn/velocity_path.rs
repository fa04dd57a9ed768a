//! The velocity that a burn is to add, as a path: a straight line, or a cubic in the progress from 0 to 1.
//!
//! Equation: v(s) = c1 s + c2 s^2 + c3 s^3, 0 <= s <= 1, without gravity (paper 001, "Delta-V guidance"). A point is reported
//! by the length of path up to it, which is the magnitude of delta-v spent there; beyond the end the path continues straight.
//! Method: the length is a Gauss-Legendre integral of |v'| over [`PANELS`] panels, its inverse Newton's iteration kept
//! within a bracket.
//! Error measure: length relative to the whole, 1e-12 where |v'| varies by less than a factor of three.

use nalgebra::Vector3;

use crate::numerics::quadrature::Rule;

/// Nodes of the rule on a panel.
const NODES: usize = 8;

/// Panels from the beginning to the point requested.
const PANELS: u8 = 4;

/// Iterations of Newton with bisection; bisection alone needs as many.
const MOST_ITERATIONS: u8 = 60;

/// A path in velocity space, EME2000.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VelocityPath {
    /// Coefficients of the powers 1, 2 and 3 of the progress, in m/s.
    coefficients_m_s: [Vector3<f64>; 3],
    length_m_s: f64,
    rule: Rule<NODES>,
}

/// A profile that does not end where the delta-v does.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("the coefficients add up to ({}, {}, {}) m/s, not to the delta-v", .end_m_s.x, .end_m_s.y, .end_m_s.z)]
pub struct PathError {
    /// Velocity at the end of the path, in m/s.
    pub end_m_s: Vector3<f64>,
}

/// A point of a path, EME2000.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathPoint {
    /// Velocity since the beginning, in m/s.
    pub velocity_m_s: Vector3<f64>,
    /// Unit vector along the path.
    pub tangent: Vector3<f64>,
    /// How it turns by length of path, in s/m.
    pub curvature_s_m: Vector3<f64>,
}

impl VelocityPath {
    /// Straight from nothing to `delta_v_m_s`; `None` where that has no direction.
    pub fn linear(delta_v_m_s: Vector3<f64>) -> Option<Self> {
        Self::cubic([delta_v_m_s, Vector3::zeros(), Vector3::zeros()])
    }

    /// By the coefficients of the powers 1, 2 and 3 of the progress, in m/s; `None` for a path without length.
    pub fn cubic(coefficients_m_s: [Vector3<f64>; 3]) -> Option<Self> {
        let mut path = Self { coefficients_m_s, length_m_s: 0.0, rule: Rule::gauss_legendre() };
        path.length_m_s = path.length_to_m_s(1.0);
        (path.length_m_s.is_finite() && path.length_m_s > 0.0).then_some(path)
    }

    /// Straight to `delta_v_m_s` where all coefficients are zero, otherwise by them; `None` for a path without length.
    ///
    /// # Errors
    ///
    /// Coefficients that end elsewhere than at `delta_v_m_s`, where that is not zero.
    pub fn of_burn(
        delta_v_m_s: Vector3<f64>,
        coefficients_m_s: [Vector3<f64>; 3],
    ) -> Result<Option<Self>, PathError> {
        const ROUNDING: f64 = 1e-6;
        if coefficients_m_s.iter().all(|it| *it == Vector3::zeros()) {
            return Ok(Self::linear(delta_v_m_s));
        }
        let end_m_s: Vector3<f64> = coefficients_m_s.iter().sum();
        let size_m_s: f64 = coefficients_m_s.iter().map(|it| it.norm()).sum();
        if delta_v_m_s != Vector3::zeros() && (end_m_s - delta_v_m_s).norm() > ROUNDING * size_m_s {
            return Err(PathError { end_m_s });
        }
        Ok(Self::cubic(coefficients_m_s))
    }

    /// Its length: the magnitude of delta-v that it takes, in m/s.
    pub fn length_m_s(&self) -> f64 {
        self.length_m_s
    }

    /// The point after this length, in m/s; before the beginning it is the beginning.
    pub fn point(&self, length_m_s: f64) -> PathPoint {
        let progress = self.progress(length_m_s);
        let [c1, c2, c3] = &self.coefficients_m_s;
        let velocity_m_s = (c1 + (c2 + c3 * progress) * progress) * progress;
        let (slope, bend) = (self.slope(progress), c2 * 2.0 + c3 * (6.0 * progress));
        // Where the slope vanishes the next derivative leads on, at the end backwards.
        let next = if progress < 1.0 { bend } else { -bend };
        let direction = [slope, next, *c3].into_iter().find_map(|vector| vector.try_normalize(0.0));
        let tangent = direction.unwrap_or_else(Vector3::zeros);
        let beyond_m_s = (length_m_s - self.length_m_s).max(0.0);
        let speed = slope.norm_squared();
        let is_turning = beyond_m_s == 0.0 && speed > 0.0;
        PathPoint {
            velocity_m_s: velocity_m_s + tangent * beyond_m_s,
            tangent,
            curvature_s_m: if is_turning {
                (bend - tangent * tangent.dot(&bend)) / speed
            } else {
                Vector3::zeros()
            },
        }
    }

    /// Derivative by the progress, in m/s.
    fn slope(&self, progress: f64) -> Vector3<f64> {
        let [c1, c2, c3] = &self.coefficients_m_s;
        c1 + (c2 * 2.0 + c3 * (3.0 * progress)) * progress
    }

    /// Length up to a progress, in m/s.
    fn length_to_m_s(&self, progress: f64) -> f64 {
        let panel = progress / f64::from(PANELS);
        let edge = |k: u8| f64::from(k) * panel;
        (0..PANELS).map(|k| self.rule.integrate(edge(k), edge(k + 1), |s| self.slope(s).norm())).sum()
    }

    /// The progress after a length.
    fn progress(&self, length_m_s: f64) -> f64 {
        if length_m_s <= 0.0 || length_m_s >= self.length_m_s {
            return if length_m_s > 0.0 { 1.0 } else { 0.0 };
        }
        let (mut low, mut high) = (0.0, 1.0);
        let mut progress = length_m_s / self.length_m_s;
        for _ in 0..MOST_ITERATIONS {
            let excess_m_s = self.length_to_m_s(progress) - length_m_s;
            if excess_m_s.abs() <= 4.0 * f64::EPSILON * self.length_m_s {
                break;
            }
            if excess_m_s > 0.0 {
                high = progress;
            } else {
                low = progress;
            }
            let newton = progress - excess_m_s / self.slope(progress).norm();
            progress = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
        }
        progress
    }
}

#[cfg(test)]
mod tests;

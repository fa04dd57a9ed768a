//! Lambert's problem: the two-body arc between two places in a given time, with revolutions.
//!
//! Equation: with the chord c, s = (r1 + r2 + c) / 2, lambda^2 = 1 - c / s (lambda < 0 beyond 180 deg), y^2 = 1 - lambda^2 (1 - x^2),
//! T = sqrt(2 mu / s^3) t: T(x) = ((psi + N pi) / sqrt|1 - x^2| - x + lambda y) / (1 - x^2), with psi the angle (hyperbola: argument) of
//! sine (y - lambda x) sqrt|1 - x^2|; near the parabola x = 1 by Battin's series. 1 - x^2 = s / (2 a).
//! Method: Chandrupatla's for x in a bracket; without revolutions T falls with x, with N of them it falls to one least T (left branch)
//! and grows behind it (right branch).
//! Error measure: T to rounding, so velocities to some 1e-13 but where T is flat in x, near the least time of N revolutions.
//! Reference: Izzo, Celestial Mechanics and Dynamical Astronomy 121, 2015.

use core::f64::consts::PI;

use inputs::leg::ArcBranch;
use nalgebra::Vector3;
use physics::{
    constants::DAY_S,
    environment::orbit::{OrbitError, check, check_mu},
    math,
    numerics::roots::bracketed,
};
use thiserror::Error;

/// Places nearer than this to one line with the centre have no plane, sine of the angle between them.
const IN_LINE: f64 = 1e-6;
/// Distance of x from 1 within which the series for the parabola takes over.
const NEAR_PARABOLA: f64 = 0.1;
/// Nearest that x comes to -1, and with revolutions to 1.
const NEAREST: f64 = 1e-12;

/// Lambert's problem: an arc about a centre between two positions in a given time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LambertArc {
    /// Position at the begin, from the centre in an inertial frame, m.
    pub from_m: Vector3<f64>,
    /// Position at the end, m.
    pub to_m: Vector3<f64>,
    /// Duration, s.
    pub time_s: f64,
    /// Direction on whose side the angular momentum lies: north of the ecliptic for an arc that goes around as planets do.
    pub north: Vector3<f64>,
    /// Gravitational parameter of the centre, m3/s2.
    pub mu_m3_s2: f64,
}

/// Velocities of an arc, in the frame of its places.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LambertVelocities {
    /// At its begin, m/s.
    pub from_m_s: Vector3<f64>,
    /// At its end, m/s.
    pub to_m_s: Vector3<f64>,
}

/// Reason why there is no arc.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum LambertError {
    /// A number outside its range.
    #[error(transparent)]
    Orbit(#[from] OrbitError),
    /// Both places and the centre lie on a line.
    #[error(
        "found places {angle_deg:.3} deg apart as seen from the centre, in line with it: no plane of an arc, allowed: any other angle"
    )]
    InLine {
        /// Angle between them, deg.
        angle_deg: f64,
    },
    /// The revolutions take longer.
    #[error(
        "found {:.3} d, revolutions {revolutions}, allowed: {:.3} d or more, or fewer revolutions", .time_s / DAY_S, .least_s / DAY_S
    )]
    TooShort {
        /// Whole revolutions.
        revolutions: u32,
        /// Least time, s.
        least_s: f64,
        /// Time of the arc, s.
        time_s: f64,
    },
    /// A time so long or short that no double is near enough to it.
    #[error(
        "found {time_s} s between the places, out of all proportion, allowed: less, or places farther apart"
    )]
    Time {
        /// Time that was asked for, s.
        time_s: f64,
    },
}

impl LambertArc {
    /// Velocities of the arc without a whole revolution.
    ///
    /// # Errors
    /// Places in line with the centre, numbers that are none.
    pub fn direct(&self) -> Result<LambertVelocities, LambertError> {
        let shape = Shape::new(self)?;
        let x = shape.root(0, None).ok_or(LambertError::Time { time_s: self.time_s })?;
        Ok(self.velocities(&shape, x))
    }

    /// Velocities of an arc with whole revolutions, at least one.
    ///
    /// # Errors
    /// As [`LambertArc::direct`]; too little time.
    pub fn revolving(&self, revolutions: u32, branch: ArcBranch) -> Result<LambertVelocities, LambertError> {
        let shape = Shape::new(self)?;
        let lost = || LambertError::Time { time_s: self.time_s };
        let least_x = shape.least(revolutions).ok_or_else(lost)?;
        let least_time = shape.time(least_x, revolutions);
        if shape.time < least_time {
            let least_s = self.time_s * least_time / shape.time;
            return Err(LambertError::TooShort { revolutions, least_s, time_s: self.time_s });
        }
        let x = shape.root(revolutions, Some((branch, least_x))).ok_or_else(lost)?;
        Ok(self.velocities(&shape, x))
    }

    fn velocities(&self, shape: &Shape, x: f64) -> LambertVelocities {
        let (r1_m, r2_m) = (self.from_m.norm(), self.to_m.norm());
        let lambda = shape.lambda;
        let y = shape.y(x);
        let gamma = (0.5 * self.mu_m3_s2 * shape.semiperimeter_m).sqrt();
        let rho = (r1_m - r2_m) / shape.chord_m;
        let sigma = ((1.0 - rho) * (1.0 + rho)).sqrt();
        let across = gamma * sigma * (y + lambda * x);
        let [from_m_s, to_m_s] =
            [(self.from_m, r1_m, 1.0), (self.to_m, r2_m, -1.0)].map(|(place_m, r_m, end)| {
                let up = place_m / r_m;
                let radial = gamma * end * ((lambda * y - x) - end * rho * (lambda * y + x));
                (up * radial + shape.normal.cross(&up) * across) / r_m
            });
        LambertVelocities { from_m_s, to_m_s }
    }
}

/// The arc without dimensions.
struct Shape {
    lambda: f64,
    /// T.
    time: f64,
    chord_m: f64,
    semiperimeter_m: f64,
    /// Direction of the angular momentum.
    normal: Vector3<f64>,
}

impl Shape {
    fn new(arc: &LambertArc) -> Result<Self, LambertError> {
        check_mu(arc.mu_m3_s2)?;
        check("time in s", arc.time_s, arc.time_s.is_finite() && arc.time_s > 0.0, "above 0")?;
        let (r1_m, r2_m) = (arc.from_m.norm(), arc.to_m.norm());
        for (what, r_m) in [("distance of the begin in m", r1_m), ("distance of the end in m", r2_m)] {
            check(what, r_m, r_m.is_finite() && r_m > 0.0, "above 0")?;
        }
        let cross = (arc.from_m / r1_m).cross(&(arc.to_m / r2_m));
        let sine = cross.norm();
        if sine < IN_LINE {
            let cosine = arc.from_m.dot(&arc.to_m) / (r1_m * r2_m);
            return Err(LambertError::InLine { angle_deg: math::atan2(sine, cosine).to_degrees() });
        }
        let side = if cross.dot(&arc.north) < 0.0 { -1.0 } else { 1.0 };
        let chord_m = (arc.to_m - arc.from_m).norm();
        let semiperimeter_m = 0.5 * (r1_m + r2_m + chord_m);
        // lambda^2 = r1 r2 (1 + cos) / (2 s^2): 1 - c / s is not exact near 180 deg.
        let halves = (arc.from_m / r1_m + arc.to_m / r2_m).norm();
        let lambda = side * 0.5 * halves * (r1_m * r2_m).sqrt() / semiperimeter_m;
        let time = (2.0 * arc.mu_m3_s2 / semiperimeter_m).sqrt() / semiperimeter_m * arc.time_s;
        Ok(Self { lambda, time, chord_m, semiperimeter_m, normal: cross * (side / sine) })
    }

    fn y(&self, x: f64) -> f64 {
        (1.0 - self.lambda * self.lambda * (1.0 - x) * (1.0 + x)).sqrt()
    }

    /// T(x).
    fn time(&self, x: f64, revolutions: u32) -> f64 {
        let (lambda, y) = (self.lambda, self.y(x));
        let from_parabola = (1.0 - x) * (1.0 + x);
        let turns = f64::from(revolutions) * PI;
        // y - lambda x, without the difference of nearly equal numbers.
        let eta = if lambda * x > 0.0 {
            (1.0 - lambda) * (1.0 + lambda) / (y + lambda * x)
        } else {
            y - lambda * x
        };
        if (x - 1.0).abs() < NEAR_PARABOLA {
            let q = 4.0 / 3.0 * hypergeometric(0.5 * (1.0 - lambda - x * eta));
            let open = 0.5 * eta * (eta * eta * q + 4.0 * lambda);
            let whole = if revolutions == 0 { 0.0 } else { turns / (from_parabola * from_parabola.sqrt()) };
            return open + whole;
        }
        let root = from_parabola.abs().sqrt();
        let psi = if x < 1.0 {
            math::atan2(eta * root, x * y + lambda * from_parabola) + turns
        } else {
            math::asinh(eta * root)
        };
        (psi / root - x + lambda * y) / from_parabola
    }

    /// The x of the least time of these revolutions: dT/dx = (3 T x - 2 + 2 lambda^3 x / y) / (1 - x^2) = 0.
    fn least(&self, revolutions: u32) -> Option<f64> {
        let cube = self.lambda * self.lambda * self.lambda;
        bracketed(-1.0 + NEAREST, 1.0 - NEAREST, |x| {
            3.0 * self.time(x, revolutions) * x - 2.0 + 2.0 * cube * x / self.y(x)
        })
    }

    /// The x of the arc's time.
    fn root(&self, revolutions: u32, branch: Option<(ArcBranch, f64)>) -> Option<f64> {
        let [from, to] = match branch {
            Some((ArcBranch::Left, least_x)) => [-1.0 + NEAREST, least_x],
            Some((ArcBranch::Right, least_x)) => [least_x, 1.0 - NEAREST],
            None => {
                // T falls as 1 / x^2 far out on hyperbolas.
                let mut most = 1.0;
                while self.time(most, 0) > self.time && most < 1e12 {
                    most *= 2.0;
                }
                [-1.0 + NEAREST, most]
            }
        };
        bracketed(from, to, |x| self.time(x, revolutions) - self.time)
    }
}

/// Gauss's 2F1(3, 1; 5/2; z) by its series, for |z| below 1/2.
fn hypergeometric(z: f64) -> f64 {
    let (mut term, mut sum) = (1.0, 1.0);
    for k in 0..200 {
        let k = f64::from(k);
        term *= (3.0 + k) / (2.5 + k) * z;
        sum += term;
        if term.abs() <= 1e-17 * sum {
            break;
        }
    }
    sum
}

#[cfg(test)]
mod tests;

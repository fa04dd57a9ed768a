//! Gravity of a central body with its flattening, and the tide of a distant one.
//!
//! Equation: `-mu r / r^3`, the gradient of `-(mu / r) J2 (R / r)^2 (3 sin^2(latitude) - 1) / 2`, and Battin's tide.
//! Reference: Vallado, Fundamentals of Astrodynamics and Applications, 8.6; Battin, An Introduction to the Mathematics and
//! Methods of Astrodynamics, 8.4.

use nalgebra::{Matrix3, Vector3};
use serde::{Deserialize, Serialize};

use crate::bodies::BodyData;

/// Flattening of the central body.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Flattening {
    /// Second zonal harmonic J2, unnormalised.
    pub j2: f64,
    /// Radius to which J2 refers, m.
    pub reference_radius_m: f64,
    /// North pole, unit vector in EME2000.
    pub pole: Vector3<f64>,
}

impl Flattening {
    /// That of a body.
    pub fn of(body: &BodyData) -> Self {
        Self { j2: body.j2, reference_radius_m: body.j2_radius_m, pole: body.pole() }
    }

    /// Adds its acceleration, m/s2, at a position from the body's centre; `inverse` is 1 / r, `point` is mu / r^3.
    pub(super) fn add_to(&self, sum: &mut Vector3<f64>, position_m: &Vector3<f64>, inverse: f64, point: f64) {
        let Self { j2, reference_radius_m, pole } = self;
        let sin_latitude = position_m.dot(pole) * inverse;
        let ratio = reference_radius_m * inverse;
        let factor = 1.5 * j2 * ratio * ratio * point;
        *sum += position_m * (factor * (5.0 * sin_latitude * sin_latitude - 1.0));
        *sum -= pole * (2.0 * factor * sin_latitude / inverse);
    }
}

/// The gravity of a central body.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Gravity {
    /// Gravitational parameter of the central body, m3/s2.
    pub mu_m3_s2: f64,
    /// Its flattening, if that counts.
    pub flattening: Option<Flattening>,
}

/// Distant bodies whose tides act on a spacecraft about another one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tides {
    /// Whether the Sun's does.
    pub sun: bool,
    /// Whether the Moon's does, about the Earth.
    pub moon: bool,
}

impl Gravity {
    /// A point mass and nothing else.
    pub fn point_mass(mu_m3_s2: f64) -> Self {
        Self { mu_m3_s2, flattening: None }
    }

    /// A planet with its flattening.
    pub fn of(planet: &BodyData) -> Self {
        Self { mu_m3_s2: planet.gm_m3_s2, flattening: Some(Flattening::of(planet)) }
    }

    /// Acceleration in EME2000, m/s2, at a position relative to the central body.
    pub fn acceleration_m_s2(&self, position_m: &Vector3<f64>) -> Vector3<f64> {
        let distance_squared = position_m.norm_squared();
        let inverse = 1.0 / distance_squared.sqrt();
        let point = self.mu_m3_s2 * inverse * inverse * inverse;
        let mut sum = position_m * -point;
        if let Some(flattening) = self.flattening {
            flattening.add_to(&mut sum, position_m, inverse, point);
        }
        sum
    }
}

/// Gradient of the acceleration toward a point mass, 1/s2, at this position from it: mu / r^3 (3 u uT - 1), u along the position.
pub(super) fn gradient_per_s2(position_m: &Vector3<f64>, gm_m3_s2: f64) -> Matrix3<f64> {
    let inverse = 1.0 / position_m.norm();
    let along = position_m * inverse;
    (along * along.transpose() * 3.0 - Matrix3::identity()) * (gm_m3_s2 * inverse * inverse * inverse)
}

/// Acceleration by a distant body relative to the centre's own fall toward it, m/s2:
/// `mu (d / |d|^3 - s / |s|^3)` with `d = s - r`, in Battin's form that does not cancel.
pub fn tide_m_s2(position_m: &Vector3<f64>, tide_body_m: &Vector3<f64>, mu_m3_s2: f64) -> Vector3<f64> {
    let to_body = tide_body_m - position_m;
    let distance = to_body.norm();
    let q = position_m.dot(&(position_m - tide_body_m * 2.0)) / tide_body_m.norm_squared();
    // (1 + q)^(3/2) - 1
    let f = q * (3.0 + q * (3.0 + q)) / (1.0 + (1.0 + q) * (1.0 + q).sqrt());
    (position_m + tide_body_m * f) * (-mu_m3_s2 / (distance * distance * distance))
}

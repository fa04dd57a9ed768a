//! Gravity of one body with its flattening, the tide of a distant one, and relativity.
//!
//! Equation: `-mu r / r^3`, the gradient of `-(mu / r) J2 (R / r)^2 (3 sin^2(latitude) - 1) / 2`, Battin's tide, and Schwarzschild's
//! mu / (c^2 r^3) ((4 mu / r - v^2) r + 4 (r . v) v) in harmonic coordinates.
//! Reference: Vallado, Fundamentals of Astrodynamics and Applications, 8.6; Battin, An Introduction to the Mathematics and
//! Methods of Astrodynamics, 8.4; Petit and Luzum, IERS Conventions 2010, 10.12.

use nalgebra::{Matrix3, Vector3};
use serde::{Deserialize, Serialize};

use crate::bodies::BodyData;
use crate::constants::SPEED_OF_LIGHT_M_S;
use crate::environment::CartesianState;

/// Flattening of a body.
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
    /// Returns the flattening of a body.
    pub fn from_body(body: &BodyData) -> Self {
        Self { j2: body.j2, reference_radius_m: body.j2_radius_m, pole: body.pole() }
    }
}

/// Gravity of one body.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Gravity {
    /// Gravitational parameter, m3/s2.
    pub mu_m3_s2: f64,
    /// Flattening; absent for a point mass.
    pub flattening: Option<Flattening>,
}

impl Gravity {
    /// Returns the gravity of a point mass.
    pub fn point_mass(mu_m3_s2: f64) -> Self {
        Self { mu_m3_s2, flattening: None }
    }

    /// Returns the gravity of a body with its flattening, if it has any.
    pub fn from_body(body: &BodyData) -> Self {
        let flattening = (body.j2 != 0.0).then(|| Flattening::from_body(body));
        Self { mu_m3_s2: body.gm_m3_s2, flattening }
    }

    /// Acceleration in EME2000, m/s2, at a position from the body's centre.
    pub fn acceleration_m_s2(&self, position_m: &Vector3<f64>) -> Vector3<f64> {
        let inverse = 1.0 / position_m.norm();
        let mut sum = position_m * (-self.mu_m3_s2 * inverse * inverse * inverse);
        self.add_flattening_m_s2(&mut sum, position_m);
        sum
    }

    /// Adds the acceleration by the flattening alone, m/s2, at a position from the body's centre.
    pub(super) fn add_flattening_m_s2(&self, sum: &mut Vector3<f64>, position_m: &Vector3<f64>) {
        let Some(Flattening { j2, reference_radius_m, pole }) = &self.flattening else { return };
        let inverse = 1.0 / position_m.norm();
        let point = self.mu_m3_s2 * inverse * inverse * inverse;
        let sin_latitude = position_m.dot(pole) * inverse;
        let ratio = reference_radius_m * inverse;
        let factor = 1.5 * j2 * ratio * ratio * point;
        *sum += position_m * (factor * (5.0 * sin_latitude * sin_latitude - 1.0));
        *sum -= pole * (2.0 * factor * sin_latitude / inverse);
    }
}

/// Gradient of the acceleration toward a point mass, 1/s2, at a position from it: mu / r^3 (3 u uT - 1), u along the position.
pub(super) fn gradient_per_s2(position_m: &Vector3<f64>, gm_m3_s2: f64) -> Matrix3<f64> {
    let inverse = 1.0 / position_m.norm();
    let along = position_m * inverse;
    (along * along.transpose() * 3.0 - Matrix3::identity()) * (gm_m3_s2 * inverse * inverse * inverse)
}

/// Acceleration by a distant body relative to the centre's own fall toward it, m/s2:
/// `mu (d / |d|^3 - s / |s|^3)` with `d = s - r`, in Battin's form that does not cancel.
pub(super) fn tide_m_s2(
    position_m: &Vector3<f64>,
    tide_body_m: &Vector3<f64>,
    mu_m3_s2: f64,
) -> Vector3<f64> {
    let to_body = tide_body_m - position_m;
    let distance = to_body.norm();
    let q = position_m.dot(&(position_m - tide_body_m * 2.0)) / tide_body_m.norm_squared();
    // (1 + q)^(3/2) - 1
    let f = q * (3.0 + q * (3.0 + q)) / (1.0 + (1.0 + q) * (1.0 + q).sqrt());
    (position_m + tide_body_m * f) * (-mu_m3_s2 / (distance * distance * distance))
}

/// Schwarzschild's acceleration of a test mass at a state from the body, m/s2.
pub(super) fn relativity_m_s2(state: &CartesianState, gm_m3_s2: f64) -> Vector3<f64> {
    let (r, v) = (state.position_m, state.velocity_m_s);
    let distance_m = r.norm();
    let factor = gm_m3_s2 / (SPEED_OF_LIGHT_M_S * SPEED_OF_LIGHT_M_S * distance_m * distance_m * distance_m);
    (r * (4.0 * gm_m3_s2 / distance_m - v.norm_squared()) + v * (4.0 * r.dot(&v))) * factor
}

//! Torque of a planet's gravity gradient: of a point mass, and of an oblate planet.
//!
//! Equation: int rho x G rho dm = -eps_ijk (G J)_kj with G the gradient of the acceleration and J the inertia; a part
//! a b^T + b a^T of G gives a x J b + b x J a, one along the identity nothing. Of the potential
//! -(mu / r) J2 (R / r)^2 (3 w^2 - 1) / 2, with u the direction to the planet, p its pole and w = u.p,
//! G = -(3/2) mu J2 R^2 / r^5 [2 p p^T - 10 w (p u^T + u p^T) + (35 w^2 - 5) u u^T + (1 - 5 w^2) 1].
//! Error measure: terms of the next order in the spacecraft's size over its distance are left out.
//! Reference: Wertz, Spacecraft Attitude Determination and Control, 17.2.1; Vallado, Fundamentals of Astrodynamics and Applications,
//! 8.6 (potential).

use nalgebra::{Matrix3, Vector3};

use crate::numerics::scalar::Scalar;

/// Torque 3 mu / r^5 r x J r of a point mass of gravitational parameter `gm_m3_s2` at `to_planet_body_m`, in N m.
pub fn gravity_gradient_n_m<T: Scalar>(
    gm_m3_s2: T,
    inertia_body_kg_m2: &Matrix3<T>,
    to_planet_body_m: &Vector3<T>,
) -> Vector3<T> {
    let distance_m = to_planet_body_m.norm();
    let toward = to_planet_body_m / distance_m;
    let scale = gm_m3_s2 * 3.0 / (distance_m * distance_m * distance_m);
    toward.cross(&(inertia_body_kg_m2 * toward)) * scale
}

/// A planet with its flattening, as seen from the spacecraft.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OblatePlanet<T: Scalar> {
    /// Gravitational parameter, in m3/s2.
    pub gm_m3_s2: T,
    /// Second zonal harmonic J2, unnormalised.
    pub j2: T,
    /// Radius to which J2 refers, in m.
    pub j2_radius_m: T,
    /// Toward the north pole, body frame, of any length but 0.
    pub pole_body: Vector3<T>,
}

/// As [`gravity_gradient_n_m`], of a planet with its flattening.
pub fn oblate_gravity_gradient_n_m<T: Scalar>(
    planet: &OblatePlanet<T>,
    inertia_body_kg_m2: &Matrix3<T>,
    to_planet_body_m: &Vector3<T>,
) -> Vector3<T> {
    let distance_m = to_planet_body_m.norm();
    let toward = to_planet_body_m / distance_m;
    let pole = planet.pole_body / planet.pole_body.norm();
    let sin_latitude = toward.dot(&pole);
    let (of_toward, of_pole) = (inertia_body_kg_m2 * toward, inertia_body_kg_m2 * pole);
    let point = planet.gm_m3_s2 * 3.0 / (distance_m * distance_m * distance_m);
    let ratio = planet.j2_radius_m / distance_m;
    let oblate = planet.j2 * ratio * ratio * 0.5;
    let along = (sin_latitude * sin_latitude * 35.0 - 5.0) * oblate;
    let mixed = sin_latitude * oblate * 10.0;
    let torque = toward.cross(&of_toward) * (-along + 1.0) - pole.cross(&of_pole) * (oblate * 2.0)
        + (pole.cross(&of_toward) + toward.cross(&of_pole)) * mixed;
    torque * point
}

#[cfg(test)]
mod tests;

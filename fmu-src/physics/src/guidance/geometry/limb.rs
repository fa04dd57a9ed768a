//! The limb point of a triaxial ellipsoid, at an azimuth or on the terminator (paper 001, eqs 20 to 22).
//!
//! Scaled by the radii the ellipsoid is the unit sphere, y = x / radii: |y| = 1, y . rho = 1 with rho the scaled spacecraft,
//! y . sigma = 0 with sigma the scaled normal of the third plane. With p the part of rho across sigma the solutions are
//! y = p/p^2 +- sqrt(1 - 1/p^2) w, w the unit vector along rho x sigma: closed, so that moving numbers give their rates.
//! The plane is normal to the Sun's direction (terminator: 0, 1 or 2 solutions, the one nearer to the downtrack direction is
//! taken), or holds the local vertical and the azimuth's direction (generic: one solution on the azimuth's side). Where
//! there is none the aimpoint is the planet's centre. Height counts along the radius of the limb point.

use nalgebra::{ComplexField, Vector3};

use super::ephemeris_at_time::EphemerisAtTime;
use super::lvlh::{AzimuthReference, lvlh_axes, lvlh_direction};
use super::moving::{Moving, MovingVector, fixed, unit, unit_normal, value};
use crate::numerics::scalar::Scalar;

/// A limb point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LimbPoint {
    /// From the planet's centre, EME2000, in m.
    pub position: MovingVector,
    /// Whether it is one; else it is the planet's centre.
    pub exists: bool,
}

/// Limb point at an azimuth about the local vertical and a height in m along its radius; `None` where the azimuth has no
/// reference.
pub fn generic_limb(
    ephemeris: &EphemerisAtTime,
    reference: AzimuthReference,
    azimuth_rad: f64,
    height: Moving,
) -> Option<LimbPoint> {
    let side = lvlh_direction(ephemeris, reference, azimuth_rad, 0.0)?;
    let normal = unit_normal(&ephemeris.position, &side)?;
    let solutions = limb_points(ephemeris, &normal);
    let chosen = solutions.map(|[a, b]| if value(&(a - b)).dot(&value(&side)) >= 0.0 { a } else { b });
    Some(raised(chosen, height))
}

/// Limb point on the terminator at a height in m along its radius; `None` without a Sun.
pub fn terminator_limb(ephemeris: &EphemerisAtTime, height: Moving) -> Option<LimbPoint> {
    let solutions = limb_points(ephemeris, &unit(&ephemeris.sun)?);
    let downtrack = lvlh_axes(ephemeris, AzimuthReference::Downtrack)
        .map_or(Vector3::zeros(), |axes| value(&axes.column(0).into_owned()));
    let along = |point: &MovingVector| value(&(point - ephemeris.position)).normalize().dot(&downtrack);
    let chosen = solutions.map(|[a, b]| if along(&a) >= along(&b) { a } else { b });
    Some(raised(chosen, height))
}

/// Both limb points in the plane through the centre that `normal` (EME2000) is normal to.
fn limb_points(ephemeris: &EphemerisAtTime, normal: &MovingVector) -> Option<[MovingVector; 2]> {
    let planet_from_inertial = ephemeris.planet.planet_from_inertial(ephemeris.epoch_s);
    let radii = fixed(ephemeris.planet.radii_m);
    let rho = (planet_from_inertial * ephemeris.position).component_div(&radii);
    let sigma = unit(&(planet_from_inertial * normal).component_mul(&radii))?;
    let across = rho - sigma * rho.dot(&sigma);
    let inverse = Moving::from_re(1.0) / across.dot(&across);
    let half_chord = root(Moving::from_re(1.0) - inverse)?;
    let side = unit_normal(&rho, &sigma)? * half_chord;
    let middle = across * inverse;
    let unscaled = |y: MovingVector| planet_from_inertial.tr_mul(&y.component_mul(&radii));
    Some([unscaled(middle + side), unscaled(middle - side)])
}

/// The square root; `None` of a negative number. At zero, where both solutions meet, it stays.
fn root(number: Moving) -> Option<Moving> {
    if number.re > 0.0 { Some(number.sqrt()) } else { (number.re == 0.0).then(|| Moving::constant(0.0)) }
}

/// Returns the point raised by `height`; the planet's centre where there is none.
fn raised(point: Option<MovingVector>, height: Moving) -> LimbPoint {
    let up = point.and_then(|position| Some((position, unit(&position)?)));
    up.map_or(LimbPoint { position: fixed(Vector3::zeros()), exists: false }, |(position, up)| LimbPoint {
        position: position + up * height,
        exists: true,
    })
}

#[cfg(test)]
mod tests;

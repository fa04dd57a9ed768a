//! How much of the Sun's disc a spacecraft sees past a planet, and when that changes.
//!
//! Equation: Sun and planet are spheres; seen from the spacecraft they are circles on the sky of angular radii
//! `asin(R / distance)` (paper 004 eq 26). The lit fraction is the part of the Sun's circle outside the planet's, by
//! solid angle.
//! Method: both are treated as circles on the sphere, not on a flat sky: close to the planet, whose circle spans a good
//! part of the sky, the flat formula is off by up to 1e-3. What they have in common is a sector of each cap less the two
//! spherical triangles counted twice, by half-angle formulas without cancellation; edges of penumbra and umbra are roots of
//! the gaps between the circles ([`crate::numerics::events`]).
//! Order: closed form.
//! Error measure: 1e-12 of the Sun's disc.
//! Reference: Montenbruck and Gill, Satellite Orbits, 3.4.2 (the flat formula); l'Huilier's theorem for the triangles.

mod discs;
#[cfg(test)]
mod tests;

use core::f64::consts::FRAC_PI_2;

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::enumeration::enumeration;
use crate::{
    constants::RADIUS_SUN_M,
    math,
    numerics::scalar::{Scalar, asin, vector_value},
};

pub use discs::Discs;

enumeration! {
    /// How a planet's shadow dims the Sun.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
    pub enum ShadowModel {
        /// By the visible fraction of the Sun's disc: umbra, penumbra, annular.
        #[default]
        #[serde(rename = "discs")]
        1 => DiscOverlap,
        /// Paper 004: no light as soon as the discs touch.
        // Total, partial or annular; the annular condition corrected.
        #[serde(rename = "cone")]
        2 => AllOrNothingCone,
        /// No light in the cylinder of the planet's radius behind it.
        #[serde(rename = "cylinder")]
        3 => AllOrNothingCylinder,
        /// The planet casts no shadow; so in paper 000.
        4 => Off,
    }
}

/// A geometry without a lit fraction.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum EclipseError {
    /// The spacecraft is below the planet's surface.
    #[error(
        "the spacecraft is {distance_m} m from the planet's centre, inside the planet of radius {radius_m} m"
    )]
    InsidePlanet {
        /// Distance from the planet's centre, m.
        distance_m: f64,
        /// Radius of the planet, m.
        radius_m: f64,
    },
    /// The spacecraft is inside the Sun.
    #[error(
        "the spacecraft is {distance_m} m from the Sun's centre, allowed is more than its radius of {radius_m} m"
    )]
    InsideSun {
        /// Distance from the Sun's centre, m.
        distance_m: f64,
        /// Radius of the Sun, m.
        radius_m: f64,
    },
    /// A position that is not finite.
    #[error("position of {of} is not finite")]
    NotFinite {
        /// Name of the body.
        of: &'static str,
    },
    /// A radius that cannot be.
    #[error("radius of {of} is {found_m} m, allowed is a finite number above 0")]
    Radius {
        /// Name of the body.
        of: &'static str,
        /// Radius that was found, m.
        found_m: f64,
    },
}

/// A planet's shadow.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Shadow {
    model: ShadowModel,
    planet_radius_m: f64,
    sun_radius_m: f64,
}

impl Shadow {
    /// The shadow of a planet of `planet_radius_m` in the light of a Sun of [`RADIUS_SUN_M`].
    ///
    /// # Errors
    /// [`EclipseError::Radius`] unless the radius is finite and positive.
    pub fn new(model: ShadowModel, planet_radius_m: f64) -> Result<Self, EclipseError> {
        Self::with_sun_radius(model, planet_radius_m, RADIUS_SUN_M)
    }

    /// As [`Shadow::new`], with another radius of the Sun.
    ///
    /// # Errors
    /// [`EclipseError::Radius`] unless both radii are finite and positive.
    pub fn with_sun_radius(
        model: ShadowModel,
        planet_radius_m: f64,
        sun_radius_m: f64,
    ) -> Result<Self, EclipseError> {
        for (of, found_m) in [("the planet", planet_radius_m), ("the Sun", sun_radius_m)] {
            if !(found_m > 0.0 && found_m.is_finite()) {
                return Err(EclipseError::Radius { of, found_m });
            }
        }
        Ok(Self { model, planet_radius_m, sun_radius_m })
    }

    /// Radius of the planet, in m.
    pub fn planet_radius_m(&self) -> f64 {
        self.planet_radius_m
    }

    /// Radius of the Sun, in m.
    pub fn sun_radius_m(&self) -> f64 {
        self.sun_radius_m
    }

    /// Discs of planet and Sun as seen from the spacecraft.
    fn discs<T: Scalar>(
        &self,
        [planet_radius_m, sun_radius_m]: [T; 2],
        spacecraft_m: &Vector3<T>,
        sun_m: &Vector3<T>,
    ) -> Result<Discs<T>, EclipseError> {
        let to_sun = sun_m - spacecraft_m;
        let (planet_distance, sun_distance) = (spacecraft_m.norm(), to_sun.norm());
        let (planet_distance_m, sun_distance_m) = (planet_distance.value(), sun_distance.value());
        if !planet_distance_m.is_finite() {
            return Err(EclipseError::NotFinite { of: "the spacecraft" });
        }
        if !sun_distance_m.is_finite() {
            return Err(EclipseError::NotFinite { of: "the Sun" });
        }
        // Standing on the surface is allowed, with the rounding that comes with it.
        let sin_planet = self.planet_radius_m / planet_distance_m;
        if sin_planet > 1.0 + 1e-12 || planet_distance_m == 0.0 {
            let radius_m = self.planet_radius_m;
            return Err(EclipseError::InsidePlanet { distance_m: planet_distance_m, radius_m });
        }
        if sun_distance_m <= self.sun_radius_m {
            let radius_m = self.sun_radius_m;
            return Err(EclipseError::InsideSun { distance_m: sun_distance_m, radius_m });
        }
        let planet_radius_rad =
            if sin_planet < 1.0 { asin(planet_radius_m / planet_distance) } else { T::constant(FRAC_PI_2) };
        // Cross and dot of the directions to the Sun and to the planet; no cancellation at any angle.
        let cross = spacecraft_m.cross(sun_m).norm_squared();
        let across = if cross.value() > 0.0 { cross.sqrt() } else { T::constant(0.0) };
        Ok(Discs {
            sun_radius_rad: asin(sun_radius_m / sun_distance),
            planet_radius_rad,
            separation_rad: T::polar_angle(across, -spacecraft_m.dot(&to_sun)),
            planet_in_front: planet_distance_m < sun_distance_m,
        })
    }

    /// The share of sunlight that arrives, 0 to 1; positions relative to the planet's centre, m, and the radii of planet and Sun,
    /// m, as numbers that may depend on the seed; the radii's values are the shadow's own.
    ///
    /// # Errors
    /// [`EclipseError`] if the spacecraft is inside the planet or the Sun, or a position is not finite.
    pub fn lit_fraction_of<T: Scalar>(
        &self,
        radii_m: [T; 2],
        spacecraft_m: &Vector3<T>,
        sun_m: &Vector3<T>,
    ) -> Result<T, EclipseError> {
        if self.model == ShadowModel::Off {
            return Ok(T::constant(1.0));
        }
        let discs = self.discs(radii_m, spacecraft_m, sun_m)?;
        let all_or_nothing = |gap_rad: f64| T::constant(f64::from(gap_rad >= 0.0));
        Ok(match self.model {
            ShadowModel::DiscOverlap => discs.lit_fraction(),
            ShadowModel::AllOrNothingCone => all_or_nothing(discs.outer_gap_rad().value()),
            ShadowModel::AllOrNothingCylinder => {
                all_or_nothing(self.cylinder_gap_rad(&vector_value(spacecraft_m), &vector_value(sun_m)))
            }
            ShadowModel::Off => T::constant(1.0),
        })
    }

    /// The share of sunlight that arrives, and the functions of the geometry whose roots are this model's edges, in rad, positive
    /// in full light: outer edge of the shadow, and inner edge where there is a penumbra (infinity where there is none). NaN where
    /// there is no such geometry.
    pub fn fraction_and_gaps(&self, spacecraft_m: &Vector3<f64>, sun_m: &Vector3<f64>) -> (f64, [f64; 2]) {
        let none = f64::INFINITY;
        let undefined = (f64::NAN, [f64::NAN; 2]);
        if self.model == ShadowModel::Off {
            let outside = spacecraft_m.norm() >= self.planet_radius_m;
            return if outside { (1.0, [none; 2]) } else { undefined };
        }
        let radii_m = [self.planet_radius_m, self.sun_radius_m];
        let Ok(discs) = self.discs(radii_m, spacecraft_m, sun_m) else { return undefined };
        let all_or_nothing = |gap_rad: f64| (f64::from(gap_rad >= 0.0), [gap_rad, none]);
        match self.model {
            ShadowModel::DiscOverlap => {
                let outer_rad = discs.outer_gap_rad();
                let fraction = if outer_rad > 0.0 { 1.0 } else { discs.lit_fraction() };
                (fraction, [outer_rad, discs.inner_gap_rad()])
            }
            ShadowModel::AllOrNothingCone => all_or_nothing(discs.outer_gap_rad()),
            ShadowModel::AllOrNothingCylinder => all_or_nothing(self.cylinder_gap_rad(spacecraft_m, sun_m)),
            ShadowModel::Off => (1.0, [none; 2]),
        }
    }

    /// Upper bound of the gaps' rates, in rad/s, by least distance in m and greatest speed in m/s relative to planet and Sun; infinite at
    /// the surface.
    pub fn greatest_gap_rate_rad_s(&self, planet: [f64; 2], sun: [f64; 2]) -> f64 {
        let rate_rad_s = |[distance_m, speed_m_s]: [f64; 2], radius_m: f64| {
            let to_limb_m = (distance_m * distance_m - radius_m * radius_m).max(0.0).sqrt();
            speed_m_s / distance_m * (1.0 + radius_m / to_limb_m)
        };
        rate_rad_s(planet, self.planet_radius_m) + rate_rad_s(sun, self.sun_radius_m)
    }

    /// Angle between the antisolar direction and the spacecraft, seen from the planet's centre, beyond the shadow
    /// cylinder's.
    fn cylinder_gap_rad(&self, spacecraft_m: &Vector3<f64>, sun_m: &Vector3<f64>) -> f64 {
        let from_axis_rad = math::atan2(spacecraft_m.cross(sun_m).norm(), -spacecraft_m.dot(sun_m));
        from_axis_rad - math::asin((self.planet_radius_m / spacecraft_m.norm()).min(1.0))
    }
}

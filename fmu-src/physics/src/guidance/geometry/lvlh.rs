//! The two local frames of the spacecraft (paper 001, Figure 4): local vertical, local horizontal.
//!
//! Up is from the planet's centre to the spacecraft. The axes are the reference (the horizontal part of the velocity, or of
//! the direction from the planet to the Sun), up x reference, and up. Azimuth is right-handed about up from the reference,
//! elevation is toward up.

use super::ephemeris_at_time::EphemerisAtTime;
use super::moving::{MovingMatrix, MovingVector, fixed, spherical, unit, unit_normal};
use crate::enumeration::file_enumerations;

file_enumerations! {
    /// From which horizontal direction an azimuth about the local vertical counts.
    #[derive(Default)]
    pub enum AzimuthReference {
        /// The horizontal part of the velocity.
        #[default]
        1 => Downtrack,
        /// The horizontal part of the direction from the planet to the Sun.
        2 => Sun,
    }
}

/// Axes of the local frame as columns in EME2000; `None` where the reference has no horizontal part.
pub fn lvlh_axes(ephemeris: &EphemerisAtTime, reference: AzimuthReference) -> Option<MovingMatrix> {
    let toward = match reference {
        AzimuthReference::Downtrack => ephemeris.velocity,
        AzimuthReference::Sun => ephemeris.sun,
    };
    let up = unit(&ephemeris.position)?;
    let left = unit_normal(&ephemeris.position, &toward)?;
    Some(MovingMatrix::from_columns(&[left.cross(&up), left, up]))
}

/// EME2000 direction of an azimuth and elevation in the local frame.
pub fn lvlh_direction(
    ephemeris: &EphemerisAtTime,
    reference: AzimuthReference,
    azimuth_rad: f64,
    elevation_rad: f64,
) -> Option<MovingVector> {
    Some(lvlh_axes(ephemeris, reference)? * fixed(spherical(azimuth_rad, elevation_rad)))
}

#[cfg(test)]
mod tests {
    //! What the words say, in a geometry where the axes are known.
    use super::super::moving::{moving, rate, value};
    use super::*;
    use crate::guidance::tests::orbit::TestOrbit;
    use approx::assert_relative_eq;
    use core::f64::consts::FRAC_PI_2;
    use nalgebra::Vector3;

    /// Above +X, moving toward +Y and upward; the Sun in the X-Z plane.
    fn above_x() -> EphemerisAtTime {
        EphemerisAtTime {
            position: moving(Vector3::x() * 5e6, Vector3::new(100.0, 2000.0, 0.0)),
            velocity: moving(Vector3::new(100.0, 2000.0, 0.0), Vector3::x() * -0.8),
            sun: fixed(Vector3::new(-1e10, 0.0, 5e10)),
            ..TestOrbit::new(12.0).ephemeris(0.0)
        }
    }

    #[test]
    fn azimuth_counts_from_the_reference_about_up() {
        let direction = |reference, azimuth, elevation| {
            value(&lvlh_direction(&above_x(), reference, azimuth, elevation).unwrap())
        };
        let (downtrack, sun) = (AzimuthReference::Downtrack, AzimuthReference::Sun);
        assert_relative_eq!(direction(downtrack, 0.0, 0.0), Vector3::y(), epsilon = 1e-15);
        assert_relative_eq!(direction(downtrack, FRAC_PI_2, 0.0), Vector3::z(), epsilon = 1e-15);
        assert_relative_eq!(direction(sun, 0.0, 0.0), Vector3::z(), epsilon = 1e-15);
        assert_relative_eq!(direction(sun, FRAC_PI_2, 0.0), -Vector3::y(), epsilon = 1e-15);
        for reference in [downtrack, sun] {
            assert_relative_eq!(direction(reference, 1.0, FRAC_PI_2), Vector3::x(), epsilon = 1e-15);
            assert_relative_eq!(direction(reference, 2.0, -FRAC_PI_2), -Vector3::x(), epsilon = 1e-15);
        }
    }

    #[test]
    fn up_turns_with_the_orbit() {
        let axes = lvlh_axes(&above_x(), AzimuthReference::Downtrack).unwrap();
        let up_rate = rate(&axes.column(2).into_owned());
        assert_relative_eq!(up_rate, Vector3::y() * (2000.0 / 5e6), epsilon = 1e-15);
    }

    #[test]
    fn a_vertical_reference_gives_no_frame() {
        let above = above_x();
        let falling = EphemerisAtTime { velocity: fixed(Vector3::x() * -10.0), ..above };
        assert!(lvlh_axes(&falling, AzimuthReference::Downtrack).is_none());
        let noon = EphemerisAtTime { sun: fixed(Vector3::x() * 5e10), ..above };
        assert!(lvlh_axes(&noon, AzimuthReference::Sun).is_none());
        let without_position = EphemerisAtTime { position: fixed(Vector3::zeros()), ..above };
        assert!(lvlh_direction(&without_position, AzimuthReference::Sun, 0.0, 0.0).is_none());
    }
}

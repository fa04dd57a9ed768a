//! The body roll vector and the external roll reference (paper 001, Tables 3 and 4).
//!
//! Where none is commanded the scenarios' own hold (Table 5): -Y toward the Sun.

use nalgebra::Vector3;

use super::command::{BodyRollCommand, BodyRollOption, ExternalRollCommand, ExternalRollOption};
use crate::attitude::{SunAngles, direction_from_angles};
use crate::environment::frames::ecliptic_north;
use crate::guidance::geometry::ephemeris_at_time::EphemerisAtTime;
use crate::guidance::geometry::moving::{MovingVector, fixed, spherical};

/// The commanded body roll vector, body frame, of any length.
pub fn body_roll(command: &BodyRollCommand) -> MovingVector {
    fixed(match command.option {
        None => -Vector3::y(),
        Some(BodyRollOption::Vector) => command.vector,
        Some(BodyRollOption::AzimuthElevation) => direction_from_angles(SunAngles {
            azimuth_rad: command.azimuth_rad,
            elevation_rad: command.elevation_rad,
        }),
    })
}

/// The commanded external roll reference, from the spacecraft, EME2000, of any length.
pub fn external_roll(command: &ExternalRollCommand, ephemeris: &EphemerisAtTime) -> MovingVector {
    match command.option {
        Some(ExternalRollOption::Vector) => fixed(command.vector),
        Some(ExternalRollOption::RightAscensionDeclination) => {
            fixed(spherical(command.right_ascension_rad, command.declination_rad))
        }
        None | Some(ExternalRollOption::Sun) => ephemeris.to_sun(),
        Some(ExternalRollOption::Earth) => ephemeris.to_earth(),
        Some(ExternalRollOption::Planet) => ephemeris.to_planet(),
        Some(ExternalRollOption::Velocity) => ephemeris.velocity,
        Some(ExternalRollOption::OrbitNormal) => ephemeris.orbit_normal(),
        Some(ExternalRollOption::EclipticNorth) => fixed(ecliptic_north()),
    }
}

#[cfg(test)]
mod tests {
    //! Each option is the vector its name says.
    use super::*;
    use crate::guidance::geometry::moving::value;
    use crate::guidance::tests::orbit::TestOrbit;
    use approx::assert_relative_eq;
    use core::f64::consts::FRAC_PI_2;

    #[test]
    fn body_roll_is_minus_y_unless_commanded() {
        let roll = |option| {
            value(&body_roll(&BodyRollCommand {
                option,
                vector: Vector3::new(3.0, 1.0, 0.0),
                azimuth_rad: FRAC_PI_2,
                elevation_rad: 0.0,
            }))
        };
        assert_eq!(roll(None), -Vector3::y());
        assert_eq!(roll(Some(BodyRollOption::Vector)), Vector3::new(3.0, 1.0, 0.0));
        assert_relative_eq!(roll(Some(BodyRollOption::AzimuthElevation)), Vector3::x(), epsilon = 1e-15);
    }

    #[test]
    fn the_external_reference_is_the_sun_unless_commanded() {
        let s = TestOrbit::new(12.0).ephemeris(60.0);
        let roll = |option| {
            let command = ExternalRollCommand {
                option,
                vector: Vector3::new(3.0, 1.0, 0.0),
                right_ascension_rad: FRAC_PI_2,
                declination_rad: 0.0,
            };
            value(&external_roll(&command, &s))
        };
        assert_eq!(roll(None), value(&s.sun) - value(&s.position));
        assert_eq!(roll(Some(ExternalRollOption::Sun)), roll(None));
        assert_eq!(roll(Some(ExternalRollOption::Earth)), value(&s.earth) - value(&s.position));
        assert_eq!(roll(Some(ExternalRollOption::Planet)), -value(&s.position));
        assert_eq!(roll(Some(ExternalRollOption::Velocity)), value(&s.velocity));
        let momentum = value(&s.position).cross(&value(&s.velocity));
        assert_eq!(roll(Some(ExternalRollOption::OrbitNormal)), momentum);
        let north = Vector3::new(0.0, -0.397_777_155_931_914, 0.917_482_062_069_182);
        assert_relative_eq!(roll(Some(ExternalRollOption::EclipticNorth)), north, epsilon = 1e-14);
        assert_eq!(roll(Some(ExternalRollOption::Vector)), Vector3::new(3.0, 1.0, 0.0));
        let star = roll(Some(ExternalRollOption::RightAscensionDeclination));
        assert_relative_eq!(star, Vector3::y(), epsilon = 1e-15);
    }
}

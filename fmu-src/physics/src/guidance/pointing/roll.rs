//! The body roll vector and the external roll reference (paper 001, Tables 3 and 4) as tables.
//!
//! Where none is commanded the scenarios' own hold (Table 5): -Y toward the Sun.

use nalgebra::Vector3;

use super::aimpoint::celestial;
use super::command::{BodyRollCommand, BodyRollOption, ExternalRollCommand, ExternalRollOption};
use crate::attitude::{SunAngles, direction_from_angles};
use crate::guidance::geometry::ephemeris_at_time::EphemerisAtTime;
use crate::guidance::geometry::moving::{MovingVector, fixed};

/// The body roll vector of an option, body frame.
type BodyRollLaw = fn(&BodyRollCommand) -> Vector3<f64>;

/// The external roll reference of an option, from the spacecraft, EME2000.
type ExternalRollLaw = fn(&ExternalRollCommand, &EphemerisAtTime) -> MovingVector;

/// Every body roll option and its law, in the order of [`BodyRollOption`].
pub const BODY_ROLLS: [(BodyRollOption, BodyRollLaw); 2] = [
    (BodyRollOption::Vector, |c| c.vector),
    (BodyRollOption::AzimuthElevation, |c| {
        direction_from_angles(SunAngles { azimuth_rad: c.azimuth_rad, elevation_rad: c.elevation_rad })
    }),
];

/// Every external roll option and its law, in the order of [`ExternalRollOption`].
pub const EXTERNAL_ROLLS: [(ExternalRollOption, ExternalRollLaw); 5] = [
    (ExternalRollOption::Vector, |c, _| fixed(c.vector)),
    (ExternalRollOption::RightAscensionDeclination, |c, _| {
        fixed(celestial(c.right_ascension_rad, c.declination_rad))
    }),
    (ExternalRollOption::Sun, |_, s| s.to_sun()),
    (ExternalRollOption::Earth, |_, s| s.to_earth()),
    (ExternalRollOption::Planet, |_, s| s.to_planet()),
];

/// The commanded body roll vector, body frame, of any length.
pub fn body_roll(command: &BodyRollCommand) -> MovingVector {
    let law = BODY_ROLLS.iter().find(|(option, _)| Some(*option) == command.option);
    fixed(law.map_or(-Vector3::y(), |(_, law)| law(command)))
}

/// The commanded external roll reference, EME2000, of any length.
pub fn external_roll(command: &ExternalRollCommand, surroundings: &EphemerisAtTime) -> MovingVector {
    let law = EXTERNAL_ROLLS.iter().find(|(option, _)| Some(*option) == command.option);
    law.map_or_else(|| surroundings.to_sun(), |(_, law)| law(command, surroundings))
}

#[cfg(test)]
mod tests {
    //! Each option is the vector its name says.
    use super::*;
    use crate::guidance::geometry::moving::value;
    use crate::guidance::geometry::test_orbit::TestOrbit;
    use approx::assert_relative_eq;
    use core::f64::consts::FRAC_PI_2;

    #[test]
    fn the_tables_hold_every_option_once() {
        for (at, (option, _)) in BODY_ROLLS.iter().enumerate() {
            assert_eq!(*option as usize, at);
        }
        for (at, (option, _)) in EXTERNAL_ROLLS.iter().enumerate() {
            assert_eq!(*option as usize, at);
        }
    }

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
        let s = TestOrbit::new(12.0).surroundings(60.0);
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
        assert_eq!(roll(Some(ExternalRollOption::Vector)), Vector3::new(3.0, 1.0, 0.0));
        let star = roll(Some(ExternalRollOption::RightAscensionDeclination));
        assert_relative_eq!(star, Vector3::y(), epsilon = 1e-15);
    }
}

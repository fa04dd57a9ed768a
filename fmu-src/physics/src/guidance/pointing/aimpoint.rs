//! The aimpoint options of paper 001's Table 2 as one table, and any body.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::command::{AimpointCommand, AimpointOption, AzimuthReference};
use crate::bodies::Body;
use crate::guidance::geometry::ephemeris_at_time::EphemerisAtTime;
use crate::guidance::geometry::lighting::{SubsolarMethod, optimal_lighting_m, subsolar_m};
use crate::guidance::geometry::lvlh::lvlh_direction;
use crate::guidance::geometry::moving::{MovingVector, fixed, moving, value};
use crate::guidance::geometry::planet_point::{geographic_m, planet_fixed};

/// What an aim is, which decides how it can be scanned.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum AimKind {
    /// A direction in EME2000, infinitely far.
    Direction,
    /// A direction in a local frame.
    LocalDirection,
    /// A point in space, or a body.
    Point,
    /// The target planet, or a point that belongs to it.
    PlanetPoint,
}

impl AimKind {
    /// All kinds, in order.
    pub const ALL: [Self; 4] = [Self::Direction, Self::LocalDirection, Self::Point, Self::PlanetPoint];
}

/// Where to aim.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aim {
    /// From the spacecraft, EME2000: a direction of any length, or m to a point. Never zero, never NaN.
    pub toward: MovingVector,
    /// What it is.
    pub kind: AimKind,
    /// Whether it is what was requested, and no substitute.
    pub reachable: bool,
}

impl Aim {
    /// Toward a vector from the spacecraft; `None` where it has no direction.
    pub fn new(toward: MovingVector, kind: AimKind) -> Option<Self> {
        let finite = toward.iter().all(|x| x.re.is_finite() && x.eps.is_finite());
        (finite && value(&toward).amax() > 0.0).then_some(Self { toward, kind, reachable: true })
    }
}

/// The vector of an option from the spacecraft; `None` where it has none.
type AimpointLaw = fn(&AimpointCommand, &EphemerisAtTime, SubsolarMethod) -> Option<MovingVector>;

/// One option, its law, and what its aim is.
pub struct Aimpoint {
    /// The option.
    pub option: AimpointOption,
    /// Its law.
    law: AimpointLaw,
    /// What its aim is.
    pub kind: AimKind,
}

/// Every option, in the order of [`AimpointOption`].
pub const AIMPOINTS: [Aimpoint; 15] = {
    use AimKind::{Direction, LocalDirection, PlanetPoint, Point};
    use AimpointOption as Option;
    const fn row(option: Option, law: AimpointLaw, kind: AimKind) -> Aimpoint {
        Aimpoint { option, law, kind }
    }
    [
        row(Option::Vector, |c, _, _| Some(fixed(c.vector)), Direction),
        row(
            Option::RightAscensionDeclination,
            |c, _, _| Some(fixed(celestial(c.right_ascension_rad, c.declination_rad))),
            Direction,
        ),
        row(Option::EarthCentered, |c, s, _| Some(s.to_earth() + given(c)), Point),
        row(Option::SunCentered, |c, s, _| Some(s.to_sun() + given(c)), Point),
        row(Option::PlanetCentered, |c, s, _| Some(s.to_planet() + given(c)), PlanetPoint),
        row(Option::PlanetFixed, |c, s, _| Some(s.to_planet() + planet_fixed(s, &given(c))), PlanetPoint),
        row(Option::LatitudeLongitude, latitude_longitude, PlanetPoint),
        row(Option::LvlhDowntrack, |c, s, _| lvlh(c, s, AzimuthReference::Downtrack), LocalDirection),
        row(Option::LvlhSun, |c, s, _| lvlh(c, s, AzimuthReference::Sun), LocalDirection),
        row(Option::Sun, |_, s, _| Some(s.to_sun()), Point),
        row(Option::Earth, |_, s, _| Some(s.to_earth()), Point),
        row(Option::Nadir, |_, s, _| Some(s.to_planet()), PlanetPoint),
        row(Option::Subsolar, |_, s, method| Some(s.to_planet() + subsolar_m(s, method)?), PlanetPoint),
        row(Option::OptimalLighting, |_, s, _| Some(s.to_planet() + optimal_lighting_m(s)?), PlanetPoint),
        row(Option::Body, |c, s, _| c.body.map(|body| to_body(s, body)), Point),
    ]
};

/// The commanded aim; `None` where nothing is commanded or it has no direction, such as a zero vector or a body whose place
/// is not known.
pub fn aimpoint(
    command: &AimpointCommand,
    surroundings: &EphemerisAtTime,
    method: SubsolarMethod,
) -> Option<Aim> {
    let option = command.option?;
    let row = AIMPOINTS.iter().find(|row| row.option == option)?;
    Aim::new((row.law)(command, surroundings, method)?, row.kind)
}

/// Unit vector of right ascension and declination, EME2000.
pub fn celestial(right_ascension_rad: f64, declination_rad: f64) -> Vector3<f64> {
    let (sin_ra, cos_ra) = right_ascension_rad.sin_cos();
    let (sin_dec, cos_dec) = declination_rad.sin_cos();
    Vector3::new(cos_dec * cos_ra, cos_dec * sin_ra, sin_dec)
}

/// The position that is given, with its motion.
fn given(command: &AimpointCommand) -> MovingVector {
    moving(command.position_m, command.velocity_m_s)
}

fn latitude_longitude(
    command: &AimpointCommand,
    surroundings: &EphemerisAtTime,
    _: SubsolarMethod,
) -> Option<MovingVector> {
    let radii_m = &surroundings.planet.radii_m;
    let at_m = geographic_m(radii_m, command.latitude_rad, command.longitude_rad, command.height_m);
    Some(surroundings.to_planet() + planet_fixed(surroundings, &fixed(at_m)))
}

fn lvlh(
    command: &AimpointCommand,
    surroundings: &EphemerisAtTime,
    reference: AzimuthReference,
) -> Option<MovingVector> {
    lvlh_direction(surroundings, reference, command.azimuth_rad, command.elevation_rad)
}

fn to_body(surroundings: &EphemerisAtTime, body: Body) -> MovingVector {
    match body {
        Body::Sun => surroundings.to_sun(),
        Body::Earth => surroundings.to_earth(),
        other => surroundings.to_body(other),
    }
}

#[cfg(test)]
mod tests {
    //! Every option against positions and angles known by other means.
    use super::super::scenario_tests::aimpoint as command;
    use super::*;
    use crate::guidance::geometry::moving::matrix_value;
    use crate::guidance::geometry::test_orbit::TestOrbit;
    use approx::assert_relative_eq;

    #[test]
    fn the_table_holds_every_option_once() {
        for (at, row) in AIMPOINTS.iter().enumerate() {
            assert_eq!(row.option as usize, at);
        }
    }

    #[test]
    fn every_option_has_a_direction_and_the_points_are_where_they_are_said_to_be() {
        use AimpointOption as Option;
        let s = TestOrbit::new(12.0).surroundings(700.0);
        let spacecraft = value(&s.position);
        let toward = |option| {
            let aim = aimpoint(&command(option), &s, SubsolarMethod::Line).unwrap();
            assert!(aim.reachable);
            value(&aim.toward)
        };
        let c = command(Option::Vector);
        let place = |option| toward(option) + spacecraft;
        let near = |found: Vector3<f64>, expected: Vector3<f64>| {
            assert_relative_eq!(found, expected, max_relative = 1e-13, epsilon = 1e-13);
        };
        near(toward(Option::Vector), c.vector);
        let star = toward(Option::RightAscensionDeclination);
        near(Vector3::new(star.y.atan2(star.x), star.z.asin(), star.norm()), Vector3::new(1.1, -0.4, 1.0));
        assert_relative_eq!(
            place(Option::EarthCentered),
            value(&s.earth) + command(Option::EarthCentered).position_m,
            epsilon = 1e-4
        );
        assert_relative_eq!(
            place(Option::SunCentered),
            value(&s.sun) + command(Option::SunCentered).position_m,
            epsilon = 1e-4
        );
        assert_relative_eq!(
            place(Option::PlanetCentered),
            command(Option::PlanetCentered).position_m,
            epsilon = 1e-8
        );
        let to_planet = matrix_value(&s.planet.planet_from_inertial(s.epoch_s));
        assert_relative_eq!(
            to_planet * place(Option::PlanetFixed),
            command(Option::PlanetFixed).position_m,
            epsilon = 1e-8
        );
        let ground = to_planet * place(Option::LatitudeLongitude);
        assert_relative_eq!(ground.z.atan2(ground.x.hypot(ground.y)), 0.3, epsilon = 1e-14);
        assert_relative_eq!(ground.y.atan2(ground.x), -2.0, epsilon = 1e-14);
        let up = spacecraft.normalize();
        for option in [Option::LvlhDowntrack, Option::LvlhSun] {
            assert_relative_eq!(toward(option).dot(&up), (-0.6_f64).sin(), epsilon = 1e-14);
        }
        assert_relative_eq!(place(Option::Sun), value(&s.sun), epsilon = 1e-4);
        assert_relative_eq!(place(Option::Earth), value(&s.earth), epsilon = 1e-4);
        assert_relative_eq!(place(Option::Nadir), Vector3::zeros(), epsilon = 1e-8);
        assert_relative_eq!(place(Option::Subsolar).normalize(), value(&s.sun).normalize(), epsilon = 1e-14);
        assert_relative_eq!(place(Option::OptimalLighting).norm(), s.planet.radii_m.x, epsilon = 1e-8);
        assert_relative_eq!(
            place(Option::Body),
            value(&s.bodies[Body::Venus as usize].unwrap()),
            epsilon = 1e-4
        );
    }

    #[test]
    fn an_aim_without_direction_is_none() {
        let s = TestOrbit::new(12.0).surroundings(700.0);
        let none = |command: AimpointCommand, s: &EphemerisAtTime| {
            assert!(aimpoint(&command, s, SubsolarMethod::Normal).is_none(), "{:?}", command.option);
        };
        none(AimpointCommand::default(), &s);
        none(AimpointCommand { option: Some(AimpointOption::Vector), ..AimpointCommand::default() }, &s);
        none(
            AimpointCommand { body: Some(Body::Mars), ..command(AimpointOption::Body) },
            &EphemerisAtTime { bodies: [None; 6], ..s },
        );
        none(AimpointCommand { vector: Vector3::repeat(f64::NAN), ..command(AimpointOption::Vector) }, &s);
        let mut flat = s;
        flat.planet.radii_m = Vector3::zeros();
        for option in [AimpointOption::Subsolar, AimpointOption::OptimalLighting] {
            none(command(option), &flat);
        }
        let without_position = EphemerisAtTime { position: MovingVector::zeros(), ..s };
        for option in [AimpointOption::Nadir, AimpointOption::LvlhSun, AimpointOption::OptimalLighting] {
            none(command(option), &without_position);
        }
    }
}

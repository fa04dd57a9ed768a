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
mod tests;

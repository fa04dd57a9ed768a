//! The aimpoint options of paper 001's Table 2, and any body.

use serde::{Deserialize, Serialize};

use super::command::{AimpointCommand, AimpointOption, AzimuthReference};
use crate::bodies::Body;
use crate::guidance::geometry::ephemeris_at_time::EphemerisAtTime;
use crate::guidance::geometry::lighting::{SubsolarMethod, optimal_lighting_m, subsolar_m};
use crate::guidance::geometry::lvlh::lvlh_direction;
use crate::guidance::geometry::moving::{MovingVector, fixed, moving, spherical, value};
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

/// What the aim of an option is.
pub fn aim_kind(option: AimpointOption) -> AimKind {
    match option {
        AimpointOption::Vector | AimpointOption::RightAscensionDeclination => AimKind::Direction,
        AimpointOption::LvlhDowntrack | AimpointOption::LvlhSun => AimKind::LocalDirection,
        AimpointOption::EarthCentered
        | AimpointOption::SunCentered
        | AimpointOption::Sun
        | AimpointOption::Earth
        | AimpointOption::Body => AimKind::Point,
        AimpointOption::PlanetCentered
        | AimpointOption::PlanetFixed
        | AimpointOption::LatitudeLongitude
        | AimpointOption::Nadir
        | AimpointOption::Subsolar
        | AimpointOption::OptimalLighting => AimKind::PlanetPoint,
    }
}

/// The commanded aim; `None` where nothing is commanded or it has no direction, such as a zero vector or a body whose place
/// is not known.
pub fn aimpoint(
    command: &AimpointCommand,
    surroundings: &EphemerisAtTime,
    method: SubsolarMethod,
) -> Option<Aim> {
    let option = command.option?;
    let position = moving(command.position_m, command.velocity_m_s);
    let lvlh =
        |reference| lvlh_direction(surroundings, reference, command.azimuth_rad, command.elevation_rad);
    let toward = match option {
        AimpointOption::Vector => fixed(command.vector),
        AimpointOption::RightAscensionDeclination => {
            fixed(spherical(command.right_ascension_rad, command.declination_rad))
        }
        AimpointOption::EarthCentered => surroundings.to_earth() + position,
        AimpointOption::SunCentered => surroundings.to_sun() + position,
        AimpointOption::PlanetCentered => surroundings.to_planet() + position,
        AimpointOption::PlanetFixed => surroundings.to_planet() + planet_fixed(surroundings, &position),
        AimpointOption::LatitudeLongitude => {
            let at_m = geographic_m(
                &surroundings.planet.radii_m,
                command.latitude_rad,
                command.longitude_rad,
                command.height_m,
            );
            surroundings.to_planet() + planet_fixed(surroundings, &fixed(at_m))
        }
        AimpointOption::LvlhDowntrack => lvlh(AzimuthReference::Downtrack)?,
        AimpointOption::LvlhSun => lvlh(AzimuthReference::Sun)?,
        AimpointOption::Sun => surroundings.to_sun(),
        AimpointOption::Earth => surroundings.to_earth(),
        AimpointOption::Nadir => surroundings.to_planet(),
        AimpointOption::Subsolar => surroundings.to_planet() + subsolar_m(surroundings, method)?,
        AimpointOption::OptimalLighting => surroundings.to_planet() + optimal_lighting_m(surroundings)?,
        AimpointOption::Body => match command.body? {
            Body::Sun => surroundings.to_sun(),
            Body::Earth => surroundings.to_earth(),
            other => surroundings.to_body(other),
        },
    };
    Aim::new(toward, aim_kind(option))
}

#[cfg(test)]
mod tests;

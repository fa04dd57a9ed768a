//! The aimpoint options of paper 001's Table 2, and any body; the body roll vector and the external roll reference (Tables 3 and 4).
//!
//! Where no roll is commanded the scenarios' own hold (Table 5): -Y toward the Sun.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::command::{
    AimpointCommand, AimpointOption, BodyRollCommand, BodyRollOption, ExternalRollCommand, ExternalRollOption,
};
use crate::attitude::{SunAngles, direction_from_angles};
use crate::bodies::Body;
use crate::environment::frames::ecliptic_north;
use crate::guidance::geometry::ephemeris_at_time::EphemerisAtTime;
use crate::guidance::geometry::lighting::{SubsolarMethod, optimal_lighting_m, subsolar_m};
use crate::guidance::geometry::lvlh::{AzimuthReference, lvlh_direction};
use crate::guidance::geometry::moving::{MovingVector, fixed, moving, spherical, value};
use crate::guidance::geometry::planet_point::{geographic_m, planet_fixed};

/// Kind of an aimpoint, which decides how it can be scanned.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum AimpointKind {
    /// A direction in EME2000, infinitely far.
    Direction,
    /// A direction in a local frame.
    LocalDirection,
    /// A point in space, or a body.
    Point,
    /// The target planet, or a point that belongs to it.
    PlanetPoint,
}

/// An aimpoint as a vector from the spacecraft.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aimpoint {
    /// From the spacecraft, EME2000: a direction of any length, or m to a point. Never zero, never NaN.
    pub toward: MovingVector,
    /// Kind of the aimpoint.
    pub kind: AimpointKind,
    /// Whether it is what was requested, and no substitute.
    pub reachable: bool,
}

impl Aimpoint {
    /// Toward a vector from the spacecraft; `None` where it has no direction.
    pub fn new(toward: MovingVector, kind: AimpointKind) -> Option<Self> {
        let finite = toward.iter().all(|x| x.re.is_finite() && x.eps.is_finite());
        (finite && value(&toward).amax() > 0.0).then_some(Self { toward, kind, reachable: true })
    }
}

/// Kind of an option's aimpoint.
pub fn aimpoint_kind(option: AimpointOption) -> AimpointKind {
    match option {
        AimpointOption::Vector
        | AimpointOption::RightAscensionDeclination
        | AimpointOption::EclipticNorth => AimpointKind::Direction,
        AimpointOption::LvlhDowntrack
        | AimpointOption::LvlhSun
        | AimpointOption::Velocity
        | AimpointOption::OrbitNormal => AimpointKind::LocalDirection,
        AimpointOption::EarthCentered
        | AimpointOption::SunCentered
        | AimpointOption::Sun
        | AimpointOption::Earth
        | AimpointOption::Body => AimpointKind::Point,
        AimpointOption::PlanetCentered
        | AimpointOption::PlanetFixed
        | AimpointOption::LatitudeLongitude
        | AimpointOption::Nadir
        | AimpointOption::Subsolar
        | AimpointOption::OptimalLighting => AimpointKind::PlanetPoint,
    }
}

/// The commanded aimpoint; `None` where nothing is commanded or it has no direction, such as a zero vector or a body whose place
/// is not known.
pub fn aimpoint(
    command: &AimpointCommand,
    ephemeris: &EphemerisAtTime,
    method: SubsolarMethod,
) -> Option<Aimpoint> {
    let option = command.option?;
    let position = moving(command.position_m, command.velocity_m_s);
    let lvlh = |reference| lvlh_direction(ephemeris, reference, command.azimuth_rad, command.elevation_rad);
    let toward = match option {
        AimpointOption::Vector => fixed(command.vector),
        AimpointOption::RightAscensionDeclination => {
            fixed(spherical(command.right_ascension_rad, command.declination_rad))
        }
        AimpointOption::EarthCentered => ephemeris.to_earth() + position,
        AimpointOption::SunCentered => ephemeris.to_sun() + position,
        AimpointOption::PlanetCentered => ephemeris.to_planet() + position,
        AimpointOption::PlanetFixed => ephemeris.to_planet() + planet_fixed(ephemeris, &position),
        AimpointOption::LatitudeLongitude => {
            let AimpointCommand { latitude_rad, longitude_rad, height_m, .. } = *command;
            let at_m = geographic_m(&ephemeris.planet.radii_m, latitude_rad, longitude_rad, height_m);
            ephemeris.to_planet() + planet_fixed(ephemeris, &fixed(at_m))
        }
        AimpointOption::LvlhDowntrack => lvlh(AzimuthReference::Downtrack)?,
        AimpointOption::LvlhSun => lvlh(AzimuthReference::Sun)?,
        AimpointOption::Sun => ephemeris.to_sun(),
        AimpointOption::Earth => ephemeris.to_earth(),
        AimpointOption::Nadir => ephemeris.to_planet(),
        AimpointOption::Subsolar => ephemeris.to_planet() + subsolar_m(ephemeris, method)?,
        AimpointOption::OptimalLighting => ephemeris.to_planet() + optimal_lighting_m(ephemeris)?,
        AimpointOption::Body => match command.body? {
            Body::Sun => ephemeris.to_sun(),
            Body::Earth => ephemeris.to_earth(),
            other => ephemeris.to_body(other),
        },
        AimpointOption::Velocity => ephemeris.velocity,
        AimpointOption::OrbitNormal => ephemeris.orbit_normal(),
        AimpointOption::EclipticNorth => fixed(ecliptic_north()),
    };
    Aimpoint::new(toward, aimpoint_kind(option))
}

/// The commanded body roll vector, body frame, of any length.
pub fn body_roll(command: &BodyRollCommand) -> MovingVector {
    fixed(match command.option {
        None => -Vector3::y(),
        Some(BodyRollOption::Vector) => command.vector,
        Some(BodyRollOption::AzimuthElevation) => {
            let BodyRollCommand { azimuth_rad, elevation_rad, .. } = *command;
            direction_from_angles(SunAngles { azimuth_rad, elevation_rad })
        }
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
mod tests;

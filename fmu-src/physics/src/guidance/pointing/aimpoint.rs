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
pub fn aimpoint(c: &AimpointCommand, s: &EphemerisAtTime, method: SubsolarMethod) -> Option<Aim> {
    let option = c.option?;
    let position = moving(c.position_m, c.velocity_m_s);
    let lvlh = |reference| lvlh_direction(s, reference, c.azimuth_rad, c.elevation_rad);
    let toward = match option {
        AimpointOption::Vector => fixed(c.vector),
        AimpointOption::RightAscensionDeclination => {
            fixed(spherical(c.right_ascension_rad, c.declination_rad))
        }
        AimpointOption::EarthCentered => s.to_earth() + position,
        AimpointOption::SunCentered => s.to_sun() + position,
        AimpointOption::PlanetCentered => s.to_planet() + position,
        AimpointOption::PlanetFixed => s.to_planet() + planet_fixed(s, &position),
        AimpointOption::LatitudeLongitude => {
            let at_m = geographic_m(&s.planet.radii_m, c.latitude_rad, c.longitude_rad, c.height_m);
            s.to_planet() + planet_fixed(s, &fixed(at_m))
        }
        AimpointOption::LvlhDowntrack => lvlh(AzimuthReference::Downtrack)?,
        AimpointOption::LvlhSun => lvlh(AzimuthReference::Sun)?,
        AimpointOption::Sun => s.to_sun(),
        AimpointOption::Earth => s.to_earth(),
        AimpointOption::Nadir => s.to_planet(),
        AimpointOption::Subsolar => s.to_planet() + subsolar_m(s, method)?,
        AimpointOption::OptimalLighting => s.to_planet() + optimal_lighting_m(s)?,
        AimpointOption::Body => match c.body? {
            Body::Sun => s.to_sun(),
            Body::Earth => s.to_earth(),
            other => s.to_body(other),
        },
    };
    Aim::new(toward, aim_kind(option))
}

#[cfg(test)]
mod tests;

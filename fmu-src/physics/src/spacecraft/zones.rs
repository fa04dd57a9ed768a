//! Zones of directions: those the Sun may have, and the one above the hot subsolar point in which the top deck keeps away from the planet.

use serde::Serialize;

use crate::toml::{HalfTurn, Kilometers, Positive, QuarterTurn, tables};

tables! {
/// Directions the Sun may have, symmetric about -Y.
struct SunKeepInDescription makes #[derive(Clone, Copy, Debug, PartialEq, Serialize)] pub struct SunKeepIn {
    /// Greatest azimuth in the XY plane from -Y toward +X, in deg.
    azimuth_deg as azimuth_rad: HalfTurn,
    /// Greatest elevation from the XY plane toward -Z, in deg.
    elevation_deg as elevation_rad: QuarterTurn,
    /// Greatest distance from the Sun at which commands of Guidance keep the zone, in m; any unless given.
    distance_m: Positive => |_| SunKeepIn::FARTHEST_M,
}

/// Zone in which the top deck, -Z, does not look at the planet: low above its subsolar point, which is hot. Guidance keeps it; left
/// out, `hotPole.enabled` is false.
struct HotPoleDescription makes #[derive(Clone, Copy, Debug, PartialEq, Serialize)] pub struct HotPoleZone {
    /// Below this height above the ellipsoid, in km.
    altitude_km as altitude_m: Kilometers,
    /// Within this angle from the subsolar point, in deg.
    angle_deg as angle_rad: HalfTurn,
    /// Least angle between -Z and the direction to the planet's centre, in deg.
    cone_deg as cone_rad: HalfTurn,
}
}

impl SunKeepIn {
    /// A distance from the Sun that no spacecraft has, in m.
    pub const FARTHEST_M: f64 = 1e13;

    /// The smaller of all limits.
    #[must_use]
    pub fn within(&self, other: &Self) -> Self {
        Self {
            azimuth_rad: self.azimuth_rad.min(other.azimuth_rad),
            elevation_rad: self.elevation_rad.min(other.elevation_rad),
            distance_m: self.distance_m.min(other.distance_m),
        }
    }
}

//! Zone above the planet's hot subsolar point in which the top deck keeps away from the planet.

use serde::Serialize;

/// The hot pole: low above the subsolar point.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct HotPoleZone {
    /// Below this height above the ellipsoid, in m.
    pub altitude_m: f64,
    /// Within this angle from the subsolar point, in rad.
    pub angle_rad: f64,
    /// Least angle between -Z and the direction to the planet's centre, in rad.
    pub cone_rad: f64,
}

//! Where +Z passes the limb of a triaxial planet, found from the attitude alone.

use super::disc::View;
use super::flight::PointingSample;
use super::planet::Ellipsoid;
use crate::attitude::Vector;
use crate::settings::{Settings, set};

pub(super) const PLUS_Z: Vector = Vector::new(0.0, 0.0, 1.0);
/// Assumed, close to the planet's figure; the default is a sphere: so that the limb is that of a triaxial ellipsoid, in m.
const RADII_M: [f64; 3] = [2_440_530.0, 2_439_280.0, 2_438_260.0];

/// The planet's radii as settings.
pub(super) fn triaxial() -> Settings {
    set("planet.radii", RADII_M)
}

/// Where +Z passes the limb, found from the attitude alone.
pub(super) struct Found {
    /// The limb point, from the planet's centre, in m.
    pub foot_m: Vector,
    /// The line's height over it, in m.
    pub height_m: f64,
    /// About the local vertical from downtrack, in deg.
    pub azimuth_deg: f64,
    /// Of the Sun in the body frame, in deg.
    pub sun_deg: [f64; 2],
    /// From nadir, in deg.
    pub off_nadir_deg: f64,
}

impl Found {
    pub(super) fn of(sample: &PointingSample, ellipsoid: &Ellipsoid) -> Option<Self> {
        let boresight = sample.inertial(&PLUS_Z);
        let view = View::at(&sample.place);
        let (foot_m, height_m) = ellipsoid.height_over_limb_m(&sample.place.position_m, &boresight)?;
        let (x, y) = view.direction(&boresight);
        Some(Self {
            foot_m,
            height_m,
            azimuth_deg: view.azimuth_deg(&boresight),
            sun_deg: sample.body_angles_deg(&sample.place.to_sun_m),
            off_nadir_deg: x.hypot(y),
        })
    }
}

//! Viewing geometry of the planet from the spacecraft: distance, limb and the frame of nadir and Sun.

use nalgebra::Vector3;

use super::arcs::Azimuth;
use crate::numerics::scalar::{Scalar, ln};
use crate::refusal::Refusal;

/// A planet of parallel sunlight, seen from the spacecraft's reference point; all vectors in one frame.
#[derive(Clone, Copy, Debug)]
pub struct PlanetView<T: Scalar> {
    /// Unit vector toward the planet's centre.
    pub nadir: Vector3<T>,
    /// Unit vector that completes the right-handed frame (east, north, nadir).
    pub(super) east: Vector3<T>,
    /// See `east`.
    pub(super) north: Vector3<T>,
    /// Distance of the planet's centre in m.
    pub distance_m: T,
    /// Radius of the planet in m.
    pub radius_m: T,
    /// Unit vector from the planet toward the Sun.
    pub sun: Vector3<T>,
    /// The same along east, north, nadir.
    pub(super) sun_local: Vector3<T>,
    pub(super) sun_azimuth: Azimuth<T>,
    /// Length of its horizontal part.
    pub(super) sun_reach: T,
    /// Distance over radius.
    pub(super) relative_distance: T,
    /// Distance of the limb over radius, and its square.
    pub(super) limb: T,
    pub(super) limb_squared: T,
    /// Logarithm of the altitude over the limb's distance: where the rings begin. The limb is at 0.
    pub(super) nearest: T,
    /// The ring where the terminator begins, if any ring sees it.
    pub(super) terminator: Option<T>,
}

impl<T: Scalar> PlanetView<T> {
    /// The view of a planet `planet_m` away, whose Sun stands `sun_from_planet_m` from its centre.
    ///
    /// # Errors
    /// When the spacecraft is not above the surface, when the Sun has no direction, when anything is not finite.
    pub fn new(planet_m: &Vector3<T>, sun_from_planet_m: &Vector3<T>, radius_m: T) -> Result<Self, Refusal> {
        let distance_m = planet_m.dot(planet_m).sqrt();
        let sun_distance_m = sun_from_planet_m.dot(sun_from_planet_m).sqrt();
        let above = distance_m.value() > radius_m.value() && radius_m.value() > 0.0;
        if !(above && distance_m.value().is_finite()) {
            let (distance_m, radius_m) = (distance_m.value(), radius_m.value());
            let found = format_args!("spacecraft {distance_m} m from the planet's centre");
            return Err(Refusal::new(found, format_args!("more than its radius of {radius_m} m")));
        }
        if !(sun_distance_m.value() > 0.0 && sun_distance_m.value().is_finite()) {
            let sun_distance_m = sun_distance_m.value();
            let found = format_args!("Sun {sun_distance_m} m from the planet's centre");
            return Err(Refusal::new(found, "a finite distance above 0 m"));
        }
        let nadir = planet_m / distance_m;
        let sun = sun_from_planet_m / sun_distance_m;
        let (east, north) = horizon(&nadir);
        let sun_local = Vector3::new(sun.dot(&east), sun.dot(&north), sun.dot(&nadir));
        let (sun_azimuth, sun_reach) = Azimuth::with_length(sun_local.x, sun_local.y);
        let relative_distance = distance_m / radius_m;
        let limb_squared = (relative_distance - 1.0) * (relative_distance + 1.0);
        let limb = limb_squared.sqrt();
        // sin(gamma) = |cos(Z)|, cos(gamma) = sin(Z), gamma at the planet's centre.
        let t_squared = relative_distance * relative_distance + 1.0 - relative_distance * sun_reach * 2.0;
        let sees_terminator = t_squared.value() > 0.0 && t_squared.value() < limb_squared.value();
        Ok(Self {
            nadir,
            east,
            north,
            distance_m,
            radius_m,
            sun,
            sun_local,
            sun_azimuth,
            sun_reach,
            relative_distance,
            limb,
            limb_squared,
            nearest: ln((relative_distance - 1.0) / limb),
            terminator: sees_terminator.then(|| ln(t_squared / limb_squared) * 0.5),
        })
    }

    /// Components along east, north, nadir.
    #[inline]
    pub(super) fn local(&self, v: &Vector3<T>) -> Vector3<T> {
        Vector3::new(v.dot(&self.east), v.dot(&self.north), v.dot(&self.nadir))
    }

    /// The vector with these components along east, north, nadir.
    #[inline]
    pub(super) fn unlocal(&self, v: &Vector3<T>) -> Vector3<T> {
        self.east * v.x + self.north * v.y + self.nadir * v.z
    }
}

/// Two unit vectors that make a right-handed frame with `up`, a smooth function of it but for the switch of
/// the axis they are built from.
fn horizon<T: Scalar>(up: &Vector3<T>) -> (Vector3<T>, Vector3<T>) {
    let axis: Vector3<f64> = if up.z.value().abs() < 0.7 { Vector3::z() } else { Vector3::x() };
    let east = axis.map(T::constant).cross(up);
    let east = east / east.dot(&east).sqrt();
    (east, up.cross(&east))
}

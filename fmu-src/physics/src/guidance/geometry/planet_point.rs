//! Points that turn with the target planet: along its axes, and by latitude, longitude and height.
//!
//! Latitude is planetocentric, longitude east positive; height counts along the radius from the ellipsoid's surface, which
//! is not the surface normal unless the planet is a sphere.

use nalgebra::Vector3;

use super::ephemeris_at_time::EphemerisAtTime;
use super::moving::{MovingVector, spherical};
use crate::numerics::scalar::Scalar;

/// Distance from the centre to the ellipsoid in a direction of unit length along the planet's axes, in m.
pub fn radius_m<T: Scalar>(radii_m: &Vector3<f64>, direction: &Vector3<T>) -> T {
    let scaled = direction.zip_map(radii_m, |component, radius_m| component / radius_m);
    T::constant(1.0) / scaled.dot(&scaled).sqrt()
}

/// Planet-axes position of latitude, longitude and height above the ellipsoid, in m.
pub fn geographic_m(
    radii_m: &Vector3<f64>,
    latitude_rad: f64,
    longitude_rad: f64,
    height_m: f64,
) -> Vector3<f64> {
    let direction = spherical(longitude_rad, latitude_rad);
    direction * (radius_m(radii_m, &direction) + height_m)
}

/// EME2000 position from the planet's centre of a point given along the planet's axes, in m.
pub fn planet_fixed(ephemeris: &EphemerisAtTime, position_planet: &MovingVector) -> MovingVector {
    let planet_from_inertial = ephemeris.planet.planet_from_inertial(ephemeris.epoch_s);
    planet_from_inertial.tr_mul(position_planet)
}

#[cfg(test)]
mod tests {
    //! Against closed forms of poles, equator and rotation.
    use super::super::moving::{fixed, rate, value};
    use super::*;
    use crate::bodies::Body;
    use crate::guidance::tests::orbit::TestOrbit;
    use approx::assert_relative_eq;
    use core::f64::consts::{FRAC_PI_2, FRAC_PI_4};

    const RADII_M: Vector3<f64> = Vector3::new(2.5e6, 2.4e6, 2.3e6);

    #[test]
    fn axes_of_the_ellipsoid_are_at_their_radii() {
        let at = |lat, lon, height| geographic_m(&RADII_M, lat, lon, height);
        assert_relative_eq!(at(0.0, 0.0, 10.0), Vector3::x() * 2_500_010.0, epsilon = 1e-8);
        assert_relative_eq!(at(0.0, FRAC_PI_2, 0.0), Vector3::y() * 2.4e6, epsilon = 1e-8);
        assert_relative_eq!(at(-FRAC_PI_2, 1.0, 5.0), Vector3::z() * -2_300_005.0, epsilon = 1e-8);
    }

    #[test]
    fn a_middle_latitude_is_at_the_radius_of_the_meridian_ellipse() {
        // r = a c / sqrt((c cos)^2 + (a sin)^2), and the angles come back by the arc tangent.
        let (a, c) = (RADII_M.x, RADII_M.z);
        let at = geographic_m(&RADII_M, FRAC_PI_4, 0.0, 1000.0);
        assert_relative_eq!(at.norm(), a * c * (2.0 / (a * a + c * c)).sqrt() + 1000.0, epsilon = 1e-8);
        for (latitude, longitude) in [(0.3, 2.0), (-1.2, -3.0), (0.9, 0.1)] {
            let at = geographic_m(&RADII_M, latitude, longitude, -2e4);
            assert_relative_eq!(at.z.atan2(at.x.hypot(at.y)), latitude, epsilon = 1e-14);
            assert_relative_eq!(at.y.atan2(at.x), longitude, epsilon = 1e-14);
        }
    }

    #[test]
    fn a_point_turns_eastward_about_the_pole() {
        let ephemeris = TestOrbit::new(12.0).ephemeris(100.0);
        let planet = Body::Mercury.data();
        let (sin_ra, cos_ra) = planet.pole_right_ascension_rad.sin_cos();
        let (sin_dec, cos_dec) = planet.pole_declination_rad.sin_cos();
        let pole = Vector3::new(cos_ra * cos_dec, sin_ra * cos_dec, sin_dec);
        for at in [Vector3::new(1e6, 2e6, 3e5), Vector3::new(-2e6, 1e5, -1e6)] {
            let point = planet_fixed(&ephemeris, &fixed(at));
            assert_relative_eq!(value(&point).dot(&pole), at.z, epsilon = 1e-7);
            assert_relative_eq!(value(&point).norm(), at.norm(), epsilon = 1e-7);
            let expected = pole.cross(&value(&point)) * planet.rotation_rate_rad_s;
            assert_relative_eq!(rate(&point), expected, epsilon = 1e-12);
        }
        // The prime meridian stands W east of the node of the equator, which lies 90 deg east of the pole.
        let node = Vector3::new(-sin_ra, cos_ra, 0.0);
        let turned = planet.prime_meridian_rad + planet.rotation_rate_rad_s * ephemeris.epoch_s;
        let expected = node * turned.cos() + pole.cross(&node) * turned.sin();
        let found = value(&planet_fixed(&ephemeris, &fixed(Vector3::x())));
        assert_relative_eq!(found, expected, epsilon = 1e-12);
    }
}

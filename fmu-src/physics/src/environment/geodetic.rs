//! Latitude, longitude and height over a planet's ellipsoid of revolution.
//!
//! Equation: p sin(u) - (1 - f) z cos(u) = e^2 a sin(u) cos(u) with the reduced latitude u of the foot of the normal;
//! tan(latitude) = tan(u) / (1 - f); height = p cos(latitude) + z sin(latitude) - a sqrt(1 - e^2 sin^2(latitude)).
//! Method: Halley's iteration for u by its sine and cosine, so that the pole is regular, from that of a point on the ellipsoid.
//! Order: cubic.
//! Error measure: the last correction, whose third power is below rounding, within six iterations; at rounding for flattenings
//! from -0.3 to 0.5.
//! Reference: Fukushima, Transformation from Cartesian to geodetic coordinates accelerated by Halley's method, Journal of
//! Geodesy 79, 2006.

use nalgebra::{Matrix3, Vector3};
use serde::{Deserialize, Serialize};

use crate::math;

/// Largest number of iterations; two suffice on the Earth.
const ITERATIONS: usize = 6;
/// A correction below this, in rad, ends the iteration.
const LAST_CORRECTION_RAD: f64 = 3e-6;

/// An ellipsoid of revolution.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Ellipsoid {
    /// Radius of its equator, in m.
    pub equatorial_radius_m: f64,
    /// 1 less the ratio of polar to equatorial radius.
    pub flattening: f64,
}

/// Geodetic coordinates on an ellipsoid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Geodetic {
    /// Latitude of the normal, in rad.
    pub latitude_rad: f64,
    /// Longitude, east, -pi to pi, in rad.
    pub longitude_rad: f64,
    /// Height along the normal, in m.
    pub height_m: f64,
}

impl Ellipsoid {
    /// Geodetic coordinates of a position in the planet-fixed frame, in m.
    pub fn geodetic(&self, position_fixed_m: &Vector3<f64>) -> Geodetic {
        let [[x, y, z]] = position_fixed_m.data.0;
        let (axial_m, share) = ((x * x + y * y).sqrt(), 1.0 - self.flattening);
        let square = self.flattening * (2.0 - self.flattening);
        let unit = |sine: f64, cosine: f64| {
            let length = (sine * sine + cosine * cosine).sqrt();
            if length > 0.0 { [sine / length, cosine / length] } else { [0.0, 1.0] }
        };
        let mut reduced = unit(z, axial_m * share);
        let (along_m, evolute_m) = (share * z, self.equatorial_radius_m * square);
        // On a sphere latitude and reduced latitude are one.
        for _ in 0..if square == 0.0 { 0 } else { ITERATIONS } {
            let [sine, cosine] = reduced;
            let product_m = evolute_m * sine * cosine;
            let value_m = axial_m * sine - along_m * cosine - product_m;
            let slope_m = axial_m * cosine + along_m * sine - evolute_m * (cosine * cosine - sine * sine);
            let curvature_m = 4.0 * product_m - axial_m * sine + along_m * cosine;
            let change_rad = -value_m * slope_m / (slope_m * slope_m - 0.5 * value_m * curvature_m);
            reduced = unit(sine + cosine * change_rad, cosine - sine * change_rad);
            if change_rad.abs() < LAST_CORRECTION_RAD {
                break;
            }
        }
        let [sine, cosine] = unit(reduced[0], reduced[1] * share);
        let under_m = self.equatorial_radius_m * (1.0 - square * sine * sine).sqrt();
        Geodetic {
            latitude_rad: math::atan2(sine, cosine),
            longitude_rad: math::atan2(y, x),
            height_m: axial_m * cosine + z * sine - under_m,
        }
    }
}

impl Geodetic {
    /// East, north and up along the planet's axes, as columns.
    pub fn east_north_up(&self) -> Matrix3<f64> {
        let (sine, cosine) = math::sin_cos(self.latitude_rad);
        let (sine_east, cosine_east) = math::sin_cos(self.longitude_rad);
        Matrix3::from_columns(&[
            Vector3::new(-sine_east, cosine_east, 0.0),
            Vector3::new(-sine * cosine_east, -sine * sine_east, cosine),
            Vector3::new(cosine * cosine_east, cosine * sine_east, sine),
        ])
    }
}

#[cfg(test)]
mod tests {
    //! Places go to positions by the closed form and come back, from the ground to beyond the Moon.
    use super::*;

    const WGS84: Ellipsoid =
        Ellipsoid { equatorial_radius_m: 6_378_137.0, flattening: 1.0 / 298.257_223_563 };

    /// Position in the planet-fixed frame, in m, by the closed form.
    fn position_fixed_m(ellipsoid: &Ellipsoid, place: &Geodetic) -> Vector3<f64> {
        let ((sine, cosine), share) = (math::sin_cos(place.latitude_rad), 1.0 - ellipsoid.flattening);
        let square = ellipsoid.flattening * (2.0 - ellipsoid.flattening);
        let across_m = ellipsoid.equatorial_radius_m / (1.0 - square * sine * sine).sqrt();
        let (sine_east, cosine_east) = math::sin_cos(place.longitude_rad);
        let axial_m = (across_m + place.height_m) * cosine;
        let along_m = (across_m * share * share + place.height_m) * sine;
        Vector3::new(axial_m * cosine_east, axial_m * sine_east, along_m)
    }

    #[test]
    fn places_come_back() {
        let jupiter = Ellipsoid { equatorial_radius_m: 71_492e3, flattening: 0.064_87 };
        let sphere = Ellipsoid { equatorial_radius_m: 2_440e3, flattening: 0.0 };
        let [flat, long] =
            [0.5, -0.3].map(|flattening| Ellipsoid { equatorial_radius_m: 2_440e3, flattening });
        for ellipsoid in [WGS84, jupiter, sphere, flat, long] {
            for degrees in [-90.0_f64, -89.999, -60.0, -1e-7, 0.0, 30.0, 45.0, 89.999_999, 90.0] {
                for height_m in [-5e3, 0.0, 1e5, 4e5, 2e6, 3.6e7, 4e8] {
                    let place = Geodetic { latitude_rad: degrees.to_radians(), longitude_rad: 2.5, height_m };
                    let position_m = position_fixed_m(&ellipsoid, &place);
                    let found = ellipsoid.geodetic(&position_m);
                    assert!(
                        (found.height_m - height_m).abs() < 4e-8 * (1.0 + height_m.abs() * 1e-7),
                        "{place:?} {found:?}"
                    );
                    assert!((found.latitude_rad - place.latitude_rad).abs() < 1e-14, "{place:?} {found:?}");
                    let up = found.east_north_up().column(2).into_owned();
                    let higher = Geodetic { height_m: height_m + 10.0, ..place };
                    let climbed = position_fixed_m(&ellipsoid, &higher) - position_m;
                    assert!((climbed - up * 10.0).norm() < 1e-6, "{place:?}");
                }
            }
        }
    }

    #[test]
    fn an_almanacs_place_is_found() {
        // Vallado, Fundamentals of Astrodynamics, example 3-3: 34.352496 deg, 46.4464 deg, 5085.22 km.
        let found = WGS84.geodetic(&Vector3::new(6_524.834e3, 6_862.875e3, 6_448.296e3));
        assert!((found.latitude_rad.to_degrees() - 34.352_496).abs() < 1e-5, "{found:?}");
        assert!((found.longitude_rad.to_degrees() - 46.446_4).abs() < 1e-4, "{found:?}");
        assert!((found.height_m - 5_085.22e3).abs() < 10.0, "{found:?}");
    }
}

//! Sunlight at a distance: flux, radiation pressure.

use crate::constants::{ASTRONOMICAL_UNIT_M, SPEED_OF_LIGHT_M_S};
use crate::numerics::scalar::Scalar;

/// Nominal total solar irradiance at 1 AU, W/m2 (IAU 2015 Resolution B3).
pub const SOLAR_FLUX_W_M2: f64 = 1361.0;

/// Flux at `distance_m` from the Sun's centre, W/m2: the inverse square law (paper 004 eq 22). `None` unless `distance_m` is finite
/// and positive.
pub fn flux_w_m2<T: Scalar>(flux_at_1_au_w_m2: T, distance_m: T) -> Option<T> {
    let ratio = T::constant(ASTRONOMICAL_UNIT_M) / distance_m;
    (distance_m.value() > 0.0 && distance_m.value().is_finite()).then(|| flux_at_1_au_w_m2 * (ratio * ratio))
}

/// Radiation pressure on a black surface facing the Sun at `distance_m`, N/m2: P = F / (c D^2) with D in AU
/// (papers 000 and 003). `None` unless `distance_m` is finite and positive.
pub fn pressure_n_m2<T: Scalar>(flux_at_1_au_w_m2: T, distance_m: T) -> Option<T> {
    Some(flux_w_m2(flux_at_1_au_w_m2, distance_m)? / SPEED_OF_LIGHT_M_S)
}

#[cfg(test)]
mod tests {
    //! Light thins out with the square of the distance, and the published pressure at 0.3 AU comes out.

    use super::*;

    #[test]
    fn published_pressure_of_paper_000() {
        let p = pressure_n_m2(1353.0, 0.3 * ASTRONOMICAL_UNIT_M).unwrap();
        assert!((p - 5.0145e-5).abs() < 0.0005e-5, "{p:e}");
    }

    #[test]
    fn the_same_power_crosses_every_sphere() {
        let power = |d: f64| flux_w_m2(1361.0, d).unwrap() * d * d;
        assert!((power(4.6e10) / power(7.0e11) - 1.0).abs() < 1e-15);
        // The Sun's luminosity is 3.828e26 W (IAU 2015 nominal) for 1361 W/m2 at 1 AU.
        let luminosity = 4.0 * core::f64::consts::PI * power(1.0e11);
        assert!((luminosity / 3.828e26 - 1.0).abs() < 2e-4);
    }

    #[test]
    fn a_sun_at_no_distance_gives_no_light() {
        for distance_m in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert_eq!(pressure_n_m2(1361.0, distance_m), None, "{distance_m}");
        }
    }
}

//! Sunlight at a distance: flux, radiation pressure.

use thiserror::Error;

use crate::constants::{ASTRONOMICAL_UNIT_M, SPEED_OF_LIGHT_M_S};
use crate::numerics::scalar::Scalar;

/// Nominal total solar irradiance at 1 AU, W/m2 (IAU 2015 Resolution B3).
pub const SOLAR_FLUX_W_M2: f64 = 1361.0;

/// Sunlight that cannot be computed.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum SunError {
    /// The distance to the Sun is no positive number.
    #[error("the distance to the Sun is {found_m} m, allowed is a finite number above 0")]
    Distance {
        /// Distance that was found, m.
        found_m: f64,
    },
}

/// Flux at `distance_m` from the Sun's centre, W/m2: the inverse square law (paper 004 eq 22).
///
/// # Errors
/// [`SunError::Distance`] unless `distance_m` is finite and positive.
pub fn flux_w_m2<T: Scalar>(flux_at_1_au_w_m2: T, distance_m: T) -> Result<T, SunError> {
    let found_m = distance_m.value();
    if !(found_m > 0.0 && found_m.is_finite()) {
        return Err(SunError::Distance { found_m });
    }
    let ratio = T::constant(ASTRONOMICAL_UNIT_M) / distance_m;
    Ok(flux_at_1_au_w_m2 * (ratio * ratio))
}

/// Radiation pressure on a black surface facing the Sun at `distance_m`, N/m2: P = F / (c D^2) with D in AU
/// (papers 000 and 003).
///
/// # Errors
/// [`SunError::Distance`] unless `distance_m` is finite and positive.
pub fn pressure_n_m2<T: Scalar>(flux_at_1_au_w_m2: T, distance_m: T) -> Result<T, SunError> {
    Ok(flux_w_m2(flux_at_1_au_w_m2, distance_m)? / SPEED_OF_LIGHT_M_S)
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
    fn sun_at_zero_distance_is_an_error() {
        for distance in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            let error = pressure_n_m2(1361.0, distance).unwrap_err().to_string();
            assert!(error.contains("allowed is a finite number above 0"), "{error}");
        }
    }
}

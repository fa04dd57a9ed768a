//! Models of a planet's magnetic field.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::igrf14::{self, FIRST_YEAR, LAST_YEAR};
use crate::bodies::dipole::DipoleField;
use crate::environment::utc;

/// Model of the magnetic field.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum MagneticField {
    /// A dipole.
    Dipole(DipoleField),
    /// The International Geomagnetic Reference Field, 14th generation.
    Igrf14,
}

/// A time or place without a field.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum MagneticFieldError {
    /// Beyond the reference field's years.
    #[error("found the year {found_year:.3}, allowed: 1900 to 2030, the years of igrf14")]
    Year {
        /// The year with its share.
        found_year: f64,
    },
    /// At the dipole or in the centre.
    #[error("the field has no value at the dipole itself")]
    Place,
}

/// Checks that the reference field has an epoch in s past J2000 TDB.
///
/// # Errors
/// Outside 1900 to 2030.
pub fn check_igrf14(epoch_s: f64) -> Result<(), MagneticFieldError> {
    let found_year = utc::year_and_share(epoch_s);
    if (FIRST_YEAR..=LAST_YEAR).contains(&found_year) {
        Ok(())
    } else {
        Err(MagneticFieldError::Year { found_year })
    }
}

impl MagneticField {
    /// The field along the planet's axes, in T, at a position from its centre along them, in m.
    ///
    /// # Errors
    /// A time or place without a field.
    pub fn field_fixed_t(
        &self,
        epoch_s: f64,
        position_fixed_m: &Vector3<f64>,
    ) -> Result<Vector3<f64>, MagneticFieldError> {
        let field_t = match self {
            Self::Dipole(dipole) => {
                let from_m = position_fixed_m - Vector3::from(dipole.place_fixed_m);
                let (distance_m, moment) = (from_m.norm(), Vector3::from(dipole.moment_fixed_t_m3));
                let unit = from_m / distance_m;
                (unit * (3.0 * moment.dot(&unit)) - moment) / (distance_m * distance_m * distance_m)
            }
            Self::Igrf14 => {
                check_igrf14(epoch_s)?;
                igrf14::field_fixed_t(utc::year_and_share(epoch_s), position_fixed_m)
            }
        };
        if field_t.iter().all(|it| it.is_finite()) { Ok(field_t) } else { Err(MagneticFieldError::Place) }
    }
}

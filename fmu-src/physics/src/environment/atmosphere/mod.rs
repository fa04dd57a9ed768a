//! Air about a planet: density, temperature and mean molar mass where a spacecraft is.
//!
//! Equation: density = reference density exp(-(height - reference height) / scale height), or the empirical model NRLMSISE-00 of
//! the Earth with anomalous oxygen counted at every height; none above [`CEILING_M`].
//! Error measure: none; a model of the thermosphere is off by some 15 % on a quiet day.
//! Reference: Picone et al. 2002, NRLMSISE-00 empirical model of the atmosphere, J. Geophys. Res. 107; [`nrlmsise`].

mod nrlmsise;
mod portable;

#[cfg(test)]
mod tests;

use super::geodetic::Geodetic;
use crate::math;

pub use super::utc::next_midnight_s;
pub use crate::bodies::air::ExponentialAir;

/// Above this there is no air, in m.
pub const CEILING_M: f64 = 2e6;
/// Below this molecules meet one another before they meet the spacecraft, in m.
pub const FLOOR_M: f64 = 1e5;

/// Air at one place and time.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Air {
    /// Density, in kg/m3.
    pub density_kg_m3: f64,
    /// Temperature, in K.
    pub temperature_k: f64,
    /// Mean molar mass, in kg/mol.
    pub molar_mass_kg_mol: f64,
}

/// Activity of the Sun and of the Earth's magnetic field.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpaceWeather {
    /// Flux at 10.7 cm on the day before, in 1e-22 W/(m2 Hz).
    pub f107: f64,
    /// Its mean over 81 days.
    pub f107_average: f64,
    /// Daily Ap.
    pub ap: f64,
}

/// Where the air comes from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AtmosphereModel {
    /// Density that falls exponentially.
    Exponential(ExponentialAir),
    /// NRLMSISE-00.
    Nrlmsise00,
}

/// A place without a model.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum AtmosphereError {
    /// Where air no longer flows as single molecules.
    #[error("found a height of {found_m:.0} m, allowed: 100 km and more, where air is a flow of single molecules")]
    Height {
        /// Height over the ellipsoid, in m.
        found_m: f64,
    },
}

impl AtmosphereModel {
    /// The air at an epoch in s past J2000 TDB; all zero above the ceiling.
    ///
    /// # Errors
    /// A place too low.
    pub fn air_at(&self, epoch_s: f64, place: &Geodetic, weather: &SpaceWeather) -> Result<Air, AtmosphereError> {
        if place.height_m < FLOOR_M || place.height_m.is_nan() {
            return Err(AtmosphereError::Height { found_m: place.height_m });
        }
        if place.height_m > CEILING_M {
            return Ok(Air::default());
        }
        Ok(match self {
            Self::Exponential(air) => Air {
                density_kg_m3: air.reference_density_kg_m3
                    * math::exp(-(place.height_m - air.reference_height_m) / air.scale_height_m),
                temperature_k: air.temperature_k,
                molar_mass_kg_mol: air.molar_mass_kg_mol,
            },
            Self::Nrlmsise00 => nrlmsise::air(epoch_s, place, weather),
        })
    }

    /// Heights at which its form changes, in m.
    pub fn breaks_m(&self) -> &'static [f64] {
        match self {
            Self::Exponential(_) => &[CEILING_M],
            // The correction of oxygen and the variation of the lower profile end at 300 km (density jumps by up to 3e-4),
            // that of nitrogen at 450 km (6e-5).
            Self::Nrlmsise00 => &[300e3, 450e3, CEILING_M],
        }
    }

    /// Whether it counts in whole days of UTC.
    pub fn changes_at_midnight(&self) -> bool {
        matches!(self, Self::Nrlmsise00)
    }
}

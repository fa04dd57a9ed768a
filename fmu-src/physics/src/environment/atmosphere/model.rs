//! Models of the air about a planet.

use serde::{Deserialize, Serialize};

use super::air::{Air, SpaceWeather};
use super::nrlmsise;
use crate::bodies::air::ExponentialAir;
use crate::environment::geodetic::Geodetic;
use crate::math;

/// Above this there is no air, in m.
pub const CEILING_M: f64 = 2e6;
/// Largest number of heights at which a model is discontinuous.
pub const BREAKS: usize = 7;
/// Lower limit of free molecular flow, in m.
pub const FLOOR_M: f64 = 1e5;

/// Model of the air.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum AtmosphereModel {
    /// Exponential decrease with height.
    Exponential(ExponentialAir),
    /// NRLMSISE-00.
    Nrlmsise00,
}

/// A place without a model.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum AtmosphereError {
    /// Below free molecular flow.
    #[error("found a height of {found_m:.0} m, allowed: 100 km and more, where the flow is free molecular")]
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
    pub fn air_at(
        &self,
        epoch_s: f64,
        place: &Geodetic,
        weather: &SpaceWeather,
    ) -> Result<Air, AtmosphereError> {
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

    /// Heights at which the model is discontinuous, in m, ascending; the last one repeated up to [`BREAKS`].
    pub fn breaks_m(&self) -> [f64; BREAKS] {
        match self {
            Self::Exponential(_) => [CEILING_M; BREAKS],
            // Where the profile of the temperature is joined, and where the corrections of O, Ar, O2, He, H and N end.
            Self::Nrlmsise00 => [123.435e3, 160e3, 240e3, 250e3, 300e3, 450e3, CEILING_M],
        }
    }

    /// Whether it depends on the day of the year, and so is discontinuous at midnight UTC.
    pub fn changes_at_midnight(&self) -> bool {
        matches!(self, Self::Nrlmsise00)
    }
}

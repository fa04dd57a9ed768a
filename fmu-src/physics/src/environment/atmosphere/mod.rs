//! Air about a planet: density, temperature and mean molar mass where a spacecraft is.
//!
//! Equation: density = reference density exp(-(height - reference height) / scale height), or the empirical model NRLMSISE-00 of
//! the Earth with anomalous oxygen counted at every height; none above [`CEILING_M`].
//! Error measure: none; a model of the thermosphere is off by some 15 % on a quiet day.
//! Reference: Picone et al. 2002, NRLMSISE-00 empirical model of the atmosphere, J. Geophys. Res. 107; [`nrlmsise`].

mod air;
mod model;
mod nrlmsise;
mod portable;

#[cfg(test)]
mod tests;

pub use air::{Air, SpaceWeather};
pub use model::{AtmosphereError, AtmosphereModel, BREAKS, CEILING_M, FLOOR_M};

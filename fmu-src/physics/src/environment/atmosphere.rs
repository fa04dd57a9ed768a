//! stub
use super::geodetic::Geodetic;
/// a
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Air {
    /// d
    pub density_kg_m3: f64,
    /// t
    pub temperature_k: f64,
    /// m
    pub molar_mass_kg_mol: f64,
}
/// e
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExponentialAir {
    /// d
    pub reference_density_kg_m3: f64,
    /// h
    pub reference_height_m: f64,
    /// s
    pub scale_height_m: f64,
    /// t
    pub temperature_k: f64,
    /// m
    pub molar_mass_kg_mol: f64,
}
impl ExponentialAir {
    /// n
    pub const NONE: Self = Self { reference_density_kg_m3: 0.0, reference_height_m: 0.0, scale_height_m: 1e4, temperature_k: 1000.0, molar_mass_kg_mol: 0.016 };
}
/// w
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpaceWeather {
    /// f
    pub f107: f64,
    /// f
    pub f107_average: f64,
    /// a
    pub ap: f64,
}
/// m
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AtmosphereModel {
    /// e
    Exponential(ExponentialAir),
    /// n
    Nrlmsise00,
}
/// e
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("too low")]
pub struct AtmosphereError;
impl AtmosphereModel {
    /// a
    pub fn air_at(&self, _e: f64, _g: &Geodetic, _w: &SpaceWeather) -> Result<Air, AtmosphereError> { Ok(Air::default()) }
    /// b
    pub fn breaks_m(&self) -> &[f64] { &[2e6] }
    /// c
    pub fn changes_at_midnight(&self) -> bool { false }
}
/// n
pub fn next_midnight_s(e: f64) -> f64 { e + 1e9 }

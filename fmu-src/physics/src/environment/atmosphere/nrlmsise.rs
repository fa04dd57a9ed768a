//! The Earth's air by NRLMSISE-00.
//!
//! Equation: the model's number densities; density with anomalous oxygen, molar mass of the mixture with it as oxygen.
//! Method: the crate `nrlmsise00`, computed in [`Portable`] numbers.
//! Error measure: the published cases to their seven digits.
//! Reference: Picone et al. 2002.

use std::sync::OnceLock;

use nrlmsise00::{Input, MagneticActivity, Model, Output};

use super::air::{Air, SpaceWeather};
use super::portable::Portable;
use crate::environment::geodetic::Geodetic;
use crate::environment::utc;

/// Atomic mass constant of the model, in kg.
const ATOMIC_MASS_KG: f64 = 1.66e-27;
/// The same per mole, in kg/mol.
const ATOMIC_MASS_KG_MOL: f64 = 1e-3;

/// The air at an epoch in s past J2000 TDB.
pub(super) fn air(epoch_s: f64, place: &Geodetic, weather: &SpaceWeather) -> Air {
    let (day_of_year, seconds) = utc::day_and_seconds(epoch_s);
    let [seconds, altitude_km] = [seconds, place.height_m * 1e-3].map(Portable::from);
    let [latitude_deg, longitude_deg] =
        [place.latitude_rad, place.longitude_rad].map(|angle| Portable::from(angle.to_degrees()));
    let [f107_average, f107, ap] = [weather.f107_average, weather.f107, weather.ap].map(Portable::from);
    let magnetic = MagneticActivity::Daily { ap };
    air_of(&Input::consistent(
        day_of_year,
        seconds,
        altitude_km,
        latitude_deg,
        longitude_deg,
        f107_average,
        f107,
        magnetic,
    ))
}

/// The air for inputs of the model.
pub(super) fn air_of(input: &Input<Portable>) -> Air {
    const _: () = assert!(!core::mem::needs_drop::<Model>());
    static MODEL: OnceLock<Model> = OnceLock::new();
    let found: Output<Portable> = MODEL.get_or_init(Model::new).gtd7d(input);
    let parts = [
        found.helium,
        found.atomic_oxygen,
        found.molecular_nitrogen,
        found.molecular_oxygen,
        found.argon,
        found.hydrogen,
        found.atomic_nitrogen,
        found.anomalous_oxygen,
    ];
    let number_1_m3: f64 = parts.into_iter().map(f64::from).sum();
    let density_kg_m3 = f64::from(found.total_mass);
    let molar_mass_kg_mol = density_kg_m3 / number_1_m3 * (ATOMIC_MASS_KG_MOL / ATOMIC_MASS_KG);
    Air { density_kg_m3, temperature_k: f64::from(found.temperature), molar_mass_kg_mol }
}

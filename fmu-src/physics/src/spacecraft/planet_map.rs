//! A planet whose surface differs from place to place, cell by cell (paper 004 Table 2).

use serde::{Deserialize, Serialize};

use super::part_reader::PartReader;
use crate::constants::STEFAN_BOLTZMANN_W_M2_K4;
use crate::math;
use crate::numerics::scalar::Scalar;
use crate::refusal::Refusal;
use crate::toml::{CellTemperature, Fraction, List, Written, tables};

/// Most belts a map may have.
const MOST_BELTS: usize = 180;

/// Hottest a cell may be, in K.
const HOTTEST_K: f64 = 1e4;

tables! {
/// The planet's surface cell by cell, for `planetLight.method` map of DisturbanceTorque. Each key has n rows, belts of
/// latitude from south to north, of 2 n cells each, from midnight over morning, noon and evening.
struct PlanetMapDescription {
    /// Diffusely reflected fraction of sunlight.
    diffuse_reflectivity: List<Vec<Fraction>, 1, MOST_BELTS>,
    /// Infrared emissivity.
    emissivity: List<Vec<Fraction>, 1, MOST_BELTS>,
    /// Temperature, in K.
    temperature_k: List<Vec<CellTemperature>, 1, MOST_BELTS>,
}
}

/// Optical properties and temperature of one cell.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct PlanetCell {
    /// Diffusely reflected fraction of sunlight.
    pub diffuse_reflectivity: f64,
    /// Infrared emissivity.
    pub emissivity: f64,
    /// Temperature in K.
    pub temperature_k: f64,
}

impl PlanetCell {
    /// Reflected exitance in W/m2 with the Sun's flux at the planet and the cosine of its zenith angle (eq 39).
    pub fn reflected_w_m2<T: Scalar>(&self, solar_flux_w_m2: T, cos_zenith: T) -> T {
        if cos_zenith.value() > 0.0 {
            solar_flux_w_m2 * cos_zenith * self.diffuse_reflectivity
        } else {
            T::constant(0.0)
        }
    }

    /// Infrared exitance in W/m2 (eq 34).
    pub fn infrared_w_m2(&self) -> f64 {
        self.emissivity * STEFAN_BOLTZMANN_W_M2_K4 * math::powi(self.temperature_k, 4)
    }

    fn is_possible(&self) -> bool {
        let is_fraction = |x: f64| (0.0..=1.0).contains(&x);
        is_fraction(self.diffuse_reflectivity)
            && is_fraction(self.emissivity)
            && (0.0..=HOTTEST_K).contains(&self.temperature_k)
    }
}

/// Every cell of n belts of latitude from south to north, each of 2 n cells from midnight over morning, noon and evening:
/// columns are local times, not longitudes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PlanetMap {
    belts: usize,
    cells: Vec<PlanetCell>,
}

impl PlanetMap {
    /// A checked map.
    ///
    /// # Errors
    /// The number of cells, or the first cell out of range.
    pub fn new(belts: usize, cells: Vec<PlanetCell>) -> Result<Self, Refusal> {
        if !(1..=MOST_BELTS).contains(&belts) || cells.len() != 2 * belts * belts {
            return Err(Refusal::new(
                format_args!("planet map of {belts} belts and {} cells", cells.len()),
                format_args!("1 to {MOST_BELTS} belts of twice as many cells each"),
            ));
        }
        if let Some(cell) = cells.iter().find(|cell| !cell.is_possible()) {
            let allowed = format_args!("fractions from 0 to 1, temperatures from 0 to {HOTTEST_K} K");
            return Err(Refusal::new(format_args!("planet map with {cell:?}"), allowed));
        }
        Ok(Self { belts, cells })
    }

    /// Belts of latitude.
    pub fn belts(&self) -> usize {
        self.belts
    }

    /// All cells, belt by belt.
    pub fn cells(&self) -> &[PlanetCell] {
        &self.cells
    }
}

/// The map, unless something in it was reported.
pub(super) fn planet_map(part: &PartReader<'_>, description: &PlanetMapDescription) -> Option<PlanetMap> {
    let belts = description.temperature_k.len();
    let [reflectivity, emissivity, temperature] = [
        ("diffuse_reflectivity", description.diffuse_reflectivity.value()),
        ("emissivity", description.emissivity.value()),
        ("temperature_k", description.temperature_k.value()),
    ]
    .map(|(key, rows)| {
        if rows.len() != belts || !(1..=MOST_BELTS).contains(&belts) {
            let allowed = format!("as many as `temperature_k` has, 1 to {MOST_BELTS}");
            part.key(key).report(format_args!("{} belts", rows.len()), allowed);
        }
        for (belt, row) in rows.iter().enumerate().filter(|(_, row)| row.len() != 2 * rows.len()) {
            let allowed = format!("{}, twice as many as there are belts", 2 * rows.len());
            part.key(key).item(belt).report(format_args!("{} cells", row.len()), allowed);
        }
        rows.concat()
    });
    let cells = reflectivity.into_iter().zip(emissivity).zip(temperature);
    let cells = cells.map(|((diffuse_reflectivity, emissivity), temperature_k)| PlanetCell {
        diffuse_reflectivity,
        emissivity,
        temperature_k,
    });
    PlanetMap::new(belts, cells.collect()).ok()
}

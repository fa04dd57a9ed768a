//! Planet light by the paper's planet cells (paper 004 eqs 5-8, 27-31, 33-36, 39-41): slow, for comparison with
//! [`super::ring`] and for planets whose surface differs from place to place.
//!
//! The planet frame has its z axis toward the pole of the cells; where the surface is of one kind everywhere any
//! orientation gives the same in the limit of many cells.

use core::f64::consts::{FRAC_PI_2, PI};

use nalgebra::{Matrix3, Vector3};

use super::flat_plate::ReceivedLight;
use super::planet_light::PlanetLight;
use super::ring::{PlanetView, ViewError};
use crate::constants::SPEED_OF_LIGHT_M_S;
use crate::environment::surface::{CellMap, PlanetSurface};

/// Where the cells' centres are and how large they are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CellLayout {
    /// Centres in the middle of cells bordered by equal steps of longitude and latitude; areas sum to the sphere's.
    Corrected,
    /// Eqs 6-7 to the letter: the latitudes of cell centres are taken as borders for the areas, which then sum to
    /// 4 pi R2 cos(pi / 2n), and longitudes are those of the western border.
    AsPrinted,
}

/// The planet's cells in the planet frame, for a planet of radius 1.
#[derive(Clone, Debug, PartialEq)]
pub struct PlanetGrid {
    cells: Vec<Cell>,
    resolution: usize,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Cell {
    normal: Vector3<f64>,
    area: f64,
}

/// A grid that is not offered.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum GridError {
    /// Too coarse or too fine.
    #[error("planet grid of resolution {found}, allowed: 1 to 2000 (2 n2 cells)")]
    Resolution {
        /// The resolution asked for.
        found: usize,
    },
    /// A map for another grid.
    #[error("map of {found} planet cells, allowed: {allowed} for this grid")]
    MapSize {
        /// Cells of the map.
        found: usize,
        /// Cells of the grid.
        allowed: usize,
    },
    /// A geometry without meaning.
    #[error(transparent)]
    View(#[from] ViewError),
}

impl PlanetGrid {
    /// A grid of `resolution` belts of latitude and twice as many of longitude (n_res of the paper).
    ///
    /// # Errors
    /// Unless the resolution is from 1 to 2000.
    pub fn new(resolution: usize, layout: CellLayout) -> Result<Self, GridError> {
        if !(1..=2000).contains(&resolution) {
            return Err(GridError::Resolution { found: resolution });
        }
        let n = resolution as f64;
        let mut cells = Vec::with_capacity(2 * resolution * resolution);
        for belt in 0..resolution {
            let latitude = -FRAC_PI_2 + PI * (belt as f64 + 0.5) / n;
            let (south, north) = match layout {
                CellLayout::Corrected => (latitude - FRAC_PI_2 / n, latitude + FRAC_PI_2 / n),
                CellLayout::AsPrinted => (latitude, latitude + PI / n),
            };
            let area = PI / n * (north.sin() - south.sin());
            for step in 0..2 * resolution {
                let offset = if layout == CellLayout::Corrected { 0.5 } else { 0.0 };
                let longitude = -PI + PI * (step as f64 + offset) / n;
                let (sin, cos) = longitude.sin_cos();
                let normal = Vector3::new(cos * latitude.cos(), sin * latitude.cos(), latitude.sin());
                cells.push(Cell { normal, area });
            }
        }
        Ok(Self { cells, resolution })
    }

    /// Belts of latitude.
    pub fn resolution(&self) -> usize {
        self.resolution
    }

    /// Unit normals of the cells in the planet frame, in the order of a [`CellMap`].
    pub fn normals(&self) -> impl Iterator<Item = Vector3<f64>> + '_ {
        self.cells.iter().map(|cell| cell.normal)
    }

    /// Sum of the cells' areas over the sphere's.
    pub fn covered(&self) -> f64 {
        self.cells.iter().map(|cell| cell.area).sum::<f64>() / (4.0 * PI)
    }

    /// Light on a face of unit `normal` from a planet of one kind of surface. `planet_m` points from the
    /// spacecraft to the planet's centre, `sun_from_planet` from there toward the Sun, `planet_axes` has the
    /// planet frame's axes as columns, all in the frame of `normal`; `solar_flux_w_m2` is the Sun's at the planet.
    ///
    /// # Errors
    /// When the spacecraft is inside the planet or the Sun has no direction.
    pub fn receive(
        &self,
        surface: &PlanetSurface,
        solar_flux_w_m2: f64,
        planet_m: &Vector3<f64>,
        sun_from_planet_m: &Vector3<f64>,
        planet_axes: &Matrix3<f64>,
        normal: &Vector3<f64>,
    ) -> Result<PlanetLight<f64>, GridError> {
        let view = PlanetView::new(planet_m, sun_from_planet_m, surface.radius_m)?;
        let exitance = surface.exitance(solar_flux_w_m2);
        Ok(self.sum(&view, planet_axes, normal, |_, cos_sun| {
            (exitance.reflected_w_m2(cos_sun), exitance.infrared_w_m2(cos_sun))
        }))
    }

    /// The same for a planet with a map of its own albedo, emissivity and temperature for every cell.
    ///
    /// # Errors
    /// Also when the map is for another grid.
    #[expect(clippy::too_many_arguments, reason = "one geometry, spelt out")]
    pub fn receive_mapped(
        &self,
        map: &CellMap,
        radius_m: f64,
        solar_flux_w_m2: f64,
        planet_m: &Vector3<f64>,
        sun_from_planet_m: &Vector3<f64>,
        planet_axes: &Matrix3<f64>,
        normal: &Vector3<f64>,
    ) -> Result<PlanetLight<f64>, GridError> {
        if map.cells().len() != self.cells.len() {
            return Err(GridError::MapSize { found: map.cells().len(), allowed: self.cells.len() });
        }
        let view = PlanetView::new(planet_m, sun_from_planet_m, radius_m)?;
        Ok(self.sum(&view, planet_axes, normal, |index, cos_sun| {
            map.cells().get(index).map_or((0.0, 0.0), |cell| {
                (cell.reflected_w_m2(solar_flux_w_m2, cos_sun), cell.infrared_w_m2())
            })
        }))
    }

    /// Sums over the cells that see the face and are seen by it; `exitances` gives reflected and infrared exitance
    /// of a cell by its number and the cosine of the Sun's zenith angle.
    fn sum(
        &self,
        view: &PlanetView<f64>,
        planet_axes: &Matrix3<f64>,
        normal: &Vector3<f64>,
        exitances: impl Fn(usize, f64) -> (f64, f64),
    ) -> PlanetLight<f64> {
        let to_planet = planet_axes.transpose();
        let normal = to_planet * normal;
        let sun = to_planet * view.sun;
        let center = to_planet * view.nadir * (view.distance_m / view.radius_m);
        let mut light = PlanetLight::dark();
        for (index, cell) in self.cells.iter().enumerate() {
            let line_of_sight = center + cell.normal;
            let distance_squared = line_of_sight.norm_squared();
            // Both cosines times the distance (eqs 29-31).
            let at_planet = -cell.normal.dot(&line_of_sight);
            let at_face = normal.dot(&line_of_sight);
            if at_planet <= 0.0 || at_face <= 0.0 {
                continue;
            }
            let view_factor = at_planet * at_face * cell.area / (PI * distance_squared * distance_squared);
            let (reflected, infrared) = exitances(index, sun.dot(&cell.normal));
            let source = line_of_sight / distance_squared.sqrt();
            add(&mut light.albedo, reflected * view_factor, &source);
            add(&mut light.infrared, infrared * view_factor, &source);
        }
        light.albedo.vector_pa = planet_axes * light.albedo.vector_pa;
        light.infrared.vector_pa = planet_axes * light.infrared.vector_pa;
        light
    }
}

fn add(light: &mut ReceivedLight<f64>, irradiance_w_m2: f64, source: &Vector3<f64>) {
    let pressure_pa = irradiance_w_m2 / SPEED_OF_LIGHT_M_S;
    light.pressure_pa += pressure_pa;
    light.vector_pa += source * pressure_pa;
}

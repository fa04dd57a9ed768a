//! Planet light by the paper's planet cells (paper 004 eqs 5-8, 27-31, 33-36, 39-41): slow, for comparison with
//! [`super::ring`] and for planets whose surface differs from place to place.
//!
//! The planet frame has its z axis toward the pole of the cells and its x axis under the Sun; where the surface is of one
//! kind everywhere any orientation gives the same in the limit of many cells.

use core::f64::consts::{FRAC_PI_2, PI};

use nalgebra::{Matrix3, Vector3};

use super::flat_plate::ReceivedLight;
use super::planet_light::PlanetLight;
use super::ring::PlanetView;
use crate::bodies::surface::SurfaceExitance;
use crate::constants::SPEED_OF_LIGHT_M_S;
use crate::math;
use crate::numerics::scalar::{Scalar, constant_vector};
use crate::refusal::Refusal;
use crate::spacecraft::PlanetMap;

/// Centres this close to the terminator are on it but for rounding, and count as lit: so do the paper's, whose odd number
/// of belts has a meridian of them there.
const ON_TERMINATOR: f64 = 1e-12;

/// The planet's cells in the planet frame, for a planet of radius 1: every belt with every meridian.
#[derive(Clone, Debug, PartialEq)]
pub struct PlanetGrid {
    belts: Vec<Belt>,
    /// Sine and cosine of the longitude of the cells' centres.
    meridians: Vec<(f64, f64)>,
    map: Option<PlanetMap>,
}

/// Cells of one latitude.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Belt {
    sin_latitude: f64,
    cos_latitude: f64,
    /// Area of one of its cells.
    area: f64,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Cell {
    normal: Vector3<f64>,
    area: f64,
}

impl PlanetGrid {
    /// Number of cells.
    pub fn cell_count(&self) -> usize {
        self.belts.len() * self.meridians.len()
    }

    /// A grid of `resolution` belts of latitude and twice as many of longitude (n_res of the paper), whose cells are bordered by
    /// equal steps of both, with their centres in the middle; areas sum to the sphere's.
    ///
    /// # Errors
    /// Unless the resolution is from 1 to 2000.
    pub fn new(resolution: usize) -> Result<Self, Refusal> {
        if !(1..=2000).contains(&resolution) {
            let found = format_args!("planet grid of resolution {resolution}");
            return Err(Refusal::new(found, "1 to 2000 (2 n2 cells)"));
        }
        let n = resolution as f64;
        let belts = (0..resolution).map(|belt| {
            let latitude = -FRAC_PI_2 + PI * (belt as f64 + 0.5) / n;
            let (south, north) = (latitude - FRAC_PI_2 / n, latitude + FRAC_PI_2 / n);
            let area = PI / n * (math::sin(north) - math::sin(south));
            Belt { sin_latitude: math::sin(latitude), cos_latitude: math::cos(latitude), area }
        });
        let meridians = (0..2 * resolution).map(|step| math::sin_cos(-PI + PI * (step as f64 + 0.5) / n));
        Ok(Self { belts: belts.collect(), meridians: meridians.collect(), map: None })
    }

    /// The cells, belt by belt from the south, in the order of a [`PlanetMap`].
    fn cells(&self) -> impl Iterator<Item = Cell> + '_ {
        self.belts.iter().flat_map(|belt| {
            self.meridians.iter().map(|(sin, cos)| {
                let normal =
                    Vector3::new(cos * belt.cos_latitude, sin * belt.cos_latitude, belt.sin_latitude);
                Cell { normal, area: belt.area }
            })
        })
    }

    /// The cells of a map, with albedo, emissivity and temperature of their own.
    ///
    /// # Errors
    /// A map finer than grids go.
    pub fn of_map(map: &PlanetMap) -> Result<Self, Refusal> {
        Ok(Self { map: Some(map.clone()), ..Self::new(map.belts())? })
    }

    /// Light on a face of unit `normal`; `planet_axes` has the cells' axes as columns ([`sun_fixed_axes`]) in the frame of
    /// `normal`, `solar_flux_w_m2` is the Sun's at the planet. A map of the grid's own goes before `exitance`.
    pub fn receive<T: Scalar>(
        &self,
        exitance: &SurfaceExitance<T>,
        solar_flux_w_m2: T,
        view: &PlanetView<T>,
        planet_axes: &Matrix3<T>,
        normal: &Vector3<T>,
    ) -> PlanetLight<T> {
        match &self.map {
            Some(map) => self.sum(view, planet_axes, normal, |index, cos_sun| {
                map.cells().get(index).map_or((T::constant(0.0), T::constant(0.0)), |cell| {
                    let infrared_w_m2 = T::constant(cell.infrared_w_m2());
                    (cell.reflected_w_m2(solar_flux_w_m2, cos_sun), infrared_w_m2)
                })
            }),
            None => self.sum(view, planet_axes, normal, |_, cos_sun| {
                (exitance.reflected_w_m2(cos_sun), exitance.infrared_w_m2(cos_sun))
            }),
        }
    }

    /// Sums over the cells that see the face and are seen by it; `exitances` gives reflected and infrared exitance
    /// of a cell by its number and the cosine of the Sun's zenith angle.
    fn sum<T: Scalar>(
        &self,
        view: &PlanetView<T>,
        planet_axes: &Matrix3<T>,
        normal: &Vector3<T>,
        exitances: impl Fn(usize, T) -> (T, T),
    ) -> PlanetLight<T> {
        let normal = planet_axes.tr_mul(normal);
        let sun = planet_axes.tr_mul(&view.sun);
        let center = planet_axes.tr_mul(&view.nadir) * (view.distance_m / view.radius_m);
        let mut light = PlanetLight::dark();
        for (index, cell) in self.cells().enumerate() {
            let cell_normal = constant_vector::<T>(&cell.normal);
            let line_of_sight = center + cell_normal;
            let distance_squared = line_of_sight.dot(&line_of_sight);
            // Both cosines times the distance (eqs 29-31).
            let at_planet = -cell_normal.dot(&line_of_sight);
            let at_face = normal.dot(&line_of_sight);
            if at_planet.value() <= 0.0 || at_face.value() <= 0.0 {
                continue;
            }
            let view_factor = at_planet * at_face / (distance_squared * distance_squared) * (cell.area / PI);
            let mut cos_sun = sun.dot(&cell_normal);
            if cos_sun.value().abs() < ON_TERMINATOR {
                cos_sun = T::constant(f64::MIN_POSITIVE);
            }
            let (reflected, infrared) = exitances(index, cos_sun);
            let source = line_of_sight / distance_squared.sqrt();
            add(&mut light.albedo, reflected * view_factor, &source);
            add(&mut light.infrared, infrared * view_factor, &source);
        }
        light.albedo.vector_pa = planet_axes * light.albedo.vector_pa;
        light.infrared.vector_pa = planet_axes * light.infrared.vector_pa;
        light
    }
}

/// Axes of the cells as columns: z along `pole`, the Sun, `sun` away from the planet's centre, over the meridian of x
/// (the paper's frame PL, whose pole is the north of the planet's orbit).
///
/// # Errors
/// When the pole has no direction, or that of the Sun.
pub fn sun_fixed_axes<T: Scalar>(sun: &Vector3<T>, pole: &Vector3<T>) -> Result<Matrix3<T>, Refusal> {
    // Scaled first, so that no length over- or underflows.
    let greatest = pole.iter().fold(0.0_f64, |most, x| most.max(x.value().abs()));
    let scaled = pole / T::constant(greatest);
    let length = scaled.dot(&scaled).sqrt();
    let z = scaled / length;
    let across = sun - z * z.dot(sun);
    let reach = across.dot(&across).sqrt();
    if !(length.value() > 0.0 && length.value().is_finite() && reach.value() > 1e-9) {
        let pole: [f64; 3] = pole.map(T::value).into();
        let found = format_args!("pole of the planet's cells {pole:?}");
        return Err(Refusal::new(found, "a direction off the Sun's"));
    }
    let x = across / reach;
    Ok(Matrix3::from_columns(&[x, z.cross(&x), z]))
}

fn add<T: Scalar>(light: &mut ReceivedLight<T>, irradiance_w_m2: T, source: &Vector3<T>) {
    let pressure_pa = irradiance_w_m2 / SPEED_OF_LIGHT_M_S;
    light.pressure_pa += pressure_pa;
    light.vector_pa += source * pressure_pa;
}

#[cfg(test)]
pub(super) mod tests;

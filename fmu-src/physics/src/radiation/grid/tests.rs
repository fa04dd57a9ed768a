//! Cells with properties of their own, and what grids refuse.

use super::*;
use crate::bodies::surface::{MERCURY, PlanetSurface};
use crate::constants::STEFAN_BOLTZMANN_W_M2_K4;
use crate::numerics::scalar::Dual64;
use crate::spacecraft::PlanetCell;

const FLUX_W_M2: f64 = 9000.0;
const BELTS: usize = 40;

const PLANET: PlanetSurface = PlanetSurface { radius_m: 1.0, ..MERCURY };

/// Eqs 6-7 to the letter: the latitudes of cell centres are taken as borders for the areas, which then sum to
/// 4 pi R2 cos(pi / 2n), and longitudes are those of the western border.
pub(in crate::radiation) fn as_printed(resolution: usize) -> PlanetGrid {
    let mut grid = PlanetGrid::new(resolution).unwrap();
    let step = PI / resolution as f64;
    for belt in &mut grid.belts {
        let latitude = belt.sin_latitude.asin();
        belt.area = step * ((latitude + step).sin() - latitude.sin());
    }
    for (k, meridian) in grid.meridians.iter_mut().enumerate() {
        *meridian = (-PI + k as f64 * step).sin_cos();
    }
    grid
}

/// Sum of the cells' areas over the sphere's.
pub(in crate::radiation) fn covered(grid: &PlanetGrid) -> f64 {
    grid.cells().map(|cell| cell.area).sum::<f64>() / (4.0 * PI)
}

fn mapped(cell: impl Fn(&Vector3<f64>) -> PlanetCell) -> PlanetGrid {
    let grid = PlanetGrid::new(BELTS).unwrap();
    let cells = grid.cells().map(|it| cell(&it.normal)).collect();
    PlanetGrid::of_map(&PlanetMap::new(BELTS, cells).unwrap()).unwrap()
}

#[test]
fn a_map_of_one_kind_is_a_planet_of_one_kind() {
    let surface = PLANET;
    let [day_k, night_k] = [1.0, -1.0].map(|cos| {
        let exitance = surface.exitance(FLUX_W_M2).infrared_w_m2(cos);
        (exitance / (surface.emissivity * STEFAN_BOLTZMANN_W_M2_K4)).powf(0.25)
    });
    let map = mapped(|normal| PlanetCell {
        diffuse_reflectivity: surface.diffuse_reflectivity,
        emissivity: surface.emissivity,
        temperature_k: if normal.x > 0.0 { day_k } else { night_k },
    });
    let plain = PlanetGrid::new(BELTS).unwrap();
    let sun = Vector3::new(0.3, -0.9, 0.1).normalize();
    let axes = sun_fixed_axes(&sun, &sun.cross(&Vector3::x())).unwrap();
    let view = PlanetView::new(&Vector3::new(0.2, 0.8, -1.1), &sun, 1.0).unwrap();
    let normal = Vector3::new(0.0, 0.6, -0.8);
    let [a, b] = [&map, &plain]
        .map(|grid| grid.receive(&surface.exitance(FLUX_W_M2), FLUX_W_M2, &view, &axes, &normal));
    for (a, b) in [(a.albedo, b.albedo), (a.infrared, b.infrared)] {
        assert!((a.vector_pa - b.vector_pa).norm() < 1e-12 * b.pressure_pa && b.pressure_pa > 0.0);
    }
}

/// A hot spot below the spacecraft acts as a point source at its distance.
#[test]
fn a_hot_spot_pushes_from_where_it_is() {
    let spot = PlanetGrid::new(BELTS).unwrap().cells().nth(1234).unwrap().normal;
    let map = mapped(|normal| PlanetCell {
        diffuse_reflectivity: 0.0,
        emissivity: 1.0,
        temperature_k: if normal == &spot { 1000.0 } else { 0.0 },
    });
    let distance = 3.0;
    let view = PlanetView::new(&(-spot * distance), &Vector3::x(), 1.0).unwrap();
    let light = map.receive(&PLANET.exitance(FLUX_W_M2), FLUX_W_M2, &view, &Matrix3::identity(), &-spot);
    // Belt 1234 / 80 from the south; a cell's area is its width times the difference of its borders' sines.
    let step = core::f64::consts::PI / BELTS as f64;
    let south = -core::f64::consts::FRAC_PI_2 + (1234 / (2 * BELTS)) as f64 * step;
    let area = step * ((south + step).sin() - south.sin());
    let irradiance =
        STEFAN_BOLTZMANN_W_M2_K4 * 1e12 * area / (core::f64::consts::PI * (distance - 1.0).powi(2));
    assert!((light.infrared.pressure_pa * 299_792_458.0 / irradiance - 1.0).abs() < 1e-12);
    assert!((light.infrared.vector_pa / light.infrared.pressure_pa + spot).norm() < 1e-12);
    assert_eq!(light.albedo.pressure_pa, 0.0);
}

#[test]
fn slopes_of_cells_are_those_of_small_differences() {
    let grid = as_printed(7);
    let (planet_m, sun, normal) = (Vector3::new(0.5, -1.4, 0.3), Vector3::new(-0.2, 0.9, 0.4), Vector3::y());
    let moved = |seed: Dual64| {
        let planet_m =
            constant_vector::<Dual64>(&planet_m) + Vector3::new(seed * 0.3, seed * 0.2, seed * -0.5);
        let sun = constant_vector::<Dual64>(&sun) + Vector3::new(seed * -0.1, seed * 0.4, seed * 0.2);
        let view = PlanetView::new(&planet_m, &sun, Dual64::from_re(1.0)).unwrap();
        let axes = sun_fixed_axes(&view.sun, &constant_vector(&Vector3::new(0.1, 0.1, 0.9))).unwrap();
        let flux_w_m2 = seed + FLUX_W_M2;
        grid.receive(
            &PLANET.constant().exitance(flux_w_m2),
            flux_w_m2,
            &view,
            &axes,
            &constant_vector(&-normal),
        )
        .albedo
        .vector_pa
    };
    let exact = moved(Dual64::new(0.0, 1.0)).map(|x| x.eps);
    let [ahead, behind] = [1e-5, -1e-5].map(|h| moved(Dual64::new(h, 0.0)).map(|x| x.re));
    let difference = (ahead - behind) / 2e-5;
    assert!((exact - difference).norm() < 1e-8 * exact.norm() && exact.norm() > 0.0, "{exact} {difference}");
}

#[test]
fn a_pole_may_have_any_length() {
    let sun = Vector3::new(0.2, -0.9, 0.1).normalize();
    let pole = Vector3::new(0.1, 0.3, -0.8);
    let axes = sun_fixed_axes(&sun, &pole).unwrap();
    for length in [1e-200, 1e200] {
        assert!((sun_fixed_axes(&sun, &(pole * length)).unwrap() - axes).norm() < 1e-14);
    }
}

#[test]
fn poles_and_maps_that_cannot_be_are_refused() {
    for pole in [Vector3::zeros(), Vector3::x() * -3.0, Vector3::new(f64::NAN, 0.0, 1.0)] {
        let error = sun_fixed_axes(&Vector3::x(), &pole).unwrap_err();
        assert!(error.to_string().contains("a direction off the Sun's"), "{error}");
    }
    let cell = PlanetCell { diffuse_reflectivity: 0.1, emissivity: 0.9, temperature_k: 300.0 };
    assert!(PlanetMap::new(2, vec![cell; 8]).is_ok());
    for (belts, cells) in [(0, 0), (2, 7), (2, 9), (181, 2 * 181 * 181)] {
        let error = PlanetMap::new(belts, vec![cell; cells]).unwrap_err().to_string();
        assert!(error.contains("1 to 180 belts"), "{error}");
    }
    for wrong in [
        PlanetCell { emissivity: 1.1, ..cell },
        PlanetCell { temperature_k: f64::NAN, ..cell },
        PlanetCell { diffuse_reflectivity: -0.1, ..cell },
    ] {
        assert!(PlanetMap::new(1, vec![cell, wrong]).unwrap_err().to_string().contains("from 0 to 1"));
    }
    for belts in [0, 2001] {
        assert!(PlanetGrid::new(belts).is_err());
    }
}

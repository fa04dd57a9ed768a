//! How long planet light, recoil and self-shadowing take, and how exact they are, beside the paper's planet grid and
//! a general polygon library.
//!
//! Prints lines `bench <name> <value> <unit>`; each time is the median of many short runs.

use std::f64::consts::{PI, TAU};
use std::hint::black_box;
use std::time::Instant;

use i_overlay::core::{fill_rule::FillRule, overlay_rule::OverlayRule};
use i_overlay::float::single::SingleFloatOverlay;
use nalgebra::{Matrix3, Rotation3, Vector3};
use physics::bodies::surface::MERCURY;
use physics::constants::{ASTRONOMICAL_UNIT_M, GM_MERCURY_M3_S2, GM_SUN_M3_S2};
use physics::environment::frames::rotation_z;
use physics::environment::kepler_planet::{MERCURY_AS_PRINTED, MESSENGER_AS_PRINTED};
use physics::environment::orbit::Elements;
use physics::math;
use physics::numerics::scalar::{Dual64, Scalar, constant_vector};
use physics::radiation::disturbance::{
    DisturbanceModel, Geometry, Options, PlanetGeometry, Recoil, Workspace,
};
use physics::radiation::flat_plate::force_per_area_pa;
use physics::radiation::grid::PlanetGrid;
use physics::radiation::ring::{PlanetView, RingRule};
use physics::radiation::shadow::{Outline, ShadowScene, ShadowWorkspace};
use physics::spacecraft::{MESSENGER_THERMAL_TOML, Optics, Plate, Polygon, Spacecraft};

const RUNS: usize = 301;

/// Evaluations of one run; a multiple of the number of geometries.
const EVALUATIONS: usize = 200;

type Failure = Box<dyn std::error::Error>;

fn main() -> Result<(), Failure> {
    let spacecraft = Spacecraft::from_toml("messenger-thermal.toml", MESSENGER_THERMAL_TOML)?;
    let orbit = orbit()?;
    planet_light(&spacecraft, &orbit)?;
    evaluations(&spacecraft, &orbit)?;
    for (hull, shaded) in [(30, 10), (108, 36)] {
        shadows(hull, shaded)?;
    }
    library();
    Ok(())
}

/// MESSENGER's positions from Mercury in its body frame, evenly around the orbit of the paper's case 4, and the
/// Sun's flux.
fn orbit() -> Result<(Vec<Vector3<f64>>, f64), Failure> {
    let planet = Elements { true_anomaly_rad: 279_f64.to_radians(), ..MERCURY_AS_PRINTED };
    let distance_m = planet.state(GM_SUN_M3_S2)?.position_m.norm();
    let flux_w_m2 = 1365.0 * math::powi(ASTRONOMICAL_UNIT_M / distance_m, 2);
    // The Sun along -y, z against the planet's orbit normal (the paper's eqs 2 to 4).
    let dcm_pl_from_mci =
        rotation_z(planet.true_anomaly_rad + planet.periapsis_argument_rad + PI).transpose();
    let dcm_sc_from_mci = Matrix3::new(0.0, -1.0, 0.0, -1.0, 0.0, 0.0, 0.0, 0.0, -1.0) * dcm_pl_from_mci;
    let mut positions_m = Vec::new();
    for step in 0..200 {
        let true_anomaly_rad = f64::from(step) * TAU / 200.0;
        let elements = Elements { true_anomaly_rad, ..MESSENGER_AS_PRINTED };
        positions_m.push(dcm_sc_from_mci * elements.state(GM_MERCURY_M3_S2)?.position_m);
    }
    Ok((positions_m, flux_w_m2))
}

/// Median time of one evaluation over many short runs; `evaluate` gets the number of the evaluation.
fn report(name: &str, mut evaluate: impl FnMut(usize) -> f64) -> f64 {
    let mut runs_s = [0.0; RUNS];
    for (run, time_s) in runs_s.iter_mut().enumerate() {
        let start = Instant::now();
        let sum: f64 = (0..EVALUATIONS).map(|i| evaluate(black_box(run * EVALUATIONS + i))).sum();
        black_box(sum);
        *time_s = start.elapsed().as_secs_f64() / EVALUATIONS as f64;
    }
    let median_s = median(&mut runs_s);
    println!("bench {name} {:.3} us", median_s * 1e6);
    median_s
}

fn median(values: &mut [f64]) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

fn value(name: &str, value: f64, unit: &str) {
    println!("bench {name} {value:.3e} {unit}");
}

/// A face for planet light: which distinct normal, area, optics.
type Cell = (usize, f64, Optics);

/// The twelve cells and their distinct normals, panels at angle 0.
fn cells(spacecraft: &Spacecraft) -> (Vec<Cell>, Vec<Vector3<f64>>) {
    let plates = spacecraft.plates.iter().map(|plate| (plate.normal, plate.area_m2, plate.faces.optics));
    let panels = spacecraft.panels.iter().flat_map(|panel| {
        let normal = panel.normal_body(0.0);
        let rear = panel.faces.rear_optics.map(|optics| (-normal, panel.area_m2, optics));
        core::iter::once((normal, panel.area_m2, panel.faces.optics)).chain(rear)
    });
    let mut normals: Vec<Vector3<f64>> = Vec::new();
    let cells = plates
        .chain(panels)
        .map(|(normal, area_m2, optics)| {
            let index = normals.iter().position(|known| (known - normal).norm() < 1e-12);
            let index = index.unwrap_or_else(|| {
                normals.push(normal);
                normals.len() - 1
            });
            (index, area_m2, optics)
        })
        .collect();
    (cells, normals)
}

/// Force of albedo and infrared on all cells.
fn force(
    cells: &[Cell],
    normals: &[Vector3<f64>],
    mut light: impl FnMut(&Vector3<f64>) -> [physics::radiation::flat_plate::ReceivedLight<f64>; 2],
) -> [Vector3<f64>; 2] {
    let mut lights = [None; 16];
    for (slot, normal) in lights.iter_mut().zip(normals) {
        *slot = Some(light(normal));
    }
    let mut sum = [Vector3::zeros(); 2];
    for (index, area_m2, optics) in cells {
        if let Some(Some(lights)) = lights.get(*index) {
            for (sum, light) in sum.iter_mut().zip(lights) {
                *sum += force_per_area_pa(optics, &normals[*index], light) * *area_m2;
            }
        }
    }
    sum
}

fn planet_light(
    spacecraft: &Spacecraft,
    (positions_m, flux_w_m2): &(Vec<Vector3<f64>>, f64),
) -> Result<(), Failure> {
    let (cells, normals) = cells(spacecraft);
    let surface = MERCURY;
    let sun = -Vector3::y();
    let by_rings = |rule: &RingRule, position_m: &Vector3<f64>| -> Result<[Vector3<f64>; 2], Failure> {
        let view = PlanetView::new(&-position_m, &sun, surface.radius_m)?;
        let exitance = surface.exitance(*flux_w_m2);
        Ok(force(&cells, &normals, |normal| {
            let light = rule.receive(&view, &exitance, normal);
            [light.albedo, light.infrared]
        }))
    };
    let by_grid = |grid: &PlanetGrid, position_m: &Vector3<f64>| -> Result<[Vector3<f64>; 2], Failure> {
        let view = PlanetView::new(&-position_m, &sun, surface.radius_m)?;
        let exitance = surface.exitance(*flux_w_m2);
        Ok(force(&cells, &normals, |normal| {
            let light = grid.receive(&exitance, *flux_w_m2, &view, &Matrix3::identity(), normal);
            [light.albedo, light.infrared]
        }))
    };
    let fine = RingRule::new(48)?;
    let exact = positions_m.iter().map(|p| by_rings(&fine, p)).collect::<Result<Vec<_>, _>>()?;
    // Of both effects together, as a share of their force: what a user of the sum sees.
    let miss = |found: [Vector3<f64>; 2], exact: [Vector3<f64>; 2]| {
        ((found[0] + found[1]) - (exact[0] + exact[1])).norm() / (exact[0] + exact[1]).norm()
    };
    let mut rings = Vec::new();
    for nodes in [3, 4, 5, 6, 7, 16] {
        let rule = RingRule::new(nodes)?;
        let mut worst: f64 = 0.0;
        for (position_m, exact) in positions_m.iter().zip(&exact) {
            worst = worst.max(miss(by_rings(&rule, position_m)?, *exact));
        }
        value(&format!("planet_light_12_cells_{nodes}_nodes_worst_error"), worst, "1");
        let name = format!("planet_light_12_cells_{nodes}_nodes");
        let time_s = report(&name, |i| {
            by_rings(&rule, &positions_m[i % positions_m.len()]).map_or(0.0, |f| f[0].x + f[1].y)
        });
        rings.push((nodes, worst, time_s));
    }
    // A tenth of the orbit's positions serve for the slow method.
    let few: Vec<usize> = (0..positions_m.len()).step_by(10).collect();
    for resolution in [80, 450, 900] {
        let grid = PlanetGrid::new(resolution)?;
        let mut worst: f64 = 0.0;
        let mut times_s = Vec::new();
        for &i in &few {
            let start = Instant::now();
            let found = by_grid(&grid, &positions_m[i])?;
            times_s.push(start.elapsed().as_secs_f64());
            worst = worst.max(miss(found, exact[i]));
        }
        let time_s = median(&mut times_s);
        value(&format!("planet_light_12_cells_grid_{resolution}_worst_error"), worst, "1");
        println!("bench planet_light_12_cells_grid_{resolution} {:.3} ms", time_s * 1e3);
        // Beside the cheapest rings that are no worse.
        let equal = rings.iter().find(|(_, ring_worst, _)| *ring_worst <= worst);
        if let Some((nodes, _, ring_s)) = equal {
            println!("bench planet_light_grid_{resolution}_over_rings_{nodes} {:.0} 1", time_s / ring_s);
        }
    }
    Ok(())
}

/// All effects in one call, and parts of it.
fn evaluations(
    spacecraft: &Spacecraft,
    (positions_m, flux_w_m2): &(Vec<Vector3<f64>>, f64),
) -> Result<(), Failure> {
    let model = DisturbanceModel::new(spacecraft, &Options { planet: Some(MERCURY), ..Options::default() })?;
    fn evaluate<T: Scalar>(
        model: &DisturbanceModel,
        position_m: Option<&Vector3<f64>>,
        flux_w_m2: f64,
        workspace: &mut Workspace<T>,
    ) -> f64 {
        let angles = [T::constant(0.0); 2];
        let sun = constant_vector::<T>(&-Vector3::y());
        let geometry = Geometry {
            planet: position_m.map(|position_m| PlanetGeometry {
                position_body_m: constant_vector(&-position_m),
                sun_from_planet_body_m: sun,
                sun_flux_w_m2: T::constant(flux_w_m2),
                pole_body: None,
            }),
            panel_angles_rad: &angles,
            ..Geometry::sunlit(sun, T::constant(flux_w_m2))
        };
        let found = model.evaluate(&geometry, Recoil::Balance, workspace);
        found.map_or(0.0, |found| found.total().force_body_n.y.value())
    }
    let mut workspace = Workspace::<f64>::default();
    report("solar_and_recoil_with_newton_12_faces", |i| {
        evaluate(&model, None, flux_w_m2 * (1.0 + 1e-3 * (i % 8) as f64), &mut workspace)
    });
    report("all_effects_12_faces", |i| {
        evaluate(&model, positions_m.get(i % positions_m.len()), *flux_w_m2, &mut workspace)
    });
    let mut dual = Workspace::<Dual64>::default();
    report("all_effects_12_faces_dual", |i| {
        evaluate(&model, positions_m.get(i % positions_m.len()), *flux_w_m2, &mut dual)
    });
    Ok(())
}

fn rectangle(
    center: Vector3<f64>,
    u: Vector3<f64>,
    v: Vector3<f64>,
) -> Result<Polygon, physics::refusal::Refusal> {
    Polygon::new(vec![center - u - v, center + u - v, center + u + v, center - u + v])
}

/// A drum of `hull` staves, and around it `shaded` pairs of a plate and a smaller shade half a metre sunward of it.
fn drum(hull: usize, shaded: usize) -> Result<Vec<Polygon>, physics::refusal::Refusal> {
    let mut polygons = Vec::new();
    for i in 0..hull {
        let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), i as f64 * TAU / hull as f64);
        let half_width = math::tan(TAU / 2.0 / hull as f64);
        polygons.push(rectangle(turn * Vector3::x(), turn * Vector3::y() * half_width, Vector3::z() * 0.5)?);
    }
    for i in 0..shaded {
        let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), i as f64 * TAU / shaded as f64);
        let out = turn * Vector3::x() * (2.0 + 0.35 * shaded as f64);
        let (u, v) = (turn * Vector3::x(), turn * Vector3::y());
        polygons.push(rectangle(out, u * 0.6, v * 0.6)?);
        polygons.push(rectangle(out + Vector3::z() * 0.5, u * 0.3, v * 0.4)?);
    }
    Ok(polygons)
}

fn shadows(hull: usize, shaded: usize) -> Result<(), Failure> {
    let polygons = drum(hull, shaded)?;
    let count = polygons.len();
    let optics = Optics::from_reflectivities(0.1, 0.2);
    let mut spacecraft = Spacecraft::from_toml("messenger-thermal.toml", MESSENGER_THERMAL_TOML)?;
    spacecraft.panels.clear();
    spacecraft.plates = polygons
        .iter()
        .enumerate()
        .map(|(i, polygon)| {
            let rear = (i >= hull).then_some(optics);
            Plate::outlined(format!("polygon {}", i + 1), polygon.clone(), optics, rear)
        })
        .collect();
    let scene = ShadowScene::new(
        polygons
            .into_iter()
            .enumerate()
            .map(|(i, polygon)| Outline { polygon, hinge: None, two_sided: i >= hull })
            .collect(),
    );
    // From every side, 60 deg from the drum's axis at most: the shades' shadows wander over their plates.
    let sun = |i: usize| {
        let azimuth = (i % 100) as f64 * TAU / 100.0;
        let tilt = 0.25 + 0.15 * (i % 8) as f64 / 8.0;
        math::sin(tilt) * Vector3::new(math::cos(azimuth), math::sin(azimuth), 0.0)
            + math::cos(tilt) * Vector3::z()
    };
    let mut workspace = ShadowWorkspace::default();
    let mut pairs = 0;
    for i in 0..EVALUATIONS {
        scene.evaluate(&sun(i), &[], &mut workspace);
        pairs += workspace.clipped_pairs();
    }
    value(&format!("shadow_drum_{count}_pairs_surviving"), pairs as f64 / EVALUATIONS as f64, "1");
    value(&format!("shadow_drum_{count}_pairs_of_the_visibility_test"), scene.candidate_pairs() as f64, "1");
    let scene_s = report(&format!("shadow_drum_{count}_scene"), |i| {
        scene.evaluate(&sun(i), &[], &mut workspace);
        workspace.lit(hull).map_or(0.0, |lit| lit.0)
    });
    value(&format!("shadow_drum_{count}_scenes_per_second"), 1.0 / scene_s, "1/s");
    let model = DisturbanceModel::new(&spacecraft, &Options::default())?;
    let mut workspace = Workspace::default();
    let all_s = report(&format!("shadow_drum_{count}_force_torque_recoil"), |i| {
        let geometry = Geometry::sunlit(sun(i), 9000.0);
        let found = model.evaluate(&geometry, Recoil::Balance, &mut workspace);
        found.map_or(0.0, |found| found.total().force_body_n.z)
    });
    value(&format!("shadow_drum_{count}_evaluations_per_second"), 1.0 / all_s, "1/s");
    Ok(())
}

/// One quadrilateral cut out of another by the polygon library, for comparison.
fn library() {
    let plate = vec![[-0.6, -0.6], [0.6, -0.6], [0.6, 0.6], [-0.6, 0.6]];
    report("polygon_library_one_pair", |i| {
        let x = 0.01 * (i % 10) as f64;
        let shade = vec![[x - 0.3, -0.4], [x + 0.3, -0.4], [x + 0.3, 0.7], [x - 0.3, 0.7]];
        plate.overlay(&shade, OverlayRule::Difference, FillRule::NonZero).len() as f64
    });
}

//! Light and heat together obey the symmetries of mechanics and agree with what each part gives alone.

use core::f64::consts::PI;

use approx::assert_relative_eq;
use nalgebra::{Matrix3, Rotation3, Vector3};
use proptest::prelude::*;

use super::*;
use crate::bodies::surface::{MERCURY, PlanetSurface};
use crate::constants::{RADIUS_MERCURY_M as RADIUS_M, SPEED_OF_LIGHT_M_S, STEFAN_BOLTZMANN_W_M2_K4};
use crate::loads::Effect::{self, Solar as SOLAR, Thermal as RECOIL};
use crate::loads::{Active, ForceTorque, Loads};
use crate::numerics::scalar::{Dual64, Scalar};
use crate::radiation::{Beam, SolarModel};
use crate::spacecraft::{
    Emission, FaceThermal, MESSENGER_THERMAL_TOML, MESSENGER_TOML, Optics, Plate, Spacecraft, SunshadeModel,
};

fn options(nodes: usize) -> Options {
    Options { planet: Some(MERCURY), planet_light: PlanetLightMethod::Rings(nodes), ..Options::default() }
}

fn thermal_messenger() -> Spacecraft {
    Spacecraft::from_toml("messenger-thermal.toml", MESSENGER_THERMAL_TOML).unwrap()
}

fn direction(azimuth: f64, z: f64) -> Vector3<f64> {
    let rho = (1.0 - z * z).sqrt();
    Vector3::new(rho * azimuth.cos(), rho * azimuth.sin(), z)
}

fn bare(plates: Vec<Plate>) -> Spacecraft {
    Spacecraft { plates, sunshade: None, panels: Vec::new(), ..thermal_messenger() }
}

fn plate(normal: Vector3<f64>, center_m: Vector3<f64>, area_m2: f64, optics: Optics) -> Plate {
    Plate::insulated("plate".to_owned(), area_m2, center_m, normal, (optics, None))
}

/// A closed crooked body: a tetrahedron with a different material on each face.
fn tetrahedron(optics: [Optics; 4]) -> Vec<Plate> {
    let corners =
        [[1.0, 0.2, -0.3], [-0.7, 1.1, 0.0], [-0.4, -0.9, -0.8], [0.1, 0.3, 1.4]].map(Vector3::from);
    (0..4)
        .map(|skip| {
            let [a, b, c] = [(skip + 1) % 4, (skip + 2) % 4, (skip + 3) % 4].map(|i| corners[i]);
            let area = (b - a).cross(&(c - a)) / 2.0;
            let outward = if area.dot(&(a - corners[skip])) > 0.0 { area } else { -area };
            plate(outward.normalize(), (a + b + c) / 3.0, area.norm(), optics[skip])
        })
        .collect()
}

/// All of the sky equally bright: two planets nearly touched on opposite sides, at night.
fn in_isotropic_light(spacecraft: &Spacecraft) -> [ForceTorque<f64>; 2] {
    let surface = PlanetSurface { night_temperature_k: 400.0, ..MERCURY };
    let options = Options { planet: Some(surface), ..options(40) };
    let model = DisturbanceModel::new(spacecraft, &options).unwrap();
    let mut light = ForceTorque::zero();
    let mut recoil = ForceTorque::zero();
    for side in [-1.0, 1.0] {
        let nadir = direction(0.7, 0.3) * side;
        let geometry = Geometry {
            planet: Some(PlanetGeometry {
                position_body_m: nadir * RADIUS_M * (1.0 + 1e-13),
                sun_from_planet_body_m: nadir,
                sun_flux_w_m2: 0.0,
                pole_body: Some(Vector3::z()),
            }),
            ..Geometry::sunlit(nadir, 0.0)
        };
        let found = model.evaluate(&geometry, Recoil::Balance, &mut Workspace::default()).unwrap();
        light += found[Effect::Infrared];
        recoil += found[RECOIL];
    }
    [light, recoil]
}

#[test]
fn a_closed_body_in_isotropic_light_feels_no_force() {
    let mixed = [(0.1, 0.2), (0.6, 0.3), (0.0, 0.9), (0.3, 0.0)]
        .map(|(specular, diffuse)| Optics::from_reflectivities(specular, diffuse));
    let same_absorptivity = [(0.4, 0.0), (0.0, 0.4), (0.1, 0.3), (0.3, 0.1)]
        .map(|(specular, diffuse)| Optics::from_reflectivities(specular, diffuse));
    let scale = 400_f64.powi(4) * STEFAN_BOLTZMANN_W_M2_K4 / SPEED_OF_LIGHT_M_S;
    // The sky has a seam of 1e-6 rad between the two planets.
    let tolerance = 1e-6 * scale;
    let [light, recoil] = in_isotropic_light(&bare(tetrahedron(same_absorptivity)));
    assert!(light.force_body_n.norm() < tolerance && recoil.force_body_n.norm() < tolerance);
    assert!(light.torque_body_n_m.norm() < tolerance);
    // With any optics: every face gives off what it takes in.
    let [light, recoil] = in_isotropic_light(&bare(tetrahedron(mixed)));
    assert!(light.force_body_n.norm() > 1e-2 * scale);
    assert!((light + recoil).force_body_n.norm() < tolerance);
    assert!((light + recoil).torque_body_n_m.norm() < tolerance);
}

/// Sun-facing black plate: pushed by A S / c, and by 2/3 of that again by its own heat.
#[test]
fn an_insulated_black_plate_recoils_by_two_thirds_of_the_light() {
    let spacecraft =
        bare(vec![plate(-Vector3::y(), Vector3::x(), 2.0, Optics::from_reflectivities(0.0, 0.0))]);
    // The law is that of absolutely cold space.
    let spacecraft = Spacecraft { background_k: 0.0, ..spacecraft };
    let model = DisturbanceModel::new(&spacecraft, &Options::default()).unwrap();
    let geometry = Geometry { lit_fraction: 0.5, ..Geometry::sunlit(-Vector3::y(), 9000.0) };
    let mut workspace = Workspace::default();
    let found = model.evaluate(&geometry, Recoil::Balance, &mut workspace).unwrap();
    let push = 2.0 * 4500.0 / SPEED_OF_LIGHT_M_S;
    assert_relative_eq!(found[SOLAR].force_body_n, Vector3::y() * push, epsilon = 1e-20);
    assert_relative_eq!(found[RECOIL].force_body_n, Vector3::y() * push * 2.0 / 3.0, epsilon = 1e-20);
    assert_relative_eq!(found[RECOIL].torque_body_n_m, Vector3::z() * push * 2.0 / 3.0, epsilon = 1e-20);
    let temperature = workspace.faces()[0].temperature_k;
    assert_relative_eq!(temperature, (4500.0 / STEFAN_BOLTZMANN_W_M2_K4).powf(0.25), max_relative = 1e-12);
    assert_eq!(found[Effect::Albedo], ForceTorque::zero());
}

#[test]
fn heat_from_inside_pushes_where_it_leaves() {
    let mut body = plate(Vector3::z(), Vector3::x(), 1.0, Optics::from_reflectivities(0.2, 0.0));
    body.faces.thermal.internal_heat_w[0] = 300.0;
    let model = DisturbanceModel::new(&bare(vec![body]), &Options::default()).unwrap();
    let dark = Geometry::sunlit(-Vector3::z(), 1361.0);
    let found = model.evaluate(&dark, Recoil::Balance, &mut Workspace::default()).unwrap();
    let expected = -Vector3::z() * (2.0 / 3.0 * 300.0 / SPEED_OF_LIGHT_M_S);
    assert_relative_eq!(found[RECOIL].force_body_n, expected, epsilon = 1e-20);
}

/// Only the difference of emissivities makes conducting faces push differently; power is conserved.
#[test]
fn a_conducting_panel_gives_off_what_it_takes_in() {
    let spacecraft = thermal_messenger();
    let model = DisturbanceModel::new(&spacecraft, &options(6)).unwrap();
    let mut workspace = Workspace::default();
    let geometry = messenger_geometry([1.0, 0.2, -0.4], [0.3, -1.0, 0.1], &[0.2, 0.2]);
    model.evaluate(&geometry, Recoil::Balance, &mut workspace).unwrap();
    let mut heat_w = vec![0.0; model.face_count()];
    model.heat_w(&workspace, &mut heat_w);
    let names: Vec<String> = model.face_names().collect();
    assert_eq!(names[8..], ["+X", "+X, rear", "-X", "-X, rear"]);
    for panel in [8, 10] {
        let radiated: f64 = [(panel, 0.75), (panel + 1, 0.7)]
            .iter()
            .map(|&(face, emissivity)| {
                let t = workspace.faces()[face].temperature_k;
                emissivity * STEFAN_BOLTZMANN_W_M2_K4 * 2.724 * t.powi(4)
            })
            .sum();
        assert_relative_eq!(radiated, heat_w[panel] + heat_w[panel + 1], max_relative = 1e-9);
        assert!(workspace.faces()[panel].temperature_k > workspace.faces()[panel + 1].temperature_k);
    }
}

fn messenger_geometry<'a>(planet: [f64; 3], sun: [f64; 3], angles: &'a [f64]) -> Geometry<'a, f64> {
    let planet_m = Vector3::from(planet).normalize() * 3.4e6;
    let sun_m = Vector3::from(sun).normalize() * 5.8e10;
    Geometry::at(1361.0, &sun_m, Some(&planet_m), 1.0, angles, Vector3::new(0.01, -0.02, 0.03)).unwrap()
}

#[test]
fn sunlight_is_that_of_the_solar_model() {
    for (file, text) in [("messenger.toml", MESSENGER_TOML), ("thermal", MESSENGER_THERMAL_TOML)] {
        let spacecraft = Spacecraft::from_toml(file, text).unwrap();
        for form in [None, Some(SunshadeModel::Cylinder)] {
            if form.is_some() && spacecraft.sunshade.is_none() {
                continue;
            }
            let alone = SolarModel::new(&spacecraft, form).unwrap();
            let options = Options { sunshade_model: form, ..Options::default() };
            let model = DisturbanceModel::new(&spacecraft, &options).unwrap();
            for sun in [[0.1, -1.0, 0.2], [-0.5, -0.3, 0.9], [0.2, 1.0, 0.1]] {
                let geometry = messenger_geometry([1.0, 0.0, 0.0], sun, &[0.3, -0.2]);
                let found = model.evaluate(&geometry, Recoil::Balance, &mut Workspace::default()).unwrap();
                let beam = Beam {
                    source_body: geometry.sun_direction_body,
                    pressure_pa: geometry.sun_flux_w_m2 / SPEED_OF_LIGHT_M_S,
                };
                let com = geometry.center_of_mass_body_m;
                let expected = alone.load(
                    &beam,
                    |k, panel| geometry.panel_angles_rad.get(k).map(|it| panel.normal_body(*it)),
                    &com,
                );
                assert_relative_eq!(found[SOLAR].force_body_n, expected.force_body_n, epsilon = 1e-17);
                assert_relative_eq!(found[SOLAR].torque_body_n_m, expected.torque_body_n_m, epsilon = 1e-17);
            }
        }
    }
}

#[test]
fn a_cylinder_of_strips_recoils_like_its_light_says() {
    let spacecraft = Spacecraft::from_toml("messenger.toml", MESSENGER_TOML).unwrap();
    let options = Options { sunshade_model: Some(SunshadeModel::Cylinder), ..options(6) };
    let model = DisturbanceModel::new(&spacecraft, &options).unwrap();
    let geometry = messenger_geometry([0.0, 1.0, 0.0], [0.0, -1.0, 0.0], &[0.0, 0.0]);
    let mut workspace = Workspace::default();
    let found = model.evaluate(&geometry, Recoil::Balance, &mut workspace).unwrap();
    // Absorbed power of the shade: alpha S times its shadow 2 R sin(61 deg) H.
    let absorbed: f64 = workspace.faces()[..24].iter().map(|face| face.absorbed_sun_w).sum();
    let shadow_m2 = 2.0 * 0.991 * 61_f64.to_radians().sin() * 2.489;
    assert_relative_eq!(absorbed, 0.5 * geometry.sun_flux_w_m2 * shadow_m2, max_relative = 1e-3);
    // Flat strips of 5 deg stand for the round shade to the square of their half angle.
    let faces: Vector3<f64> = workspace.faces().iter().map(|face| face.forces_body_n[SOLAR as usize]).sum();
    assert_relative_eq!(faces.y, found[SOLAR].force_body_n.y, max_relative = 1e-3);
    assert!(found[RECOIL].force_body_n.y > 0.0 && found[RECOIL].force_body_n.x.abs() < 1e-12);
}

#[test]
fn stored_heat_radiates_into_the_eclipse() {
    let mut spacecraft = thermal_messenger();
    for panel in &mut spacecraft.panels {
        panel.faces.thermal.heat_capacity_j_m2_k = 3000.0;
    }
    let model = DisturbanceModel::new(&spacecraft, &options(6)).unwrap();
    assert!(model.stores_heat());
    let lit = messenger_geometry([1.0, 1.0, 0.0], [0.0, -1.0, 0.0], &[0.0, 0.0]);
    let dark = Geometry { lit_fraction: 0.0, ..lit };
    let mut workspace = Workspace::default();
    model.evaluate(&lit, Recoil::Balance, &mut workspace).unwrap();
    let mut temperatures_k: Vec<f64> = workspace.faces().iter().map(|face| face.temperature_k).collect();
    let in_light = model.evaluate(&lit, Recoil::Stored(&temperatures_k), &mut workspace).unwrap();
    let balanced = model.evaluate(&lit, Recoil::Balance, &mut workspace).unwrap();
    assert_relative_eq!(in_light[RECOIL].force_body_n, balanced[RECOIL].force_body_n, epsilon = 1e-18);
    let mut heat_w = vec![0.0; model.face_count()];
    let dark_balance = model.evaluate(&dark, Recoil::Balance, &mut workspace).unwrap()[RECOIL].force_body_n;
    model.heat_w(&workspace, &mut heat_w);
    let mut last = balanced[RECOIL].force_body_n;
    for _ in 0..5 {
        model.advance_temperatures(&mut temperatures_k, &heat_w, &heat_w, 300.0);
        let now = model.evaluate(&dark, Recoil::Stored(&temperatures_k), &mut workspace).unwrap();
        assert!((now[RECOIL].force_body_n - dark_balance).norm() < (last - dark_balance).norm());
        last = now[RECOIL].force_body_n;
    }
    model.advance_temperatures(&mut temperatures_k, &heat_w, &heat_w, 1e7);
    let cold = model.evaluate(&dark, Recoil::Stored(&temperatures_k), &mut workspace).unwrap();
    assert_relative_eq!(cold[RECOIL].force_body_n, dark_balance, epsilon = 1e-14);
}

#[test]
fn impossible_geometries_and_options_are_refused() {
    let spacecraft = thermal_messenger();
    let model = DisturbanceModel::new(&spacecraft, &options(6)).unwrap();
    let good = messenger_geometry([1.0, 0.0, 0.0], [0.0, -1.0, 0.0], &[0.0, 0.0]);
    let says = |geometry: &Geometry<'_, f64>, recoil: Recoil<'_>, text: &str| {
        let error = model.evaluate(geometry, recoil, &mut Workspace::default()).unwrap_err().to_string();
        assert!(error.contains(text), "{error}");
    };
    says(&Geometry { panel_angles_rad: &[0.0], ..good }, Recoil::Balance, "1 panel angles, allowed: 2");
    says(&Geometry { lit_fraction: f64::NAN, ..good }, Recoil::Balance, "the lit fraction is not finite");
    says(&good, Recoil::Stored(&[300.0]), "1 face temperatures, allowed: 12");
    let inside = PlanetGeometry { position_body_m: Vector3::x() * 1e6, ..good.planet.unwrap() };
    says(&Geometry { planet: Some(inside), ..good }, Recoil::Balance, "more than its radius");
    let sun_at = |m: f64| Geometry::at(1361.0, &Vector3::new(m, 0.0, 0.0), None, 1.0, &[], Vector3::zeros());
    assert!(sun_at(0.0).unwrap_err().to_string().contains("Sun is at a distance of 0 m"));
    assert!(sun_at(f64::NAN).is_err());
    let surface = PlanetSurface { emissivity: 2.0, ..MERCURY };
    let options = Options { planet: Some(surface), ..options(6) };
    assert!(DisturbanceModel::new(&spacecraft, &options).unwrap_err().to_string().contains("emissivity"));
    let options = Options { planet_light: PlanetLightMethod::Rings(0), ..Options::default() };
    assert!(DisturbanceModel::new(&spacecraft, &options).unwrap_err().to_string().contains("1 to 64"));
}

fn rotated(spacecraft: &Spacecraft, rotation: &Matrix3<f64>) -> Spacecraft {
    let mut turned = spacecraft.clone();
    turned.plates = spacecraft.plates.iter().map(|plate| plate.rotated(rotation)).collect();
    for panel in &mut turned.panels {
        panel.center_body_m = rotation * panel.center_body_m;
        panel.axis_body = rotation * panel.axis_body;
        panel.zero_normal_body = rotation * panel.zero_normal_body;
    }
    turned
}

/// Everything as a function of one seed that moves Sun, planet, panels and centre of mass.
fn along_seed<T: Scalar>(model: &DisturbanceModel, [sun, planet]: [Vector3<f64>; 2], seed: T) -> Loads<T> {
    let moved = |v: Vector3<f64>, by: [f64; 3], scale: f64| {
        v.map(T::constant) + Vector3::from(by.map(|x| seed * (x * scale)))
    };
    let sun_m = moved(sun * 6e10, [0.3, -0.2, 0.5], 6e10);
    let planet_m = moved(planet, [-0.4, 0.6, 0.3], RADIUS_M);
    let angles = [seed * 0.8 + 0.3, seed * -0.5 - 0.2];
    let com = moved(Vector3::new(0.1, -0.2, 0.05), [1.0, -2.0, 0.5], 1.0);
    let geometry =
        Geometry::at(T::constant(1361.0), &sun_m, Some(&planet_m), seed * 0.1 + 0.8, &angles, com).unwrap();
    model.evaluate(&geometry, Recoil::Balance, &mut Workspace::default()).unwrap()
}

proptest! {
    #[test]
    fn turning_everything_turns_the_result(
        a in -PI..PI, z in -1.0..1.0_f64, b in -PI..PI, w in -1.0..1.0_f64,
        turn in prop::array::uniform3(-3.0..3.0_f64),
    ) {
        let spacecraft = thermal_messenger();
        let rotation = Rotation3::from_euler_angles(turn[0], turn[1], turn[2]).into_inner();
        let models = [spacecraft.clone(), rotated(&spacecraft, &rotation)]
            .map(|spacecraft| DisturbanceModel::new(&spacecraft, &options(6)).unwrap());
        let (sun, planet) = (direction(a, z) * 6e10, direction(b, w) * 3e6);
        let com = Vector3::new(0.1, 0.2, -0.1);
        let [still, moved] = [(0, Matrix3::identity()), (1, rotation)].map(|(i, r)| {
            let angles = [0.4, -0.1];
            let geometry = Geometry::at(1361.0, &(r * sun), Some(&(r * planet)), 1.0, &angles, r * com).unwrap();
            models[i].evaluate(&geometry, Recoil::Balance, &mut Workspace::default()).unwrap()
        });
        for (still, moved) in still.values().iter().zip(moved.values()) {
            prop_assert!((moved.force_body_n - rotation * still.force_body_n).norm() < 1e-15);
            prop_assert!((moved.torque_body_n_m - rotation * still.torque_body_n_m).norm() < 1e-15);
        }
    }

    #[test]
    fn the_faces_add_up(a in -PI..PI, z in -1.0..1.0_f64, b in -PI..PI, w in -1.0..1.0_f64) {
        let model = DisturbanceModel::new(&thermal_messenger(), &options(6)).unwrap();
        let (sun, planet) = (direction(a, z) * 6e10, direction(b, w) * 3e6);
        let geometry = Geometry::at(1361.0, &sun, Some(&planet), 1.0, &[0.4, -0.1], Vector3::zeros()).unwrap();
        let mut workspace = Workspace::default();
        let found = model.evaluate(&geometry, Recoil::Balance, &mut workspace).unwrap();
        let all = Active::by(|_| true);
        let sum: Vector3<f64> = workspace.faces().iter().map(|face| face.force_body_n(all)).sum();
        prop_assert!((sum - found.total().force_body_n).norm() < 1e-17);
        // Used again, the workspace leaves nothing behind.
        let again = model.evaluate(&geometry, Recoil::Balance, &mut workspace).unwrap();
        prop_assert_eq!(again, found);
    }

    #[test]
    fn derivatives_are_slopes(
        a in -PI..PI, z in -1.0..1.0_f64, b in -PI..PI, w in -1.0..1.0_f64, distance in 1.1..5.0_f64,
    ) {
        // So many that the quadrature's own error does not show in a slope, even where rings are split in haste.
        let model = DisturbanceModel::new(&thermal_messenger(), &options(16)).unwrap();
        let geometry = [direction(a, z), direction(b, w) * distance * RADIUS_M];
        let exact = along_seed(&model, geometry, Dual64::new(0.0, 1.0));
        let h = 1e-5;
        let quotient = |effect: Effect, h: f64| {
            let [low, high] = [-h, h].map(|seed| along_seed(&model, geometry, seed)[effect]);
            (high.force_body_n - low.force_body_n, high.torque_body_n_m - low.torque_body_n_m)
        };
        for (effect, exact) in exact.iter().take(Effect::LIGHT) {
            let (near, far) = (quotient(effect, h), quotient(effect, 2.0 * h));
            let scale = exact.force_body_n.map(|x| x.re).norm() + exact.force_body_n.map(|x| x.eps).norm();
            let (force_near, force_far) = (near.0 / (2.0 * h), far.0 / (4.0 * h));
            let (torque_near, torque_far) = (near.1 / (2.0 * h), far.1 / (4.0 * h));
            // Away from edges, where the quotient does not depend on the step.
            prop_assume!((force_near - force_far).norm() + (torque_near - torque_far).norm() < 2e-7 * scale);
            let force = (force_near * 4.0 - force_far) / 3.0;
            let torque = (torque_near * 4.0 - torque_far) / 3.0;
            prop_assert!((force - exact.force_body_n.map(|x| x.eps)).norm() <= 1e-6 * scale);
            prop_assert!((torque - exact.torque_body_n_m.map(|x| x.eps)).norm() <= 1e-6 * scale);
        }
    }

    /// Emissivity changes temperatures, but an insulated face gives off what it takes in.
    #[test]
    fn recoil_of_insulated_faces_does_not_depend_on_emissivity(
        emissivity in 0.01..1.0_f64, slope in 0.0..1e-3_f64, a in -PI..PI, z in -1.0..1.0_f64,
    ) {
        let black = Optics::from_reflectivities(0.1, 0.3);
        let mut spacecraft = bare(tetrahedron([black; 4]));
        let geometry = Geometry::at(
            1361.0, &(direction(a, z) * 6e10), Some(&(direction(z, a / 4.0) * 3e6)), 1.0, &[], Vector3::zeros(),
        ).unwrap();
        let recoil = |spacecraft: &Spacecraft| {
            let model = DisturbanceModel::new(spacecraft, &options(6)).unwrap();
            model.evaluate(&geometry, Recoil::Balance, &mut Workspace::default()).unwrap()[RECOIL]
        };
        let before = recoil(&spacecraft);
        for plate in &mut spacecraft.plates {
            plate.faces.thermal.front = FaceThermal {
                infrared_optics: black,
                emission: Emission { emissivity, slope_per_k: slope, reference_temperature_k: 300.0 },
            };
        }
        prop_assert_eq!(recoil(&spacecraft), before);
    }
}

//! What a face takes in it gives off from where it took it in: temperatures and recoil by hand.

use approx::assert_relative_eq;
use nalgebra::Vector3;

use super::*;
use crate::bodies::surface::{MERCURY, PlanetSurface};
use crate::constants::{RADIUS_MERCURY_M as RADIUS_M, SPEED_OF_LIGHT_M_S};
use crate::loads::Effect::{Solar as SOLAR, Thermal as RECOIL};
use crate::spacecraft::{
    BusLink, Emission, FaceThermal, MESSENGER_THERMAL_TOML, Optics, Plate, Polygon, Spacecraft, Thermal,
};

fn spacecraft(plates: Vec<Plate>) -> Spacecraft {
    let whole = Spacecraft::from_toml("messenger-thermal.toml", MESSENGER_THERMAL_TOML).unwrap();
    Spacecraft { plates, sunshade: None, panels: Vec::new(), ..whole }
}

fn square(normal: Vector3<f64>, center_m: Vector3<f64>, half_m: f64, optics: Optics) -> Plate {
    let east = if normal.x.abs() > 0.5 { Vector3::y() } else { Vector3::x() };
    let north = normal.cross(&east);
    let corner = |a: f64, b: f64| center_m + (east * a + north * b) * half_m;
    let vertices = vec![corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
    Plate::outlined("square".to_owned(), Polygon::new(vertices).unwrap(), optics, None)
}

fn sunlit(sun_direction_body: Vector3<f64>) -> Geometry<'static, f64> {
    Geometry::sunlit(sun_direction_body, 9000.0)
}

/// A plate that faces a planet at night sees it under the square of radius over distance; how much of that heats it is
/// its absorptivity for infrared, not for sunlight.
#[test]
fn planet_heat_is_absorbed_by_infrared_optics() {
    let mut plate = square(Vector3::z(), Vector3::zeros(), 0.5, Optics::from_reflectivities(0.1, 0.1));
    plate.faces.thermal.front = FaceThermal {
        infrared_optics: Optics::from_reflectivities(0.5, 0.2),
        emission: Emission { emissivity: 0.6, slope_per_k: 0.0, reference_temperature_k: 300.0 },
    };
    let surface = PlanetSurface {
        absorptivity: 0.9,
        diffuse_reflectivity: 0.1,
        emissivity: 0.95,
        night_temperature_k: 400.0,
        ..MERCURY
    };
    let options =
        Options { planet: Some(surface), planet_light: PlanetLightMethod::Rings(16), ..Options::default() };
    let model = DisturbanceModel::new(&spacecraft(vec![plate]), &options).unwrap();
    let geometry = Geometry {
        planet: Some(PlanetGeometry {
            position_body_m: Vector3::z() * 2.0 * RADIUS_M,
            sun_from_planet_body_m: Vector3::z(),
            sun_flux_w_m2: 0.0,
            pole_body: Some(Vector3::x()),
        }),
        sun_flux_w_m2: 0.0,
        ..sunlit(-Vector3::z())
    };
    let mut workspace = Workspace::default();
    let found = model.evaluate(&geometry, Recoil::Balance, &mut workspace).unwrap();
    // emissivity_plate T^4 = 0.3 emissivity_planet T_planet^4 / 4
    let expected_k = 400.0 * (0.3 * 0.95 / (4.0 * 0.6_f64)).powf(0.25);
    assert_relative_eq!(workspace.faces()[0].temperature_k, expected_k, max_relative = 1e-4);
    let taken_w = 0.3 * 0.95 / 4.0 * crate::constants::STEFAN_BOLTZMANN_W_M2_K4 * 400.0_f64.powi(4);
    let expected_n = -2.0 / 3.0 * taken_w / SPEED_OF_LIGHT_M_S;
    assert_relative_eq!(found[RECOIL].force_body_n.z, expected_n, max_relative = 1e-4);
}

#[test]
fn each_side_gives_off_the_heat_from_inside_that_is_its_own() {
    let black = Optics::from_reflectivities(0.0, 0.0);
    let mut plate = square(Vector3::z(), Vector3::x(), 0.5, black);
    plate.faces.rear_optics = Some(black);
    plate.faces.thermal = Thermal::insulated(&black, Some(&black));
    plate.faces.thermal.internal_heat_w = [300.0, 120.0];
    let model = DisturbanceModel::new(&spacecraft(vec![plate]), &Options::default()).unwrap();
    let dark = Geometry { lit_fraction: 0.0, ..sunlit(Vector3::z()) };
    let found = model.evaluate(&dark, Recoil::Balance, &mut Workspace::default()).unwrap();
    let expected = Vector3::z() * (-2.0 / 3.0 * (300.0 - 120.0) / SPEED_OF_LIGHT_M_S);
    assert_relative_eq!(found[RECOIL].force_body_n, expected, max_relative = 1e-12);
    assert_relative_eq!(found[RECOIL].torque_body_n_m, Vector3::x().cross(&expected), max_relative = 1e-12);
}

/// An insulated plate half in shadow is warm on its lit half alone, and pushes there.
#[test]
fn a_face_half_in_shadow_recoils_where_it_is_lit() {
    let black = Optics::from_reflectivities(0.0, 0.0);
    // The caster, seen from the Sun, hides all with x > 0.
    let plates = vec![
        square(Vector3::z(), Vector3::zeros(), 1.0, black),
        square(Vector3::z(), Vector3::new(2.0, 0.0, 1.0), 2.0, black),
    ];
    let options = Options { self_shadowing: true, ..Options::default() };
    let model = DisturbanceModel::new(&spacecraft(plates), &options).unwrap();
    let mut workspace = Workspace::default();
    let found = model.evaluate(&sunlit(Vector3::z()), Recoil::Balance, &mut workspace).unwrap();
    let pressure_pa = 9000.0 / SPEED_OF_LIGHT_M_S;
    // Lit: 2 m2 about x = -0.5 m, and the caster's 16 m2 about x = 2 m; twice the cross product of x and -z is y.
    let moment_m3 = 2.0 * -0.5 + 16.0 * 2.0;
    assert_relative_eq!(found[SOLAR].torque_body_n_m.y, pressure_pa * moment_m3, max_relative = 1e-12);
    assert_relative_eq!(
        found[RECOIL].torque_body_n_m.y,
        2.0 / 3.0 * pressure_pa * moment_m3,
        max_relative = 1e-12
    );
    assert_relative_eq!(found[RECOIL].force_body_n.z, -2.0 / 3.0 * pressure_pa * 18.0, max_relative = 1e-12);
}

/// Sun on a black plate that conducts heat to the bus: what it radiates is what is left, and pushes by 2/3 of its momentum from
/// the middle of the plate; unlit it is kept warm by the bus, and one without a bus is as cold as space.
#[test]
fn a_plate_on_the_bus_pushes_by_what_the_bus_leaves() {
    let black = Optics::from_reflectivities(0.0, 0.0);
    // 9000 W/m2 of sunlight: at 350 K the plate radiates 850.9 W/m2 and gives 8149 W/m2 to a bus of 300 K.
    let (target_k, bus_k) = (350.0_f64, 300.0);
    let radiated = crate::constants::STEFAN_BOLTZMANN_W_M2_K4 * target_k.powi(4);
    let link = BusLink { conductance_w_m2_k: (9000.0 - radiated) / (target_k - bus_k), temperature_k: bus_k };
    let mut plate = square(Vector3::z(), Vector3::x(), 0.5, black);
    plate.faces.thermal.bus[0] = link;
    let bare = square(-Vector3::z(), Vector3::x(), 0.5, black);
    let two_plates = Spacecraft { background_k: 0.0, ..spacecraft(vec![plate.clone(), bare.clone()]) };
    let model =
        DisturbanceModel::new(&two_plates, &Options { self_shadowing: false, ..Options::default() }).unwrap();
    let mut workspace = Workspace::default();
    let found = model.evaluate(&sunlit(Vector3::z()), Recoil::Balance, &mut workspace).unwrap();
    assert_relative_eq!(workspace.faces()[0].temperature_k, target_k, max_relative = 1e-12);
    assert_eq!(workspace.faces()[1].temperature_k, 0.0);
    let expected = Vector3::z() * (-2.0 / 3.0 * radiated / SPEED_OF_LIGHT_M_S);
    assert_relative_eq!(found[RECOIL].force_body_n, expected, max_relative = 1e-11);
    assert_relative_eq!(found[RECOIL].torque_body_n_m, Vector3::x().cross(&expected), max_relative = 1e-11);

    // In the dark, with space at 2.725 K as files have it unless they say otherwise.
    let two_plates = spacecraft(vec![plate, bare]);
    assert_eq!(two_plates.background_k, 2.725);
    let model = DisturbanceModel::new(&two_plates, &Options::default()).unwrap();
    let dark = Geometry { lit_fraction: 0.0, ..sunlit(Vector3::z()) };
    let found = model.evaluate(&dark, Recoil::Balance, &mut workspace).unwrap();
    let [warm, cold] = [0, 1].map(|face| workspace.faces()[face]);
    let from_bus_w_m2 = link.conductance_w_m2_k * (bus_k - warm.temperature_k);
    assert!(warm.temperature_k > 290.0 && cold.temperature_k == 2.725);
    let expected_n = -2.0 / 3.0 * from_bus_w_m2 / SPEED_OF_LIGHT_M_S;
    assert_relative_eq!(found[RECOIL].force_body_n.z, expected_n, max_relative = 1e-9);
    assert_eq!(cold.forces_body_n[RECOIL as usize], Vector3::zeros());
}

/// The transient solver comes to the balance that the other gives, bus and space included; heat that flows to the bus on the way
/// is missing from what is stored.
#[test]
fn stored_heat_goes_to_the_bus_as_in_balance() {
    let white = Optics::from_reflectivities(0.2, 0.5);
    let mut plate = square(Vector3::z(), Vector3::x(), 0.5, white);
    plate.faces.thermal.heat_capacity_j_m2_k = 2000.0;
    plate.faces.thermal.bus[0] = BusLink { conductance_w_m2_k: 4.0, temperature_k: 280.0 };
    let model = DisturbanceModel::new(&spacecraft(vec![plate]), &Options::default()).unwrap();
    let mut workspace = Workspace::default();
    let lit = sunlit(Vector3::z());
    let balanced = model.evaluate(&lit, Recoil::Balance, &mut workspace).unwrap();
    let (balanced_k, mut heat_w) = (workspace.faces()[0].temperature_k, [0.0]);
    model.heat_w(&workspace, &mut heat_w);
    let mut stored_k = [150.0];
    model.advance_temperatures(&mut stored_k, &heat_w, &heat_w, 1e6);
    assert_relative_eq!(stored_k[0], balanced_k, max_relative = 1e-8);
    let found = model.recoil(&lit, Recoil::Stored(&stored_k), &mut workspace).unwrap();
    assert_relative_eq!(found.force_body_n, balanced[RECOIL].force_body_n, max_relative = 1e-7);
}

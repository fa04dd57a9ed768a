//! Shapes of a spacecraft file are the plates somebody could have written, with the areas and forces of the bodies they
//! stand for.

use std::f64::consts::PI;

use approx::assert_relative_eq;
use nalgebra::{Matrix3, Vector3};
use physics::loads::{Effect, ForceTorque};
use physics::radiation::disturbance::{DisturbanceModel, Geometry, Options, Recoil, Workspace};
use physics::radiation::{Beam, SolarModel};
use physics::spacecraft::{Plate, Spacecraft};

pub(crate) const HEAD: &str = include_str!("shapes.toml");

fn spacecraft(surfaces: &str) -> Spacecraft {
    Spacecraft::from_toml("shapes.toml", &format!("{HEAD}{surfaces}")).unwrap()
}

fn area_m2(plates: &[Plate]) -> f64 {
    plates.iter().map(|plate| plate.area_m2).sum()
}

/// The area that faces a direction.
fn shown_m2(plates: &[Plate], toward: &Vector3<f64>) -> f64 {
    plates.iter().map(|plate| plate.area_m2 * plate.normal.dot(toward).max(0.0)).sum()
}

/// Force and torque of light of a pressure of 1 Pa, about the origin.
fn load(spacecraft: &Spacecraft, source_body: Vector3<f64>) -> ForceTorque<f64> {
    let beam = Beam { source_body, pressure_pa: 1.0 };
    SolarModel::new(spacecraft, None).unwrap().load(&beam, |_, _| None, &Vector3::zeros())
}

/// Directions in all octants.
fn directions() -> impl Iterator<Item = Vector3<f64>> {
    (0..40).map(|k| {
        let (z, azimuth) = (1.0 - (f64::from(k) + 0.5) / 20.0, 2.4 * f64::from(k));
        let across = (1.0 - z * z).sqrt();
        Vector3::new(across * azimuth.cos(), across * azimuth.sin(), z)
    })
}

/// With self-shadowing by the simulated model.
fn shadowed_force_n(
    spacecraft: &Spacecraft,
    source_body: Vector3<f64>,
    self_shadowing: bool,
) -> Vector3<f64> {
    let options = Options { self_shadowing, ..Options::default() };
    let model = DisturbanceModel::new(spacecraft, &options).unwrap();
    let geometry = Geometry::sunlit(source_body, 1361.0);
    let mut workspace = Workspace::default();
    model.evaluate(&geometry, Recoil::Balance, &mut workspace).unwrap()[Effect::Solar].force_body_n
}

#[test]
fn a_box_is_the_plates_somebody_could_have_written() {
    let shape = "[[boxes]]\nname = 'bus'\ncenter_m = [0.5, 0, 1]\nsize_m = [1, 2, 4]\noptics = 'grey'\n\
        face_optics = {'-Y' = 'white'}\nopen_faces = ['+Z']\nrear_optics = 'black'\n\
        thermal = {internal_heat_w = 48, heat_capacity_j_m2_k = 3}\n";
    let rest = "rear_optics = 'black'\n";
    // 26 m2 of five faces share 48 W.
    let plate = |name: &str, outline: &str, optics: &str, area_m2: f64| {
        let heat =
            format!("thermal = {{internal_heat_w = {}, heat_capacity_j_m2_k = 3}}\n", 48.0 * area_m2 / 26.0);
        format!("[[plates]]\nname = 'bus.{name}'\npolygon_m = {outline}\noptics = '{optics}'\n{rest}{heat}")
    };
    let by_hand = [
        plate("+X", "[[1, -1, -1], [1, 1, -1], [1, 1, 3], [1, -1, 3]]", "grey", 8.0),
        plate("-X", "[[0, -1, 3], [0, 1, 3], [0, 1, -1], [0, -1, -1]]", "grey", 8.0),
        plate("+Y", "[[0, 1, -1], [0, 1, 3], [1, 1, 3], [1, 1, -1]]", "grey", 4.0),
        plate("-Y", "[[1, -1, -1], [1, -1, 3], [0, -1, 3], [0, -1, -1]]", "white", 4.0),
        plate("-Z", "[[0, 1, -1], [1, 1, -1], [1, -1, -1], [0, -1, -1]]", "grey", 2.0),
    ];
    let (shape, by_hand) = (spacecraft(shape), spacecraft(&by_hand.concat()));
    assert_eq!(shape.plates.len(), 5);
    for (one, other) in shape.plates.iter().zip(&by_hand.plates) {
        assert_eq!((&one.name, one.area_m2), (&other.name, other.area_m2));
        assert_eq!((one.center_m, one.normal), (other.center_m, other.normal));
        assert_eq!(
            (one.faces.optics, one.faces.rear_optics, one.faces.thermal),
            (other.faces.optics, other.faces.rear_optics, other.faces.thermal)
        );
        // The same outline, from another corner on.
        let (one, other) = (one.polygon.as_ref().unwrap(), other.polygon.as_ref().unwrap());
        let first = other.vertices_m().iter().position(|vertex| *vertex == one.vertices_m()[0]).unwrap();
        let turned = other.vertices_m().iter().cycle().skip(first);
        assert!(one.vertices_m().iter().zip(turned).all(|(a, b)| a == b));
    }
    for source in directions() {
        assert_eq!(load(&shape, source), load(&by_hand, source));
    }
}

#[test]
fn a_turned_box_shows_what_a_box_shows_in_its_own_axes() {
    let straight = spacecraft("[[boxes]]\ncenter_m = [1, 2, 3]\nsize_m = [1, 2, 4]\noptics = 'grey'\n");
    let turned = spacecraft(
        "[[boxes]]\ncenter_m = [1, 2, 3]\nsize_m = [1, 2, 4]\nrotation_deg = [0, 0, 90]\noptics = 'grey'\n",
    );
    let turn = Matrix3::new(0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0);
    for source in directions() {
        let expected = turn * load(&straight, source).force_body_n;
        assert_relative_eq!(load(&turned, turn * source).force_body_n, expected, epsilon = 1e-14);
    }
    assert_eq!(straight.plates[0].name, "box 1.+X");
    assert_relative_eq!(turned.plates[0].center_m, Vector3::new(1.0, 2.5, 3.0), epsilon = 1e-15);
}

fn cylinder(facets: u32, optics: &str) -> Spacecraft {
    spacecraft(&format!(
        "[[cylinders]]\nname = 'tank'\ncenter_m = [0, 0, 0]\nradius_m = 0.7\nheight_m = 3\nfacets = {facets}\n\
         optics = '{optics}'\nend_optics = 'black'\n"
    ))
}

#[test]
fn a_cylinder_has_its_areas_and_its_broadside_on_average_exactly() {
    for facets in [3, 4, 7, 16, 128] {
        let plates = cylinder(facets, "black").plates;
        let (side, ends) = plates.split_at(plates.len() - 2);
        assert_eq!(side.len(), facets as usize);
        assert_relative_eq!(area_m2(side), 2.0 * PI * 0.7 * 3.0, max_relative = 1e-13);
        assert_relative_eq!(area_m2(ends), 2.0 * PI * 0.7 * 0.7, max_relative = 1e-13);
        assert_eq!((ends[0].normal, ends[1].normal), (Vector3::z(), -Vector3::z()));
        // The mean over all directions around the axis, between the corners of the function exactly.
        let steps = 4000 * facets;
        let toward = |k: u32| {
            let (sin, cos) = (2.0 * PI * (f64::from(k) + 0.5) / f64::from(steps)).sin_cos();
            Vector3::new(cos, sin, 0.0)
        };
        let mean = (0..steps).map(|k| shown_m2(side, &toward(k))).sum::<f64>() / f64::from(steps);
        assert_relative_eq!(mean, 2.0 * 0.7 * 3.0, max_relative = 1e-7);
        let x = PI / f64::from(facets);
        let allowed = 1.0 - x / x.tan();
        if facets >= 16 {
            let off = (0..1000).map(|k| (shown_m2(side, &toward(k * steps / 1000)) / 4.2 - 1.0).abs());
            let off = off.fold(0.0, f64::max);
            assert!(
                (0.99 * allowed..1.000_001 * allowed).contains(&off),
                "{facets}: {off}, stated {allowed}"
            );
        }
    }
}

#[test]
fn a_cylinder_feels_the_closed_form_within_its_stated_error_and_converges_squarely() {
    // Broadside, on 2 r h at 1 Pa: black 1, Lambert 1 + pi / 6, mirror 4 / 3.
    for (optics, factor) in [("black", 1.0), ("white", 1.0 + PI / 6.0), ("mirror", 4.0 / 3.0)] {
        let off = |facets: u32| {
            let force = load(&cylinder(facets, optics), -Vector3::y()).force_body_n;
            assert!(force.x.abs() < 1e-13 && force.z.abs() < 1e-13);
            (force.y / (4.2 * factor) - 1.0).abs()
        };
        for facets in [8, 16, 32, 64] {
            let x = PI / f64::from(facets);
            let allowed = (1.0 - x / x.tan()) * (1.0 + 1e-12);
            assert!(off(facets) <= allowed, "{optics}, {facets}: {} of {allowed}", off(facets));
        }
        // A mirror's law is smooth where its side turns dark: faster than the square.
        let gain = off(32) / off(64);
        assert!(if optics == "mirror" { gain > 3.9 } else { (3.9..4.1).contains(&gain) }, "{optics}: {gain}");
    }
}

#[test]
fn bodies_that_are_convex_shadow_nothing_of_themselves() {
    let both = "[[boxes]]\ncenter_m = [0, 0, 0]\nsize_m = [1, 2, 4]\noptics = 'grey'\n";
    for spacecraft in [spacecraft(both), cylinder(16, "grey")] {
        for source in directions() {
            let (with, without) =
                (shadowed_force_n(&spacecraft, source, true), shadowed_force_n(&spacecraft, source, false));
            assert!((with - without).norm() <= 1e-14 * without.norm(), "{with} {without}");
        }
    }
}

#[test]
fn a_disc_has_its_area_centre_and_normal_whatever_its_corners() {
    for corners in [3, 5, 24, 128] {
        let disc = spacecraft(&format!(
            "[[discs]]\nname = 'lid'\ncenter_m = [1, -2, 3]\nnormal = [0.6, 0, 0.8]\nradius_m = 2\n\
             corners = {corners}\noptics = 'grey'\n"
        ));
        let [plate] = &disc.plates[..] else { panic!("{}", disc.plates.len()) };
        assert_eq!(plate.name, "lid");
        assert_relative_eq!(plate.area_m2, 4.0 * PI, max_relative = 1e-14);
        assert_relative_eq!(plate.center_m, Vector3::new(1.0, -2.0, 3.0), epsilon = 1e-14);
        assert_relative_eq!(plate.normal, Vector3::new(0.6, 0.0, 0.8), epsilon = 1e-14);
    }
}

fn dish(depth_m: f64, facets: u32, rings: u32) -> Spacecraft {
    spacecraft(&format!(
        "[[dishes]]\nname = 'hga'\nvertex_m = [0, 0, 1]\naxis = [0, 0, 1]\nradius_m = 1.5\ndepth_m = {depth_m}\n\
         facets = {facets}\nrings = {rings}\noptics = 'black'\nrear_optics = 'white'\n"
    ))
}

#[test]
fn a_dish_has_the_area_of_the_paraboloid_and_of_its_rim_exactly() {
    for depth_m in [0.01, 0.4, 3.0] {
        // Pappus: 2 pi times the integral of r ds, by Simpson's rule.
        let steps = 2000;
        let part = |k: i32| {
            let r = 1.5 * f64::from(k) / f64::from(steps);
            r * (1.0 + (2.0 * depth_m * r / 2.25).powi(2)).sqrt()
        };
        let weight = |k: i32| {
            if k == 0 || k == steps {
                1.0
            } else if k % 2 == 1 {
                4.0
            } else {
                2.0
            }
        };
        let pappus =
            (0..=steps).map(|k| weight(k) * part(k)).sum::<f64>() * 1.5 / f64::from(steps) / 3.0 * 2.0 * PI;
        for (facets, rings) in [(3, 1), (12, 2), (31, 7)] {
            let plates = dish(depth_m, facets, rings).plates;
            assert_eq!(plates.len(), (facets * rings) as usize);
            assert_relative_eq!(area_m2(&plates), pappus, max_relative = 1e-10);
            assert_relative_eq!(shown_m2(&plates, &Vector3::z()), PI * 2.25, max_relative = 1e-12);
            assert!(plates.iter().all(|plate| plate.normal.z > 0.0));
        }
    }
    // Depth and rim are off as stated, and less the finer the facets.
    let off = |facets: u32, rings: u32| {
        let plates = dish(0.4, facets, rings).plates;
        let vertices = || plates.iter().flat_map(|plate| plate.polygon.as_ref().unwrap().vertices_m());
        let top = vertices().map(|v| v.z - 1.0).fold(0.0, f64::max);
        let rim = vertices().map(|v| v.x.hypot(v.y)).fold(0.0, f64::max);
        (top / 0.4 - 1.0, rim / 1.5 - 1.0)
    };
    for (rings, stated) in [(2, 0.15), (3, 0.076), (4, 0.048)] {
        let (depth, rim) = off(48, rings);
        assert!((0.9 * stated..stated).contains(&depth), "{rings}: {depth}");
        assert_relative_eq!(rim, (PI / 48.0).powi(2) / 3.0, max_relative = 0.01);
        assert!((0.0..stated).contains(&off(12, rings).0));
    }
    assert!(off(60, 30).0 < 0.1 * off(60, 4).0);
}

#[test]
fn a_dish_shadows_itself_and_shows_the_sun_what_a_dish_shows() {
    // Seen from behind along its axis, or into it: its rim, with no facet in another's shadow.
    let dish = dish(0.6, 16, 3);
    let pressure_pa = 1361.0 / 299_792_458.0;
    let into = shadowed_force_n(&dish, Vector3::z(), true);
    assert_relative_eq!(into.z, -PI * 2.25 * pressure_pa, max_relative = 1e-9);
    // Far from its axis the near side of the hollow's wall hides a part of the far one: less than the sum of facets.
    let aslant = Vector3::new(0.96, 0.0, 0.28);
    let (with, without) = (shadowed_force_n(&dish, aslant, true), shadowed_force_n(&dish, aslant, false));
    assert!(with.norm() < 0.95 * without.norm(), "{with} {without}");
}

const FIN: &str = "[[boxes]]\nname = 'fin'\ncenter_m = [2, 0.3, -0.4]\nsize_m = [1, 0.2, 0.7]\n\
    rotation_deg = [20, 30, 40]\noptics = 'grey'\nface_optics = {'+X' = 'white', '-Z' = 'mirror'}\n";

#[test]
fn mirrored_copies_turn_a_mirrored_sun_into_a_mirrored_torque() {
    let one = spacecraft(FIN);
    let alone: Vec<_> = directions().map(|source| load(&one, source)).collect();
    for axis in 0..3 {
        let name = ["x", "y", "z"][axis];
        let two = spacecraft(&format!("{FIN}mirror = ['{name}']\n"));
        assert_eq!((two.plates.len(), two.plates[0].name.as_str()), (12, "fin[1].+X"));
        assert_eq!(two.plates[6].name, "fin[2].+X");
        let mut mirror = Matrix3::identity();
        mirror[(axis, axis)] = -1.0;
        for (source, alone) in directions().zip(&alone) {
            let image = load(&one, mirror * source);
            let both = load(&two, source);
            // A torque is an axial vector: the mirror image has the opposite sign besides.
            assert_relative_eq!(
                both.force_body_n,
                alone.force_body_n + mirror * image.force_body_n,
                epsilon = 1e-14
            );
            let torque = alone.torque_body_n_m - mirror * image.torque_body_n_m;
            assert_relative_eq!(both.torque_body_n_m, torque, epsilon = 1e-14);
        }
    }
    // In two planes: no torque about either axis of symmetry from a Sun on it.
    let four = spacecraft(&format!("{FIN}mirror = ['x', 'z']\n"));
    assert_eq!(four.plates.len(), 24);
    let symmetric = load(&four, -Vector3::y());
    assert!(symmetric.torque_body_n_m.norm() < 1e-14 && symmetric.force_body_n.x.abs() < 1e-14);
}

#[test]
fn repeated_copies_are_symmetric_about_their_axis_and_shifted_along_their_row() {
    let around =
        spacecraft(&format!("{FIN}repeat = {{count = 3, axis = [0, 0, 1], point_m = [0.5, 0, 0]}}\n"));
    assert_eq!(around.plates.len(), 18);
    let third = nalgebra::Rotation3::from_axis_angle(&Vector3::z_axis(), 2.0 * PI / 3.0);
    for source in directions() {
        let (here, there) = (load(&around, source), load(&around, third * source));
        assert_relative_eq!(there.force_body_n, third * here.force_body_n, epsilon = 1e-13);
        let about_point = |load: &ForceTorque<f64>| {
            load.torque_body_n_m - Vector3::new(0.5, 0.0, 0.0).cross(&load.force_body_n)
        };
        assert_relative_eq!(about_point(&there), third * about_point(&here), epsilon = 1e-13);
    }
    let row = spacecraft(&format!("{FIN}repeat = {{count = 4, step_m = [0, 0, 1.5]}}\n"));
    let alone = spacecraft(FIN);
    for source in directions() {
        let (one, four) = (load(&alone, source), load(&row, source));
        assert_relative_eq!(four.force_body_n, 4.0 * one.force_body_n, epsilon = 1e-13);
        // The middle of the row is 1.5 (0 + 1 + 2 + 3) / 4 along.
        let shifted = 4.0 * (one.torque_body_n_m + Vector3::new(0.0, 0.0, 2.25).cross(&one.force_body_n));
        assert_relative_eq!(four.torque_body_n_m, shifted, epsilon = 1e-13);
    }
    // Right angles leave round numbers round.
    let plate = "[[plates]]\nname = 'vane'\narea_m2 = 2\ncenter_m = [3, 0, 0]\nnormal = [0, -1, 0]\noptics = 'grey'\n\
        repeat = {count = 4, axis = [0, 1, 0]}\n";
    let centers: Vec<_> = spacecraft(plate).plates.iter().map(|plate| plate.center_m).collect();
    let [x, z] = [Vector3::x() * 3.0, Vector3::z() * 3.0];
    assert_eq!(centers, [x, -z, -x, z]);
}

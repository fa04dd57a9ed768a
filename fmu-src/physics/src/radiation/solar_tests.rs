//! Sunlight on whole spacecraft obeys the symmetries of mechanics and agrees with bodies solved by hand.

use core::f64::consts::PI;

use approx::assert_relative_eq;
use nalgebra::{Matrix3, Rotation3, Vector3};
use proptest::prelude::*;

use super::flat_plate::force_per_area_pa;
use super::*;
use crate::loads::ForceTorque;
use crate::numerics::scalar::{Dual64, Scalar, constant_vector};
use crate::spacecraft::{MESSENGER_TOML, Optics, Plate, Spacecraft, SunshadeModel};

fn messenger() -> Spacecraft {
    Spacecraft::from_toml("messenger.toml", MESSENGER_TOML).unwrap()
}

/// MESSENGER with everything the format offers in use: backs, a bus plate, misaligned and unequal parts.
fn crooked() -> Spacecraft {
    let mut spacecraft = messenger();
    let white = Optics::from_reflectivities(0.1, 0.7);
    spacecraft.plates.push(Plate::insulated(
        "bus".to_owned(),
        1.7,
        Vector3::new(0.1, 0.6, -0.2),
        Vector3::new(0.48, 0.6, -0.64),
        (white, Some(Optics::from_reflectivities(0.4, 0.1))),
    ));
    let shade = spacecraft.sunshade.as_mut().unwrap();
    shade.dcm_body_from_shade = Rotation3::from_euler_angles(0.02, -0.05, 0.1).into_inner();
    shade.plates[3].faces.optics = white;
    spacecraft.panels[1].faces.rear_optics = Some(white);
    spacecraft.panels[1].axis_body = Vector3::new(0.8, 0.0, 0.6);
    spacecraft
}

fn rotate(spacecraft: &Spacecraft, rotation: &Matrix3<f64>) -> Spacecraft {
    let mut turned = spacecraft.clone();
    turned.plates = spacecraft.plates.iter().map(|plate| plate.rotated(rotation)).collect();
    if let Some(shade) = &mut turned.sunshade {
        shade.dcm_body_from_shade = rotation * shade.dcm_body_from_shade;
    }
    for panel in &mut turned.panels {
        panel.center_body_m = rotation * panel.center_body_m;
        panel.axis_body = rotation * panel.axis_body;
        panel.zero_normal_body = rotation * panel.zero_normal_body;
    }
    turned
}

fn direction(azimuth: f64, z: f64) -> Vector3<f64> {
    let rho = (1.0 - z * z).sqrt();
    Vector3::new(rho * azimuth.cos(), rho * azimuth.sin(), z)
}

fn beam(source_body: Vector3<f64>) -> Beam<f64> {
    Beam { source_body, pressure_pa: 1.0 }
}

fn models(spacecraft: &Spacecraft) -> [SolarModel; 2] {
    [SunshadeModel::Plates, SunshadeModel::Cylinder]
        .map(|model| SolarModel::new(spacecraft, Some(model)).unwrap())
}

/// With both panels at these angles.
fn load<T: Scalar>(
    model: &SolarModel,
    beam: &Beam<T>,
    angles_rad: [T; 2],
    center_of_mass_body_m: &Vector3<T>,
) -> ForceTorque<T> {
    model.load(beam, |k, panel| Some(panel.normal_body(angles_rad[k])), center_of_mass_body_m)
}

fn assert_close(found: &ForceTorque<f64>, expected: &ForceTorque<f64>, tolerance: f64) {
    assert_relative_eq!(found.force_body_n, expected.force_body_n, epsilon = tolerance);
    assert_relative_eq!(found.torque_body_n_m, expected.torque_body_n_m, epsilon = tolerance);
}

/// The law applied face by face, as thin two-sided plates.
fn face_by_face(plates: &[Plate], beam: &Beam<f64>) -> ForceTorque<f64> {
    plates
        .iter()
        .flat_map(|plate| {
            [(plate.normal, Some(plate.faces.optics)), (-plate.normal, plate.faces.rear_optics)].map(
                |(normal, optics)| {
                    let light = beam.received(&normal);
                    optics.map_or_else(ForceTorque::zero, |optics| {
                        ForceTorque::at_arm(
                            &plate.center_m,
                            force_per_area_pa(&optics, &normal, &light) * plate.area_m2,
                        )
                    })
                },
            )
        })
        .sum()
}

/// A closed black box hides exactly its shadow from the Sun, whatever the direction.
#[test]
fn a_black_box_is_pushed_by_the_light_its_shadow_lacks() {
    let mut spacecraft = messenger();
    (spacecraft.sunshade, spacecraft.panels) = (None, Vec::new());
    let sizes = Vector3::new(1.0, 2.0, 3.0);
    spacecraft.plates = (0..6)
        .map(|i| {
            let axis = i / 2;
            let normal = Vector3::ith(axis, if i % 2 == 0 { 1.0 } else { -1.0 });
            let (area_m2, center_m) = (sizes.product() / sizes[axis], normal * (sizes[axis] / 2.0));
            let black = Optics::from_reflectivities(0.0, 0.0);
            Plate::insulated(format!("side {i}"), area_m2, center_m, normal, (black, None))
        })
        .collect();
    let model = SolarModel::new(&spacecraft, None).unwrap();
    for sun in [direction(0.3, 0.2), direction(-2.0, -0.9), direction(1.6, 0.0)] {
        let shadow = sun.x.abs() * 6.0 + sun.y.abs() * 3.0 + sun.z.abs() * 2.0;
        let found = model.load(&beam(sun), |_, _| None, &Vector3::zeros());
        assert_relative_eq!(found.force_body_n, -sun * shadow, epsilon = 1e-14);
        // By symmetry about its middle a uniform box feels no torque there.
        assert_relative_eq!(found.torque_body_n_m, Vector3::zeros(), epsilon = 1e-14);
    }
}

#[test]
fn a_panel_facing_the_sun_is_a_plate() {
    let spacecraft = Spacecraft { sunshade: None, ..messenger() };
    let model = SolarModel::new(&spacecraft, None).unwrap();
    let center_of_mass = Vector3::new(0.1, 0.2, -0.3);
    let at = |panel: usize, angle_rad: f64| {
        model.load(
            &beam(-Vector3::y()),
            |k, it| (k == panel).then(|| it.normal_body(angle_rad)),
            &center_of_mass,
        )
    };
    let found = at(0, 0.0);
    // P A (1 + C_s + 2/3 C_d) along +Y, 2.18 m outboard and 0.3 m above.
    let force = 2.5 * (1.0 + 0.52 + 2.0 / 3.0 * 0.07);
    assert_relative_eq!(found.force_body_n, Vector3::y() * force, epsilon = 1e-14);
    assert_relative_eq!(
        found.torque_body_n_m,
        Vector3::new(-0.3 * force, 0.0, 2.18 * force),
        epsilon = 1e-14
    );
    // Its back is declared to receive no light.
    assert_eq!(at(0, PI), ForceTorque::zero());
    assert_eq!(at(2, 0.0), ForceTorque::zero());
}

#[test]
fn torque_goes_to_nothing_as_a_plate_goes_dark() {
    let model = SolarModel::new(&crooked(), None).unwrap();
    // The side plates go dark at azimuth +-45 deg, the front at +-90.
    for edge_deg in [-90.0, -47.0, 45.0, 90.0, 135.0_f64] {
        let at = |angle: f64| {
            load(&model, &beam(Vector3::new(angle.sin(), -angle.cos(), 0.0)), [0.2, 0.4], &Vector3::zeros())
        };
        let step = 1e-9;
        let (before, after) = (at(edge_deg.to_radians() - step), at(edge_deg.to_radians() + step));
        assert_close(&before, &after, 1e-7);
    }
}

#[test]
fn a_sunshade_in_a_form_the_file_does_not_give_is_refused() {
    let mut spacecraft = messenger();
    spacecraft.sunshade.as_mut().unwrap().cylinder = None;
    let error = SolarModel::new(&spacecraft, Some(SunshadeModel::Cylinder)).unwrap_err();
    assert!(error.to_string().contains("Cylinder"));
    spacecraft.sunshade = None;
    assert!(SolarModel::new(&spacecraft, Some(SunshadeModel::Cylinder)).is_ok());
}

/// Derivatives with respect to Sun direction, panel angle and centre of mass at once.
fn along_seed<T: Scalar>(model: &SolarModel, sun: &Vector3<f64>, seed: T) -> ForceTorque<T> {
    let turned = constant_vector::<T>(sun) + Vector3::new(seed * 0.3, seed * -0.2, seed * 0.1);
    let beam = Beam { source_body: turned / turned.norm(), pressure_pa: seed * 0.5 + 1.0 };
    let center_of_mass = Vector3::new(seed * 0.1, T::constant(0.2), seed * -0.7);
    load(model, &beam, [seed + 0.3, seed * -2.0 + 0.1], &center_of_mass)
}

proptest! {
    #[test]
    fn multiplied_out_sum_equals_the_law_face_by_face(a in -PI..PI, z in -1.0..1.0_f64) {
        let spacecraft = crooked();
        let beam = beam(direction(a, z));
        let expected = face_by_face(&spacecraft.plates_body(SunshadeModel::Plates), &beam);
        let [model, _] = models(&spacecraft);
        let origin = Vector3::zeros();
        assert_close(&model.load(&beam, |_, _| None, &origin), &expected, 1e-14);
    }

    #[test]
    fn a_mirrored_sun_mirrors_the_force(a in -PI..PI, z in -1.0..1.0_f64) {
        for model in models(&messenger()) {
            let sun = direction(a, z);
            let on_shade = |sun| model.load(&beam(sun), |_, _| None, &Vector3::zeros());
            let (shade, mirrored) = (on_shade(sun), on_shade(Vector3::new(-sun.x, sun.y, sun.z)));
            let (f, t) = (shade.force_body_n, shade.torque_body_n_m);
            let expected = ForceTorque {
                force_body_n: Vector3::new(-f.x, f.y, f.z),
                torque_body_n_m: Vector3::new(t.x, -t.y, -t.z),
            };
            assert_close(&mirrored, &expected, 1e-14);
        }
    }

    #[test]
    fn turning_everything_turns_the_result(
        a in -PI..PI, z in -1.0..1.0_f64, turn in prop::array::uniform3(-3.0..3.0_f64),
    ) {
        let spacecraft = crooked();
        let rotation = Rotation3::from_euler_angles(turn[0], turn[1], turn[2]).into_inner();
        let center_of_mass = Vector3::new(0.3, -0.1, 0.2);
        for (model, turned) in models(&spacecraft).iter().zip(&models(&rotate(&spacecraft, &rotation))) {
            let still = load(model, &beam(direction(a, z)), [0.3, -1.0], &center_of_mass);
            let moved = load(turned, &beam(rotation * direction(a, z)), [0.3, -1.0], &(rotation * center_of_mass));
            let expected = ForceTorque {
                force_body_n: rotation * still.force_body_n,
                torque_body_n_m: rotation * still.torque_body_n_m,
            };
            assert_close(&moved, &expected, 1e-12);
        }
    }

    #[test]
    fn moving_the_center_of_mass_shifts_the_torque_by_its_arm(
        a in -PI..PI, z in -1.0..1.0_f64, c in prop::array::uniform3(-1.0..1.0_f64),
    ) {
        for model in models(&crooked()) {
            let beam = beam(direction(a, z));
            let center_of_mass = Vector3::from(c);
            let at_origin = load(&model, &beam, [0.3, -1.0], &Vector3::zeros());
            let moved = load(&model, &beam, [0.3, -1.0], &center_of_mass);
            let expected = at_origin.torque_body_n_m - center_of_mass.cross(&at_origin.force_body_n);
            prop_assert!((moved.torque_body_n_m - expected).norm() < 1e-13);
            prop_assert_eq!(moved.force_body_n, at_origin.force_body_n);
        }
    }

    #[test]
    fn derivatives_are_slopes(a in -PI..PI, z in -0.95..0.95_f64) {
        for model in models(&crooked()) {
            let sun = direction(a, z);
            let h = 1e-6;
            let (low, high) = (along_seed(&model, &sun, -h), along_seed(&model, &sun, h));
            // Away from edges: a face that goes dark within the step has a slope on each side.
            let mid = along_seed(&model, &sun, 0.0);
            let curvature = (high.force_body_n + low.force_body_n - mid.force_body_n * 2.0).norm();
            prop_assume!(curvature < 1e-9);
            let exact = along_seed(&model, &sun, Dual64::new(0.0, 1.0));
            let slope = (high.torque_body_n_m - low.torque_body_n_m) / (2.0 * h);
            prop_assert!((slope - exact.torque_body_n_m.map(|x| x.eps)).norm() < 1e-6);
            let slope = (high.force_body_n - low.force_body_n) / (2.0 * h);
            prop_assert!((slope - exact.force_body_n.map(|x| x.eps)).norm() < 1e-6);
        }
    }
}

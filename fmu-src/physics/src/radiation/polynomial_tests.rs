//! The 27 coefficients give the direct sum's torque while all is lit, and the published values.

use approx::assert_relative_eq;
use nalgebra::{Rotation3, Vector3};
use proptest::prelude::*;

use super::polynomial::{TorquePolynomial, polynomial_valid};
use super::{Beam, SolarModel};
use crate::spacecraft::{Cylinder, MESSENGER_TOML, Optics, Spacecraft, Sunshade, SunshadeModel};

const MODELS: [SunshadeModel; 2] = [SunshadeModel::Plates, SunshadeModel::Cylinder];

fn messenger() -> Spacecraft {
    Spacecraft::from_toml("messenger.toml", MESSENGER_TOML).unwrap()
}

fn shade(spacecraft: &Spacecraft) -> &Sunshade {
    spacecraft.sunshade.as_ref().unwrap()
}

fn sun(azimuth: f64, elevation: f64) -> Vector3<f64> {
    Vector3::new(elevation.cos() * azimuth.sin(), -elevation.cos() * azimuth.cos(), -elevation.sin())
}

fn of_table_1(center_of_mass_m: [f64; 3]) -> (Cylinder, TorquePolynomial) {
    let cylinder = shade(&messenger()).cylinder.unwrap();
    (cylinder, TorquePolynomial::of_cylinder(&cylinder, &[], &Vector3::from(center_of_mass_m)))
}

/// Values worked out from Table 1 for r_c = 0.
#[test]
fn key_coefficients_of_the_cylinder() {
    let (_, polynomial) = of_table_1([0.0; 3]);
    for (axis, term, expected) in [(0, "yz", -3.0930789), (1, "xz", 1.3310557), (2, "xy", 1.7620232)] {
        assert_relative_eq!(polynomial.coefficient(axis, term).unwrap(), expected, epsilon = 5e-8);
    }
    let others = polynomial.k.iter().flatten().filter(|k| k.abs() > 1e-13).count();
    assert_eq!(others, 3, "all other coefficients vanish by symmetry");
    assert_eq!(polynomial.coefficient(0, "w"), None);
    assert_eq!(polynomial.coefficient(3, "x"), None);
}

/// Paper 000, eqs 4-5 as printed where the print is right, k_x_y with z_c C_d theta_p and k_x_yy with 2/3.
#[test]
fn printed_coefficients_of_the_cylinder() {
    let center_of_mass_m = [0.03, -0.05, 0.07];
    let [x_c, y_c, z_c] = center_of_mass_m;
    let (cylinder, polynomial) = of_table_1(center_of_mass_m);
    let (theta, radius, h0) = (cylinder.half_angle_rad, cylinder.radius_m, cylinder.height_m / 2.0);
    let (c_s, c_d) = (0.15, 0.35);
    let theta_p = theta + (2.0 * theta).sin() / 2.0;
    let (theta_s, theta_3) = (theta.sin(), theta.sin().powi(3));
    let square = 2.0 * ((1.0 + c_s) * theta_s - 2.0 / 3.0 * c_s * theta_3);
    for (axis, term, expected) in [
        (0, "y", -2.0 / 3.0 * z_c * c_d * theta_p),
        (0, "yz", -(1.0 - c_s) * (radius * theta_p + 2.0 * y_c * theta_s)),
        (0, "xx", 4.0 / 3.0 * z_c * c_s * theta_3),
        (0, "yy", z_c * square),
        (2, "yy", -x_c * square),
        (1, "yz", 2.0 * x_c * (1.0 - c_s) * theta_s),
    ] {
        let found = polynomial.coefficient(axis, term).unwrap();
        assert_relative_eq!(found, 2.0 * radius * h0 * expected, epsilon = 1e-14);
    }
}

#[test]
fn validity_ends_where_the_first_part_goes_dark() {
    let spacecraft = messenger();
    let valid = |model, azimuth_deg: f64| {
        polynomial_valid(shade(&spacecraft), model, &sun(azimuth_deg.to_radians(), 0.2))
    };
    // Side plates face 45 deg off, the cylinder reaches 61 deg round.
    assert!(valid(SunshadeModel::Plates, 44.9) && !valid(SunshadeModel::Plates, 45.1));
    assert!(valid(SunshadeModel::Cylinder, -28.9) && !valid(SunshadeModel::Cylinder, -29.1));
    assert!(!valid(SunshadeModel::Plates, 180.0) && !valid(SunshadeModel::Cylinder, 180.0));
}

#[test]
fn a_form_the_file_does_not_give_is_refused() {
    let mut shade = shade(&messenger()).clone();
    shade.cylinder = None;
    assert!(TorquePolynomial::of_sunshade(&shade, SunshadeModel::Cylinder, &[], &Vector3::zeros()).is_err());
    assert!(!polynomial_valid(&shade, SunshadeModel::Cylinder, &-Vector3::y()));
}

proptest! {
    #[test]
    fn polynomial_equals_direct_sum_while_all_is_lit(
        azimuth in -3.1..3.1_f64,
        elevation in -1.5..1.5_f64,
        c in prop::array::uniform3(-1.0..1.0_f64),
        turn in prop::array::uniform3(-0.2..0.2_f64),
        specular in prop::array::uniform8(0.0..0.5_f64),
        diffuse in prop::array::uniform8(0.0..0.5_f64),
    ) {
        let mut spacecraft = messenger();
        let shade = spacecraft.sunshade.as_mut().unwrap();
        shade.dcm_body_from_shade = Rotation3::from_euler_angles(turn[0], turn[1], turn[2]).into_inner();
        for ((plate, s), d) in shade.plates.iter_mut().zip(specular).zip(diffuse) {
            plate.faces.optics = Optics::from_reflectivities(s, d);
        }
        shade.cylinder.as_mut().unwrap().optics = Optics::from_reflectivities(specular[0], diffuse[0]);
        let shade = &shade.clone();
        let center_of_mass = Vector3::from(c);
        let sun_body = sun(azimuth, elevation);
        for model in MODELS {
            let polynomial = TorquePolynomial::of_sunshade(shade, model, &[], &center_of_mass).unwrap();
            let beam = |source_body| Beam { source_body, pressure_pa: 0.7 };
            let direct = SolarModel::new(&spacecraft, Some(model))
                .unwrap()
                .load(&beam(sun_body), |_, _| None, &center_of_mass)
                .torque_body_n_m;
            let in_shade = polynomial.torque_n_m(&beam(shade.dcm_body_from_shade.transpose() * sun_body));
            let miss = (shade.dcm_body_from_shade * in_shade - direct).norm();
            if polynomial_valid(shade, model, &sun_body) {
                prop_assert!(miss < 1e-12, "{model:?}: {miss}");
            }
        }
    }
}

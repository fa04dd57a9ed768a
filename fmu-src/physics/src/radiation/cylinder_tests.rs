//! The closed form for the cylinder equals thousands of flat facets, and round bodies known by heart.

use core::f64::consts::PI;

use approx::assert_relative_eq;
use nalgebra::Vector3;
use proptest::prelude::*;

use super::Beam;
use super::cylinder::{cylinder_force_torque, lit_angle_rad};
use super::flat_plate::force_per_area_pa;
use crate::loads::ForceTorque;
use crate::spacecraft::{Cylinder, FaceThermal, GasSurface, Optics};

fn cylinder(half_angle_rad: f64, optics: Optics) -> Cylinder {
    Cylinder {
        radius_m: 0.991,
        height_m: 2.489,
        half_angle_rad,
        optics,
        gas_surface: GasSurface::ASSUMED,
        thermal: FaceThermal::like_sunlight(&optics),
        material: None,
    }
}

fn shade() -> Cylinder {
    cylinder(61_f64.to_radians(), Optics::from_reflectivities(0.15, 0.35))
}

fn beam(source_body: Vector3<f64>) -> Beam<f64> {
    Beam { source_body, pressure_pa: 1.0 }
}

/// Strips of constant angle, each taken at its middle: exact but for a facet's own width squared.
fn faceted(cylinder: &Cylinder, beam: &Beam<f64>, facets: u32) -> ForceTorque<f64> {
    let width = 2.0 * cylinder.half_angle_rad / f64::from(facets);
    (0..facets)
        .map(|i| {
            let angle = (f64::from(i) + 0.5) * width - cylinder.half_angle_rad;
            let normal = Vector3::new(angle.sin(), -angle.cos(), 0.0);
            let area_m2 = cylinder.radius_m * width * cylinder.height_m;
            let force_n = force_per_area_pa(&cylinder.optics, &normal, &beam.received(&normal)) * area_m2;
            ForceTorque::at_arm(&(normal * cylinder.radius_m), force_n)
        })
        .sum()
}

/// A whole cylinder under light square to its axis: drag by shadow area 2 R H is 1 black, 4/3 as a mirror, 1 + pi/6 white.
#[test]
fn a_whole_cylinder_has_the_textbook_drag() {
    let shadow_m2 = 2.0 * 0.991 * 2.489;
    for (specular, diffuse, drag) in [(0.0, 0.0, 1.0), (1.0, 0.0, 4.0 / 3.0), (0.0, 1.0, 1.0 + PI / 6.0)] {
        let cylinder = cylinder(PI, Optics::from_reflectivities(specular, diffuse));
        for azimuth in [-3.0_f64, -1.7, 0.0, 0.4, PI / 2.0, PI] {
            let sun = Vector3::new(azimuth.sin(), -azimuth.cos(), 0.0);
            let found = cylinder_force_torque(&cylinder, &cylinder.optics, &beam(sun));
            assert_relative_eq!(found.force_body_n, -sun * drag * shadow_m2, epsilon = 1e-13);
            assert_relative_eq!(found.torque_body_n_m, Vector3::zeros(), epsilon = 1e-13);
        }
    }
}

#[test]
fn a_sun_on_the_axis_or_behind_does_nothing() {
    assert_eq!(cylinder_force_torque(&shade(), &shade().optics, &beam(Vector3::z())), ForceTorque::zero());
    assert_eq!(cylinder_force_torque(&shade(), &shade().optics, &beam(Vector3::y())), ForceTorque::zero());
    assert_eq!(lit_angle_rad(&shade(), &Vector3::y()), 0.0);
}

#[test]
fn the_shade_is_lit_whole_up_to_29_deg_of_azimuth_and_not_at_all_from_151() {
    let whole = 2.0 * shade().half_angle_rad;
    let at = |deg: f64| {
        lit_angle_rad(&shade(), &Vector3::new(deg.to_radians().sin(), -deg.to_radians().cos(), 0.3))
    };
    assert_eq!([at(0.0), at(28.9), at(-28.9)], [whole; 3]);
    assert!([at(29.1), at(-29.1), at(150.9)].iter().all(|part| *part > 0.0 && *part < whole));
    assert_eq!([at(151.1), at(180.0), at(-151.1)], [0.0; 3]);
}

#[test]
fn facets_agree_to_1e_minus_7_inside_the_keep_in_zone() {
    for (azimuth_deg, elevation_deg) in [(0.0, 0.0), (15.0, 13.0), (-15.0, 13.0), (7.0, -13.0_f64)] {
        let (a, e) = (f64::to_radians(azimuth_deg), elevation_deg.to_radians());
        let beam = beam(Vector3::new(e.cos() * a.sin(), -e.cos() * a.cos(), -e.sin()));
        let (closed, facets) =
            (cylinder_force_torque(&shade(), &shade().optics, &beam), faceted(&shade(), &beam, 4000));
        assert_relative_eq!(closed.force_body_n, facets.force_body_n, epsilon = 1e-7);
        assert_relative_eq!(closed.torque_body_n_m, facets.torque_body_n_m, epsilon = 1e-7);
    }
}

proptest! {
    #[test]
    fn facets_agree_for_every_sun_and_every_section(
        azimuth in -PI..PI, z in -1.0..1.0_f64, half_angle in 0.05..PI, s in 0.0..1.0_f64, share in 0.0..1.0_f64,
    ) {
        let cylinder = cylinder(half_angle, Optics::from_reflectivities(s, (1.0 - s) * share));
        let rho = (1.0 - z * z).sqrt();
        let beam = beam(Vector3::new(rho * azimuth.sin(), -rho * azimuth.cos(), z));
        let (closed, facets) = (cylinder_force_torque(&cylinder, &cylinder.optics, &beam), faceted(&cylinder, &beam, 4000));
        // The facet at the shadow's edge is lit or dark as a whole: an error of its width squared.
        prop_assert!((closed.force_body_n - facets.force_body_n).norm() < 1e-5);
        prop_assert!((closed.torque_body_n_m - facets.torque_body_n_m).norm() < 1e-5);
    }
}

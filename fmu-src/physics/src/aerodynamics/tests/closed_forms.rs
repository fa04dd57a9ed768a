//! Force agrees with closed forms of a plate, a sphere and a cylinder.

use core::f64::consts::PI;

use approx::assert_relative_eq;

use super::*;
use crate::constants::GAS_CONSTANT_J_MOL_K;
use crate::math;
use crate::numerics::quadrature::Rule;
use crate::spacecraft::{FaceProperties, Optics, Plate};

#[test]
fn drag_is_dynamic_pressure_times_area_and_coefficient() {
    let model = model(&spacecraft(PLATE), LAWS[0]);
    let found = load(&model, &thin_air(Vector3::new(7670.0, 0.0, 0.0)), &[]);
    assert!((found.force_body_n - Vector3::new(-6.471179e-3, 0.0, 0.0)).norm() < 1e-12);
    assert!((found.torque_body_n_m - Vector3::new(0.0, -6.471179e-3, 0.0)).norm() < 1e-12);
    let behind = load(&model, &thin_air(Vector3::new(-7670.0, 0.0, 0.0)), &[]);
    assert_eq!(behind.force_body_n, Vector3::zeros());
}

/// Where the flow comes from.
const UPSTREAM: Vector3<f64> = Vector3::new(0.36, -0.48, 0.8);

/// Plates whose sum is an integral over the sphere: Gauss-Legendre latitudes about the flow on either half, even longitudes.
fn sphere(radius_m: f64, center_m: Vector3<f64>) -> Vec<Plate> {
    const LONGITUDES: u32 = 12;
    let east = Vector3::new(0.8, 0.6, 0.0);
    let north = UPSTREAM.cross(&east);
    let rule = Rule::<40>::gauss_legendre();
    let latitudes = rule.on(-1.0, 0.0).chain(rule.on(0.0, 1.0));
    let plates = latitudes.flat_map(|(sin_latitude, weight)| {
        let cos_latitude = (1.0 - sin_latitude * sin_latitude).sqrt();
        (0..LONGITUDES).map(move |k| {
            let (sin, cos) = (2.0 * PI * f64::from(k) / f64::from(LONGITUDES)).sin_cos();
            let normal = (east * cos + north * sin) * cos_latitude + UPSTREAM * sin_latitude;
            let area_m2 = weight * 2.0 * PI / f64::from(LONGITUDES) * radius_m * radius_m;
            let optics = Optics::from_reflectivities(0.0, 0.0);
            let center_m = center_m + normal * radius_m;
            let plate = Plate::insulated("part".to_owned(), area_m2, center_m, normal, (optics, None));
            Plate { faces: FaceProperties { gas_surface: [SURFACE; 2], ..plate.faces }, ..plate }
        })
    });
    plates.collect()
}

/// Drag of a sphere: Schaaf and Chambre 1961, table 1; with full accommodation and the wall at the temperature of re-emission it is
/// Sentman's.
fn sphere_coefficient(s: f64, [normal, tangential]: [f64; 2], sent_over_gas: f64) -> f64 {
    let erf = 1.0 - math::erfc(s);
    let incident = (2.0 * s * s + 1.0) / (PI.sqrt() * s.powi(3)) * (-s * s).exp()
        + (4.0 * s.powi(4) + 4.0 * s * s - 1.0) / (2.0 * s.powi(4)) * erf;
    (2.0 - normal + tangential) / 2.0 * incident + 2.0 * normal * PI.sqrt() / (3.0 * s) * sent_over_gas.sqrt()
}

#[test]
fn the_drag_of_a_sphere_is_its_closed_form() {
    let mut spacecraft = spacecraft(PLATE);
    let (radius_m, center_m) = (0.7, Vector3::new(0.3, -0.2, 1.1));
    spacecraft.plates = sphere(radius_m, center_m);
    for speed_m_s in [800.0, 3000.0, 7670.0] {
        let flow = thin_air(UPSTREAM * speed_m_s);
        let gas_m2_s2 = 2.0 * GAS_CONSTANT_J_MOL_K * flow.temperature_k / flow.molar_mass_kg_mol;
        let s = speed_m_s / gas_m2_s2.sqrt();
        let alpha = SURFACE.energy_accommodation;
        let sent = |divisor: f64| {
            let incident_k =
                flow.molar_mass_kg_mol * speed_m_s * speed_m_s / (divisor * GAS_CONSTANT_J_MOL_K);
            ((1.0 - alpha) * incident_k + alpha * SURFACE.wall_temperature_k) / flow.temperature_k
        };
        let wall = SURFACE.wall_temperature_k / flow.temperature_k;
        let accommodation = [SURFACE.normal_accommodation, SURFACE.tangential_accommodation];
        let expected = [
            // Half the sphere is met; the projected area counts.
            SURFACE.drag_coefficient,
            sphere_coefficient(s, [1.0, 1.0], sent(4.0)),
            sphere_coefficient(s, [1.0, 1.0], sent(3.0)),
            sphere_coefficient(s, accommodation, wall),
        ];
        for (law, coefficient) in LAWS.into_iter().zip(expected) {
            let found = load(&model(&spacecraft, law), &flow, &[]);
            let drag = -flow.velocity_body_m_s
                * (0.5 * flow.density_kg_m3 * speed_m_s * coefficient * PI * radius_m * radius_m);
            assert_relative_eq!(found.force_body_n, drag, epsilon = 1e-9 * drag.norm());
            let torque = center_m.cross(&drag);
            assert_relative_eq!(found.torque_body_n_m, torque, epsilon = 1e-9 * drag.norm());
        }
    }
}

/// Largest difference, over that force, from the force on the side of a cylinder of radius 1 and height 2 in 2400 strips, over all
/// laws and some directions of the flow; of what `text` adds to the plate.
fn off_a_cylinder(text: &str, half_angle_rad: f64) -> f64 {
    const STRIPS: u32 = 2400;
    let strip = |k: u32| {
        let angle_rad = half_angle_rad * (2.0 * (f64::from(k) + 0.5) / f64::from(STRIPS) - 1.0);
        let normal = Vector3::new(angle_rad.sin(), -angle_rad.cos(), 0.0);
        let area_m2 = 4.0 * half_angle_rad / f64::from(STRIPS);
        let optics = Optics::from_reflectivities(0.0, 0.0);
        Plate::insulated("strip".to_owned(), area_m2, normal, normal, (optics, None))
    };
    let (with, without) = (spacecraft(&format!("{PLATE}{text}")), spacecraft(PLATE));
    let strips = Spacecraft { plates: (0..STRIPS).map(strip).collect(), ..without.clone() };
    let mut largest: f64 = 0.0;
    for law in LAWS {
        let models = [&with, &without, &strips].map(|spacecraft| model(spacecraft, law));
        for degrees in [0.0, 5.0, 20.0, 33.75, 55.0, 90.0] {
            let angle = f64::to_radians(degrees);
            let flow = thin_air(Vector3::new(angle.sin(), -angle.cos(), 0.3) * 7500.0);
            let [with, without, expected] =
                models.each_ref().map(|model| load(model, &flow, &[]).force_body_n);
            largest = largest.max((with - without - expected).norm() / expected.norm());
        }
    }
    largest
}

#[test]
fn strips_of_a_cylindrical_shade_are_within_a_thousandth_of_it() {
    let shade = "[sunshade]\nmodel = \"cylinder\"\n[sunshade.cylinder]\nradius_m = 1.0\nheight_m = 2.0\n\
                 subtended_angle_deg = 180\noptics = \"black\"\n";
    let found = off_a_cylinder(shade, PI / 2.0);
    assert!((5e-4..1e-3).contains(&found), "{found}");
}

#[test]
fn sixteen_facets_are_within_15_thousandths_of_a_cylinder() {
    let cylinder = "[[cylinders]]\ncenter_m = [0, 0, 0]\nradius_m = 1.0\nheight_m = 2.0\noptics = \"black\"\n\
                    open_ends = [\"+axis\", \"-axis\"]\n";
    let found = off_a_cylinder(cylinder, PI);
    assert!((1e-2..1.5e-2).contains(&found), "{found}");
}

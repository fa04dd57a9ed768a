//! Figures of bodies known by heart, and warnings where something was slipped in, and only there.

use core::f64::consts::PI;

use approx::assert_relative_eq;
use nalgebra::{Rotation3, Vector3};
use proptest::prelude::*;

use super::*;
use crate::constants::SPEED_OF_LIGHT_M_S;
use crate::environment::sun::SOLAR_FLUX_W_M2;
use crate::momentum::WheelArray;
use crate::spacecraft::Spacecraft;

/// A solid box of 1 m by 2 m by 3 m and 600 kg, black but for a mirror on the Sun's side, with a pyramid of wheels.
const SOLID: &str = include_str!("solid.toml");

fn spacecraft(text: &str) -> Spacecraft {
    Spacecraft::from_toml("solid.toml", text).unwrap()
}

fn judged(text: &str) -> Vec<String> {
    let spacecraft = spacecraft(text);
    warnings(&spacecraft, &Figures::of(&spacecraft))
}

#[test]
fn a_solid_box_has_the_figures_of_the_textbook() {
    let figures = Figures::of(&spacecraft(SOLID));
    assert_eq!(figures.least_body_m, Vector3::new(-0.5, -1.0, -1.5));
    assert_eq!(figures.greatest_body_m, Vector3::new(0.5, 1.0, 1.5));
    let sides = Vector3::new(6.0, 3.0, 2.0);
    assert_eq!((figures.area_toward_plus_m2, figures.area_toward_minus_m2), (sides, sides));
    assert_eq!(figures.total_area_m2, 22.0);
    assert_relative_eq!(figures.sunlit_area_m2, 3.0, max_relative = 1e-14);
    // m (b2 + c2) / 12 about each axis; a / sqrt(12) along it.
    let squared = Vector3::new(13.0, 10.0, 5.0) / 12.0;
    assert_relative_eq!(figures.gyration_radii_m, squared.map(f64::sqrt), max_relative = 1e-14);
    assert_relative_eq!(
        figures.mass_spread_m,
        Vector3::new(1.0, 2.0, 3.0) / 12.0_f64.sqrt(),
        max_relative = 1e-14
    );
    assert_eq!(figures.center_of_mass_outside_m, None);
    assert_eq!(figures.wheels_hold_n_m_s, None);
    // Twice the pressure along +Y on 3 m2, at the arm of the -Y face's centre from the centre of mass.
    let force_n = Vector3::y() * (2.0 * 3.0 * SOLAR_FLUX_W_M2 / SPEED_OF_LIGHT_M_S);
    let arm_m = Vector3::new(-0.1, -1.2, -0.3);
    assert_relative_eq!(
        figures.solar_torque_body_n_m.unwrap(),
        arm_m.cross(&force_n),
        epsilon = 1e-20,
        max_relative = 1e-12
    );
    assert_eq!(judged(SOLID), [""; 0]);
}

#[test]
fn panels_count_where_they_turn_and_both_sides_where_light_reaches_both() {
    // A panel of 2 m by 2 m on +X whose cells are 60 deg off the Sun, and whose mass moves nothing.
    let text = format!(
        "{SOLID}[[panels]]\narea_m2 = 4\ncenter_m = [3, 0, 0]\noptics = \"black\"\nrear_optics = \"black\"\n\
         sun_offset_deg = 60\n"
    );
    let figures = Figures::of(&spacecraft(&text));
    assert_relative_eq!(figures.sunlit_area_m2, 3.0 + 4.0 * 0.5, max_relative = 1e-12);
    assert_relative_eq!(figures.area_toward_plus_m2.y, 3.0 + 2.0, max_relative = 1e-12);
    assert_relative_eq!(figures.area_toward_minus_m2.z, 2.0 + 4.0 * 0.75_f64.sqrt(), max_relative = 1e-12);
    assert_relative_eq!(figures.greatest_body_m.x, 4.0, max_relative = 1e-12);
    assert_relative_eq!(figures.total_area_m2, 30.0, max_relative = 1e-12);
}

#[test]
fn a_cylindrical_shade_counts_with_what_it_shows() {
    let spacecraft = spacecraft(
        crate::spacecraft::MESSENGER_TOML.replace("model = \"plates\"", "model = \"cylinder\"").as_str(),
    );
    let shade = spacecraft.sunshade.as_ref().unwrap().cylinder.unwrap();
    let mut alone = spacecraft.clone();
    alone.panels.clear();
    let figures = Figures::of(&alone);
    let shown_m2 = 2.0 * shade.radius_m * shade.half_angle_rad.min(PI / 2.0).sin() * shade.height_m;
    assert_relative_eq!(figures.sunlit_area_m2, shown_m2, max_relative = 1e-9);
    assert_relative_eq!(figures.area_toward_minus_m2.y, shown_m2, max_relative = 2e-3);
}

#[test]
fn wheels_hold_what_their_pyramid_holds_in_its_worst_direction() {
    let c = (1.0_f64 / 3.0).sqrt();
    let axes = [(c, c), (c, -c), (-c, -c), (-c, c)].map(|(x, z)| Vector3::new(x, c, z));
    let array = WheelArray::new(&axes).unwrap();
    // Each takes 3/4 of what lies along its axis.
    let held = array.guaranteed_magnitude_n_m_s([7.5; 4].into_iter());
    assert_relative_eq!(held, 10.0, max_relative = 1e-14);
    let askew = [
        Vector3::new(0.6, 0.8, 0.0),
        Vector3::new(0.0, 0.6, 0.8),
        Vector3::z(),
        Vector3::new(0.8, 0.0, -0.6),
    ];
    let capacities = [2.0, 3.0, 1.0, 5.0];
    let array = WheelArray::new(&askew).unwrap();
    // Over many directions, the greatest momentum before a wheel is full.
    let worst = (0..400_000).map(|k| {
        let (z, azimuth) = (1.0 - (f64::from(k) + 0.5) / 200_000.0, 2.399_963 * f64::from(k));
        let across = (1.0 - z * z).sqrt();
        let direction = Vector3::new(across * azimuth.cos(), across * azimuth.sin(), z);
        let each = (0..4).map(|wheel| capacities[wheel] / array.momentum_n_m_s(wheel, &direction).abs());
        each.fold(f64::INFINITY, f64::min)
    });
    let worst = worst.fold(f64::INFINITY, f64::min);
    assert_relative_eq!(array.guaranteed_magnitude_n_m_s(capacities.into_iter()), worst, max_relative = 1e-4);
}

#[test]
fn shipped_spacecraft_look_right() {
    for text in [
        crate::spacecraft::MESSENGER_TOML,
        crate::spacecraft::MESSENGER_THERMAL_TOML,
        include_str!("../../../resources/messenger-full.toml"),
        include_str!("../../../resources/examples/solar-sailer.toml"),
        include_str!("../../../resources/examples/mercury-orbiter.toml"),
        include_str!("../../../resources/examples/flexible-craft.toml"),
        include_str!("../../../resources/examples/sunshield-telescope.toml"),
    ] {
        assert_eq!(judged(text), [""; 0], "{}", text.lines().next().unwrap());
    }
}

#[test]
fn each_slip_has_its_warning() {
    let inertia = "[[650, 0, 0], [0, 500, 0], [0, 0, 250]]";
    let outline = "[[plates]]\nname = 'fin'\npolygon_m = [[0.5, 0, 0], [1.5, 0, 0], [1.5, 0.001, 1], [0.5, 0, 1]]\n\
        optics = 'black'\nrear_optics = 'black'\n";
    let lid = |normal: i32| {
        format!(
            "open_faces = ['+Z']\n[[plates]]\nname = 'lid'\nnormal = [0, 0, {normal}]\narea_m2 = 2\n\
             center_m = [0, 0, 1.5]\noptics = 'black'\n"
        )
    };
    let slips = [
        (SOLID.replace("[1, 2, 3]", "[1000, 2000, 3000]"), "it is 3000.000 m long"),
        (SOLID.replace("mass_kg = 600", "mass_kg = 0.6"), "by its inertia the mass lies"),
        (
            SOLID.replace("mass_kg = 600", "mass_kg = 600e3"),
            "600000 kg in the 6.000 m3 of its extents are 100000.000 kg/m3",
        ),
        (
            SOLID.replace(inertia, "[[6500, 0, 0], [0, 5000, 0], [0, 0, 2500]]"),
            "and no surface lies farther than",
        ),
        (SOLID.replace(inertia, "[[0.065, 0, 0], [0, 0.05, 0], [0, 0, 0.025]]"), "inertia is in kg m2"),
        (SOLID.replace("[0.1, 0.2, 0.3]", "[0.1, 1.2, 0.3]"), "the centre of mass lies 0.20 m"),
        (format!("{SOLID}{}", lid(-1)), "`lid` faces inward"),
        (format!("{SOLID}{outline}"), "`fin` has a corner 0.25 mm off the plane"),
        (
            format!(
                "{SOLID}[[plates]]\nname = 'far'\nnormal = [0, 0, 1]\narea_m2 = 2\ncenter_m = [900, 0, 0]\noptics = 'black'\n"
            ),
            "spread over 90",
        ),
    ];
    for (text, part) in slips {
        let found = judged(&text);
        assert!(found.iter().any(|warning| warning.contains(part)), "{part}: {found:?}");
    }
    assert_eq!(judged(&format!("{SOLID}{}", lid(1))), [""; 0]);
}

proptest! {
    #[test]
    fn a_point_is_outside_of_a_turned_box_by_its_distance(
        point in prop::array::uniform3(-4.0..4.0_f64),
        turn in prop::array::uniform3(-3.0..3.0_f64),
    ) {
        let half = Vector3::new(0.5, 1.0, 1.5);
        let turn = Rotation3::from_euler_angles(turn[0], turn[1], turn[2]);
        let corners: Vec<Vector3<f64>> = (0..8_u8)
            .map(|k| turn * half.map_with_location(|i, _, h| if k >> i & 1 == 0 { h } else { -h }))
            .collect();
        let point = Vector3::from(point);
        let distance = point.zip_map(&half, |p, h| (p.abs() - h).max(0.0)).norm();
        let found = is_outside(&(turn * point), &corners, 0.05);
        if distance > 0.06 {
            let found = found.unwrap();
            prop_assert!(found <= distance * (1.0 + 1e-9) && found > 0.98 * distance, "{} {}", found, distance);
        }
        if distance < 0.05 {
            prop_assert_eq!(found, None);
        }
    }
}

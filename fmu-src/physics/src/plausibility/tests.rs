//! Figures of bodies known by heart, and warnings where something was slipped in, and only there.

use core::f64::consts::PI;

use approx::assert_relative_eq;
use nalgebra::{Rotation3, Vector3};
use proptest::prelude::*;

use super::*;
use crate::constants::SPEED_OF_LIGHT_M_S;
use crate::environment::sun::SOLAR_FLUX_W_M2;
use crate::spacecraft::Spacecraft;

/// A solid box of 1 m by 2 m by 3 m and 600 kg, black but for a mirror on the Sun's side, with a pyramid of wheels.
const SOLID: &str = include_str!("solid.toml");

fn spacecraft(text: &str) -> Spacecraft {
    Spacecraft::from_toml("solid.toml", text).unwrap()
}

fn judged(text: &str) -> Vec<String> {
    let spacecraft = spacecraft(text);
    warnings(&spacecraft, &Figures::new(&spacecraft))
}

#[test]
fn a_solid_box_has_the_figures_of_the_textbook() {
    let figures = Figures::new(&spacecraft(SOLID));
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
    assert_eq!(figures.wheels, None);
    // Nothing stands before the mirror.
    assert_relative_eq!(
        figures.shadowed_solar.unwrap().1,
        figures.solar.unwrap().1,
        epsilon = 1e-20,
        max_relative = 1e-12
    );
    // Twice the pressure along +Y on 3 m2, at the arm of the -Y face's centre from the centre of mass.
    let force_n = Vector3::y() * (2.0 * 3.0 * SOLAR_FLUX_W_M2 / SPEED_OF_LIGHT_M_S);
    let arm_m = Vector3::new(-0.1, -1.2, -0.3);
    assert_relative_eq!(
        figures.solar.unwrap().1,
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
    let figures = Figures::new(&spacecraft(&text));
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
    let figures = Figures::new(&alone);
    let shown_m2 = 2.0 * shade.radius_m * shade.half_angle_rad.min(PI / 2.0).sin() * shade.height_m;
    assert_relative_eq!(figures.sunlit_area_m2, shown_m2, max_relative = 1e-9);
    assert_relative_eq!(figures.area_toward_minus_m2.y, shown_m2, max_relative = 2e-3);
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
        include_str!("../../../resources/examples/cubesat-12u.toml"),
        include_str!("../../../resources/examples/leo-500kg.toml"),
    ] {
        assert_eq!(judged(text), [""; 0], "{}", text.lines().next().unwrap());
    }
}

/// Places and forces of six thrusters, each of which turns the solid box one way about an axis.
const JETS: [([f64; 3], [i32; 3]); 6] = [
    ([0.1, 1.0, -1.5], [0, 0, 1]),
    ([0.1, -1.0, -1.5], [0, 0, 1]),
    ([0.5, 0.2, 1.5], [-1, 0, 0]),
    ([0.5, 0.2, -1.5], [-1, 0, 0]),
    ([0.5, 1.0, 0.3], [-1, 0, 0]),
    ([0.5, -1.0, 0.3], [-1, 0, 0]),
];

/// The solid box with thrusters whose force is that of the list times a sign.
fn with_jets(jets: &[([f64; 3], [i32; 3])], sign: i32) -> String {
    let tank = "[[tanks]]\nposition_m = [0, 0, 0]\npropellant_kg = 10\n";
    let jets = jets.iter().enumerate().map(|(k, (position_m, direction))| {
        format!(
            "[[thrusters]]\nname = 'T{k}'\nposition_m = {position_m:?}\ndirection = {:?}\nforce_n = 2\n\
             specific_impulse_s = 220\nplume_half_angle_deg = 20\n",
            direction.map(|part| sign * part)
        )
    });
    format!("{SOLID}{tank}{}", jets.collect::<String>())
}

#[test]
fn thrusters_are_judged_about_the_centre_of_mass() {
    let text = with_jets(&JETS, 1);
    let figures = Figures::new(&spacecraft(&text));
    // Arms of 0.8 m and 1.2 m along Y, 1.2 m and 1.8 m along Z, at 2 N; the first two turn about X alone.
    assert_relative_eq!(figures.thrusters[0].torque_body_n_m, Vector3::new(1.6, 0.0, 0.0), epsilon = 1e-12);
    let torque = figures.thruster_torque.unwrap();
    assert_relative_eq!(torque.plus_n_m, Vector3::new(1.6, 3.6, 1.6), epsilon = 1e-12);
    assert_relative_eq!(torque.minus_n_m, Vector3::new(2.4, 2.4, 2.4), epsilon = 1e-12);
    assert_eq!(judged(&text), [""; 0]);
    // A plate in the first jet's way.
    let plate = "[[plates]]\nname = 'deck'\nnormal = [0, 0, 1]\narea_m2 = 0.1\ncenter_m = [0.1, 1.0, -2]\noptics = 'black'\n";
    let figures = Figures::new(&spacecraft(&format!("{text}{plate}")));
    let met = figures.thrusters.iter().map(|it| it.meets.as_deref()).collect::<Vec<_>>();
    assert_eq!(met, [Some("deck"), None, None, None, None, None]);
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
        (
            SOLID.replace(inertia, "[[2460, 0, 0], [0, 1830, 0], [0, 0, 822]]"),
            "the radius of gyration about X is 2.025 m, 0.675 of the 3.000 m across that axis",
        ),
        (
            SOLID.replace(inertia, "[[12, 0, 0], [0, 12, 0], [0, 0, 12]]"),
            "the radius of gyration about X is 0.141 m, 0.047 of the 3.000 m across that axis",
        ),
        (
            format!(
                "{SOLID}[[plates]]\nname = 'lid'\nnormal = [0, 0, 1]\narea_m2 = 20\ncenter_m = [0, 0, 1.6]\noptics = 'black'\n"
            ),
            "`lid` has 20.000 m2, and all around it spans 2.000 m2 across it",
        ),
        (with_jets(&JETS, -1), "the jets of all thrusters blow inward"),
        (with_jets(&JETS[..5], 1), "no thruster gives torque about -Z of the centre of mass"),
    ];
    for (text, part) in slips {
        let found = judged(&text);
        assert!(found.iter().any(|warning| warning.contains(part)), "{part}: {found:?}");
    }
    assert_eq!(judged(&format!("{SOLID}{}", lid(1))), [""; 0]);
}

/// A square of 80 m2 in the XZ plane, as `more` has its corners and sides.
fn sail(more: &str) -> String {
    format!(
        "name = 'Sail'\n[mass_properties]\nmass_kg = 16\ncenter_of_mass_m = [0.02, 0, -0.05]\n\
         inertia_kg_m2 = [[60, 0, 0], [0, 110, 0], [0, 0, 60]]\n[optics.front]\nspecular = 0.83\ndiffuse = 0.05\n{more}"
    )
}

#[test]
fn a_membrane_of_one_side_is_warned_of_whichever_way_it_faces() {
    let corners = ["[4.472, 0, -4.472]", "[-4.472, 0, -4.472]", "[-4.472, 0, 4.472]", "[4.472, 0, 4.472]"];
    let plate = |corners: [&str; 4], rear: &str| {
        sail(&format!(
            "[[plates]]\nname = 'sail'\npolygon_m = [{}]\noptics = 'front'\n{rear}",
            corners.join(", ")
        ))
    };
    let mut turned = corners;
    turned.reverse();
    for corners in [corners, turned] {
        let found = judged(&plate(corners, ""));
        assert!(found.iter().any(|it| it.contains("`sail` has one side and nothing behind it")), "{found:?}");
        let found = judged(&plate(corners, "rear_optics = 'front'\n"));
        assert!(!found.iter().any(|it| it.contains("nothing behind it")), "{found:?}");
    }
    // Four quarters in a plane hide nothing behind one another either.
    let quarter = |x: i32, z: i32| {
        format!(
            "[[plates]]\nname = 'q{x}{z}'\nnormal = [0, -1, 0]\narea_m2 = 20\ncenter_m = [{x}, 0, {z}]\noptics = 'front'\n"
        )
    };
    let quarters: String = [(-2, -2), (-2, 2), (2, -2), (2, 2)].map(|(x, z)| quarter(x, z)).concat();
    assert_eq!(judged(&sail(&quarters)).iter().filter(|it| it.contains("nothing behind it")).count(), 4);
}

#[test]
fn defaults_at_their_bounds_are_said() {
    let wheels = |torque_n_m: f64| {
        let wheel = |axis: &str| {
            format!(
                "[[wheels]]\naxis = {axis}\ncapacity_n_m_s = 50\nmax_torque_n_m = {torque_n_m}\ninertia_kg_m2 = 0.159\n"
            )
        };
        SOLID.split("[[wheels]]").next().unwrap().to_owned()
            + &["[1, 0, 0]", "[0, 1, 0]", "[0, 0, 1]"].map(wheel).concat()
    };
    // The largest inertia is 650 kg m2: half of 13,000 N m gives 10 rad/s2.
    assert_eq!(defaults_at_their_bounds(&spacecraft(&wheels(12_999.0))), [""; 0]);
    let said = defaults_at_their_bounds(&spacecraft(&wheels(1e7)));
    let [acceleration, torque] = said.as_slice() else { panic!("{said:?}") };
    assert!(acceleration.starts_with("control.slewAcceleration starts at 10 rad/s2"), "{acceleration}");
    assert!(torque.starts_with("dump.torque starts at 1000000 N.m"), "{torque}");
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

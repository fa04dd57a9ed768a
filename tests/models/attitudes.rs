//! Attitudes by name: closed forms, rates under the flight's whole gravity, light on the panels, refusals.

use client::short_or_long;
use models::{Guidance, MomentumPlant};
use nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector3};
use physics::constants::ASTRONOMICAL_UNIT_M;
use physics::spacecraft::MESSENGER_TOML;

use super::named_model::{NamedInstance, NamedModel, assert_cuts_change_nothing};

const LEO: &str = include_str!("../../fmu-src/resources/examples/leo-500kg.toml");

/// A spacecraft about the Earth with two arrays about one axis, and more of its file.
fn comsat(axis: &str, zero_normal: &str, more: &str) -> String {
    let panel = |y: &str| {
        format!(
            "[[panels]]\narea_m2 = 30\ncenter_m = [0, {y}, 0]\naxis = {axis}\nzero_normal = {zero_normal}\noptics = \"cells\"\n"
        )
    };
    format!(
        "name = \"Comsat\"\n[mass_properties]\nmass_kg = 3000\ncenter_of_mass_m = [0, 0, 0]\n\
         inertia_kg_m2 = [[20000, 0, 0], [0, 5000, 0], [0, 0, 20000]]\n[optics.cells]\nspecular = 0.1\ndiffuse = 0.1\n\
         {}{}{more}\n[start]\n\"orbit.center\" = \"earth\"\n\"start.epoch\" = \"2024-03-01 UTC\"\n",
        panel("8"),
        panel("-8")
    )
}

fn about_y(more: &str) -> NamedModel<MomentumPlant> {
    NamedModel::with("comsat.toml", &comsat("[0, 1, 0]", "[1, 0, 0]", more))
}

/// An ellipse in EME2000 that Kepler's laws alone give.
const KEPLER: [(&str, f64); 8] = [
    ("orbit.dynamics", 1.0),
    ("orbit.frame", 3.0),
    ("orbit.semiMajorAxis", 1.2e7),
    ("orbit.eccentricity", 0.3),
    ("orbit.inclination", 0.9),
    ("orbit.ascendingNode", 0.7),
    ("orbit.periapsisArgument", 1.1),
    ("orbit.trueAnomaly", 0.4),
];

#[test]
fn lvlh_is_keplers_closed_form() {
    let named = about_y("[pointing]\nattitude = \"lvlh\"\n");
    let mut flight = named.initialize(0.0, &KEPLER).unwrap();
    let (a_m, e) = (1.2e7_f64, 0.3_f64);
    let gm_m3_s2 = flight.real("planet.gravitationalParameter");
    let eccentric = 2.0 * (((1.0 - e) / (1.0 + e)).sqrt() * 0.2_f64.tan()).atan();
    let start = eccentric - e * eccentric.sin();
    for k in 0..40 {
        let time_s = 331.0 * f64::from(k);
        flight.step_to(time_s).unwrap_or(());
        let mean = start + (gm_m3_s2 / a_m.powi(3)).sqrt() * time_s;
        let eccentric = (0..30).fold(mean, |it, _| it - (it - e * it.sin() - mean) / (1.0 - e * it.cos()));
        let anomaly = 2.0 * (((1.0 + e) / (1.0 - e)).sqrt() * (0.5 * eccentric).tan()).atan();
        let about = |axis: Vector3<f64>, angle| UnitQuaternion::new(axis * angle);
        // X along the transverse direction, Y against the orbit normal, Z down.
        let body = Matrix3::new(0.0, 0.0, -1.0, 1.0, 0.0, 0.0, 0.0, -1.0, 0.0);
        let expected = about(Vector3::z(), 0.7)
            * about(Vector3::x(), 0.9)
            * about(Vector3::z(), 1.1 + anomaly)
            * UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(body));
        let found = flight.quaternion("attitude.q");
        let off = |sign: f64| (expected.coords * sign - nalgebra::Vector4::from(found)).amax();
        assert!(off(1.0).min(off(-1.0)) < 1e-14, "{:e} at {time_s} s", off(1.0).min(off(-1.0)));
        let radius_m = a_m * (1.0 - e * eccentric.cos());
        let rate_rad_s = (gm_m3_s2 * a_m * (1.0 - e * e)).sqrt() / (radius_m * radius_m);
        let off = (flight.vector("attitude.rate") - Vector3::new(0.0, -rate_rad_s, 0.0)).amax();
        assert!(off < 1e-15, "{off:e} rad/s at {time_s} s");
    }
}

/// Largest difference, in rad/s, between rates and differences of the attitude over 2 s.
fn rate_off(flight: &mut NamedInstance<'_, MomentumPlant>, times_s: impl Iterator<Item = f64>) -> f64 {
    let mut worst = 0.0_f64;
    for time_s in times_s {
        let mut at = |at_s: f64| {
            flight.step_to(at_s).unwrap();
            (flight.to_inertial("attitude.q"), flight.vector("attitude.rate"))
        };
        let ([(before, _), (_, rate), (after, _)], span_s) =
            ([-1.0, 0.0, 1.0].map(|off| at(time_s + off)), 2.0);
        worst = worst.max(((before.inverse() * after).scaled_axis() / span_s - rate).norm());
    }
    worst
}

#[test]
fn rates_hold_under_flattening_tides_and_other_bodies() {
    let downtrack = "[[command]]\nat = 0\nscenario = \"generic\"\nboresight = { option = \"vector\", vector = [1, 0, 0] }\n\
                     aimpoint = { option = \"lvlhDowntrack\", azimuth = \"20 deg\", elevation = \"-10 deg\" }\n\
                     bodyRoll = { option = \"vector\", vector = [0, 0, 1] }\nexternalRoll = { option = \"planet\" }\n";
    let velocity = [
        ("guided.scienceRule", 8.0),
        ("guided.align.axis[1]", 1.0),
        ("guided.align.axis[3]", 0.0),
        ("guided.align.target", 2.0),
        ("guided.constrain.target", 5.0),
    ];
    let gravity =
        [("orbit.radiationFeedback", 0.0), ("planetLight.enabled", 0.0), ("aerodynamics.enabled", 0.0)];
    let lvlh = [("guided.scienceRule", 4.0)];
    for dynamics in [2.0, 3.0] {
        for (rule, timeline) in [(&lvlh[..], None), (&velocity, None), (&[], Some(downtrack))] {
            let mut named = NamedModel::<MomentumPlant>::with("leo.toml", LEO);
            if let Some(text) = timeline {
                named = named.with_schedule("timeline.toml", text);
            }
            let sets = [&gravity[..], &[("orbit.dynamics", dynamics)], rule].concat();
            let mut flight = named.initialize(0.0, &sets).unwrap();
            let off = rate_off(&mut flight, (1..20).map(|k| 311.0 * f64::from(k)));
            assert!(off < 1e-10, "{dynamics} {rule:?} {timeline:?}: {off:e} rad/s");
        }
    }
}

#[test]
fn arrays_about_y_have_the_cosine_of_beta_under_lvlh_and_all_light_under_yaw_steering() {
    let named = about_y("");
    for (rule, sets) in [(4.0, &[("guided.scienceRule", 4.0)][..]), (5.0, &[])] {
        let mut flight = named.initialize(0.0, &[&KEPLER[..], sets].concat()).unwrap();
        assert_eq!(f64::from(flight.integer("guided.scienceRule")), rule);
        let (mut lit, mut least) = (0, 1.0_f64);
        for k in 1..60 {
            flight.step_to(217.0 * f64::from(k)).unwrap();
            if flight.real("sun.litFraction") < 1.0 {
                continue;
            }
            lit += 1;
            let (position, velocity) = (flight.vector("position"), flight.vector("velocity"));
            let to_sun = flight.vector("sun.positionInertial") - position;
            let sine = position.cross(&velocity).normalize().dot(&to_sun.normalize());
            let cosine = if rule == 4.0 { (1.0 - sine * sine).sqrt() } else { 1.0 };
            least = least.min(cosine);
            let expected = cosine / (to_sun.norm() / ASTRONOMICAL_UNIT_M).powi(2);
            for panel in ["panel[1].suns", "panel[2].suns"] {
                let off = flight.real(panel) - expected;
                assert!(off.abs() < 1e-12, "{panel} {off:e} under {rule}");
            }
        }
        assert!(lit > 20, "{lit}");
        assert_eq!(least < 0.95, rule == 4.0, "{least}");
    }
}

#[test]
fn the_default_is_yaw_steering_where_arrays_need_it_alone() {
    let rule = |named: NamedModel<MomentumPlant>, sets: &[(&str, f64)]| {
        named.initialize(0.0, sets).unwrap().integer("guided.scienceRule")
    };
    let sun = [("orbit.center", 2.0)];
    let with =
        |axis: &str, normal: &str, more: &str| NamedModel::with("comsat.toml", &comsat(axis, normal, more));
    assert_eq!(rule(about_y(""), &[]), 5);
    assert_eq!(rule(about_y(""), &sun), 2);
    assert_eq!(rule(about_y(""), &[("guided.scienceRule", 2.0)]), 2);
    assert_eq!(rule(about_y("[sun_keep_in]\nazimuth_deg = 90\nelevation_deg = 90\n"), &[]), 2);
    assert_eq!(rule(with("[1, 0, 0]", "[0, -1, 0]", ""), &[]), 2);
    assert_eq!(rule(with("[0, 0, 1]", "[0, -1, 0]", ""), &[]), 2);
    assert_eq!(rule(with("[0.998, 0.0632139, 0]", "[0, 0, 1]", ""), &[]), 2);
    assert_eq!(rule(with("[0.99, 0.1410674, 0]", "[0, 0, 1]", ""), &[]), 5);
    assert_eq!(rule(about_y("[pointing]\nattitude = \"sunPointing\"\n"), &sun), 6);
}

#[test]
fn the_file_gives_the_start_values_and_the_phase() {
    let text = "[pointing]\nalign = { axis = [1, 0, 0], to = \"velocity\" }\nconstrain = { axis = [0, 0, 2], to = \"star\" }\n\
                star = { right_ascension_deg = 30, declination_deg = -45 }\nslew_rate_deg_s = 0.1\n\
                [[antennas]]\nname = \"dish\"\naxis = [0, 0, 1]\nbeam_deg = [1, 1]\n";
    let named = about_y(text);
    // About the Sun a file with antennas would be in cruise.
    let flight = named.initialize(0.0, &[("orbit.center", 2.0)]).unwrap();
    assert_eq!((flight.integer("guided.phase"), flight.integer("guided.scienceRule")), (1, 8));
    assert_eq!((flight.integer("guided.align.target"), flight.integer("guided.constrain.target")), (2, 6));
    assert_eq!(flight.vector("guided.align.axis"), Vector3::x());
    assert_eq!(flight.vector("guided.constrain.axis"), Vector3::z() * 2.0);
    let star = ["rightAscension", "declination"].map(|name| flight.real(&format!("guided.constrain.{name}")));
    assert_eq!(star, [30_f64.to_radians(), -45_f64.to_radians()]);
    assert_eq!(flight.real("guided.slewRate"), 0.1_f64.to_radians());
    let quaternion = about_y("[pointing]\nquaternion = [0.6, 0.0, 0.0, 0.8]\n");
    let flight = quaternion.initialize(0.0, &[]).unwrap();
    assert_eq!(flight.integer("guided.scienceRule"), 7);
    assert!(
        (nalgebra::Vector4::from(flight.quaternion("attitude.q"))
            - nalgebra::Vector4::new(0.6, 0.0, 0.0, 0.8))
        .amax()
            < 1e-15
    );
}

#[test]
fn what_gives_no_attitude_is_refused_by_name() {
    let says = |named: &NamedModel<MomentumPlant>, sets: &[(&str, f64)], words: &[&str]| {
        let text = named.refusal(sets);
        assert!(words.iter().all(|word| text.contains(word)), "{words:?}: {text}");
    };
    let messenger = NamedModel::<MomentumPlant>::shipped();
    let sun = ("orbit.center", 2.0);
    let in_orbit = ("guided.phase", 1.0);
    let aligned = ("guided.scienceRule", 8.0);
    says(
        &messenger,
        &[sun, in_orbit, ("guided.scienceRule", 4.0)],
        &["guided.scienceRule", "lvlh about the Sun"],
    );
    says(
        &messenger,
        &[sun, in_orbit, ("guided.scienceRule", 5.0)],
        &["guided.scienceRule", "yawSteering about the Sun"],
    );
    says(&messenger, &[sun, in_orbit, aligned], &["guided.align.target", "nadir about the Sun"]);
    let second = [("guided.align.target", 4.0), ("guided.constrain.target", 1.0)];
    says(
        &messenger,
        &[&[sun, in_orbit, aligned][..], &second].concat(),
        &["guided.constrain.target", "nadir about the Sun"],
    );
    says(
        &messenger,
        &[aligned, ("guided.constrain.target", 1.0)],
        &["guided.constrain.target", "nadir twice"],
    );
    let zero = [("guided.align.axis[3]", 0.0)];
    says(&messenger, &[&[aligned][..], &zero].concat(), &["guided.align.axis", "zero vector"]);
    let parallel = [("guided.constrain.axis[2]", 0.0), ("guided.constrain.axis[3]", -2.0)];
    says(&messenger, &[&[aligned][..], &parallel].concat(), &["guided.constrain.axis", "parallel"]);
    let q = [("guided.scienceRule", 7.0), ("guided.attitude[4]", 1.0011)];
    says(&messenger, &q, &["guided.attitude", "1.0011", "within 1e-3"]);
    let along_z = NamedModel::with("comsat.toml", &comsat("[0, 0, 1]", "[0, -1, 0]", ""));
    says(&along_z, &[("guided.scienceRule", 5.0)], &["guided.scienceRule", "yawSteering", "along Z"]);
    let sails = include_str!("../../fmu-src/resources/examples/leo-500kg.toml").replacen(
        "axis = [1.0, 0.0, 0.0]\nzero_normal = [0.0, -1.0, 0.0]",
        "axis = [0.0, 1.0, 0.0]\nzero_normal = [0.0, 0.0, -1.0]",
        1,
    );
    let several = NamedModel::with(
        "leo.toml",
        &sails.replacen(
            "[[0.9, 0.0, -0.8], [4.1, 0.0, -0.8], [4.1, 0.0, 0.8], [0.9, 0.0, 0.8]]",
            "[[0.9, -0.8, 0.0], [4.1, -0.8, 0.0], [4.1, 0.8, 0.0], [0.9, 0.8, 0.0]]",
            1,
        ),
    );
    says(&several, &[("guided.scienceRule", 5.0)], &["guided.scienceRule", "yawSteering", "several axes"]);
    // The old rule stays about the Sun.
    messenger.initialize(0.0, &[sun, in_orbit, ("guided.scienceRule", 2.0)]).unwrap().step_to(600.0).unwrap();
    let text = NamedModel::<Guidance>::shipped()
        .refusal(&[("guided.scienceRule", 8.0), ("guided.constrain.target", 1.0)]);
    assert!(text.contains("guided.constrain.target") && text.contains("twice"), "{text}");
}

#[test]
fn targets_on_one_line_are_reported_once() {
    // North of the ecliptic twice: as a star of its declination and by its name.
    let pole = [
        ("guided.align.rightAscension", -core::f64::consts::FRAC_PI_2),
        ("guided.align.declination", (90.0 - 84_381.448 / 3600.0_f64).to_radians()),
    ];
    let targets =
        [("guided.scienceRule", 8.0), ("guided.align.target", 6.0), ("guided.constrain.target", 7.0)];
    let named = about_y("");
    let mut flight = named.initialize(0.0, &[&pole[..], &targets].concat()).unwrap();
    assert!(flight.boolean("guided.degenerate"));
    flight.simulate_to(7200.0, 600.0).unwrap();
    let warnings = named.warnings();
    assert_eq!(warnings.iter().filter(|it| it.contains("guided.degenerate")).count(), 1, "{warnings:?}");
    let mut other = named.initialize(0.0, &[&targets[..], &pole[1..]].concat()).unwrap();
    other.step_to(60.0).unwrap();
    assert!(!other.boolean("guided.degenerate"));
}

/// Windows of downlink with turns in and out of them.
const WINDOWS: [(&str, f64); 6] = [
    ("guided.downlinkEvery", 1.0),
    ("guided.downlinkStart", 1800.0),
    ("guided.downlinkEnd", 4500.0),
    ("guided.slewRate", 2e-3),
    ("orbit.dynamics", 2.0),
    ("planetLight.enabled", 0.0),
];

#[test]
fn steps_of_a_second_and_an_hour_and_a_restored_flight_have_the_same_bits() {
    let named = NamedModel::<MomentumPlant>::with("messenger.toml", MESSENGER_TOML);
    for rule in short_or_long(&[4, 5][..], &[4, 5, 6, 7, 8]) {
        let sets = [&WINDOWS[..], &[("guided.scienceRule", f64::from(*rule))]].concat();
        let initialize = || named.initialize(0.0, &sets).unwrap();
        assert_cuts_change_nothing(initialize, [3600.0, 7200.0], &[1.0, 3600.0], |_| {});
    }
    for rule in 4..=8 {
        let sets = [&WINDOWS[..], &[("guided.scienceRule", f64::from(rule))]].concat();
        let mut straight = named.initialize(0.0, &sets).unwrap();
        // In a turn.
        straight.step_to(1900.0).unwrap();
        let mut restored = straight.restored();
        for flight in [&mut straight, &mut restored] {
            flight.step_to(7000.0).unwrap();
        }
        assert_eq!(straight.output_bits(), restored.output_bits(), "{rule}");
    }
}

#[test]
fn rates_are_derivatives_in_windows_turns_and_at_the_zone() {
    let named = NamedModel::<MomentumPlant>::with("messenger.toml", MESSENGER_TOML);
    for rule in 4..=8 {
        let sets =
            [&WINDOWS[..], &[("guided.scienceRule", f64::from(rule)), ("orbit.radiationFeedback", 0.0)]]
                .concat();
        let mut flight = named.initialize(0.0, &sets).unwrap();
        let off = rate_off(&mut flight, (1..40).map(|k| 211.0 * f64::from(k)));
        assert!(off < 2e-9, "{rule}: {off:e} rad/s");
    }
}

#[test]
fn the_zone_acts_as_on_a_command_of_a_timeline() {
    let timeline = "[[command]]\nat = 0\nscenario = \"generic\"\nboresight = { option = \"vector\", vector = [0, 0, 1] }\n\
                    aimpoint = { option = \"nadir\" }\nbodyRoll = { option = \"vector\", vector = [0, -1, 0] }\n\
                    externalRoll = { option = \"orbitNormal\" }\n";
    let by_rule = NamedModel::<MomentumPlant>::shipped();
    let by_command = NamedModel::<MomentumPlant>::shipped().with_schedule("timeline.toml", timeline);
    let rule = [("guided.scienceRule", 4.0), ("guided.downlinkEvery", 0.0)];
    let mut moved = 0;
    for zone in [&[][..], &[("keepIn.enabled", 0.0)], &[("keepIn.axis[1]", 0.3), ("keepIn.method", 2.0)]] {
        let sets = [&rule[..], zone].concat();
        let [mut a, mut b] = [&by_rule, &by_command].map(|named| named.initialize(0.0, &sets).unwrap());
        for k in 1..100 {
            for flight in [&mut a, &mut b] {
                flight.step_to(431.0 * f64::from(k)).unwrap();
            }
            for name in ["attitude.q", "attitude.rate", "momentum.inertial"] {
                assert_eq!(a.vector(name), b.vector(name), "{name} {zone:?}");
            }
            let down = a.to_inertial("attitude.q") * Vector3::z() + a.vector("position").normalize();
            moved += i32::from(down.norm() > 1e-3);
        }
    }
    assert!(moved > 50, "{moved}");
}

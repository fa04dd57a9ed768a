//! Values that a master sets, at the start or on the way, act as their names say and from the time they were set.

use models::{DisturbanceTorque, MomentumPlant};
use nalgebra::Vector3;

use super::named_model::{NamedInstance, NamedModel};
use super::plant_light::{EFFECTS, memoryless, radiating};

/// A Sun that stands at a given place, seen from the planet.
const SUN_M: [f64; 3] = [3e10, -2e10, 1e10];
const SUN_INPUTS: &[(&str, f64)] = &[
    ("ephemeris.source", 3.0),
    ("sun.position[1]", SUN_M[0]),
    ("sun.position[2]", SUN_M[1]),
    ("sun.position[3]", SUN_M[2]),
];
const COMMANDED: &[(&str, f64)] = &[("attitude.source", 2.0)];

#[test]
fn light_follows_what_is_set_on_the_way_at_once() {
    let plants = radiating::<MomentumPlant>();
    let models = radiating::<DisturbanceTorque>();
    let flux = ("solar.flux", 1365.0);
    let sets = [EFFECTS, COMMANDED, SUN_INPUTS, &[flux, ("thermal.storage", 0.0)]].concat();
    let mut plant = plants.initialize(0.0, &sets).unwrap();
    let mut center_m = [0.1, 0.05, -0.2];
    let check = |plant: &NamedInstance<'_, MomentumPlant>, center_m: [f64; 3], what: &str| {
        let center = [1, 2, 3].map(|i| format!("spacecraft.centerOfMass[{i}]"));
        let center: Vec<(&str, f64)> = center.iter().map(String::as_str).zip(center_m).collect();
        let model = memoryless(&models, plant, &[&[flux], center.as_slice()].concat());
        for source in ["solar", "albedo", "infrared", "thermal"] {
            for (quantity, arm_m) in [("force", 1.0), ("torque", 1.0)] {
                let name = format!("{quantity}.{source}");
                let scale = (1e-6 + model.vector("force.total").norm()) * arm_m;
                let apart = (plant.vector(&name) - model.vector(&name)).norm() / scale;
                assert!(apart < 2e-4, "{what}: {name}: {apart:e}");
            }
        }
    };
    plant.step_to(60.0).unwrap();
    check(&plant, center_m, "at the start");
    plant.set("panel[2].sunOffset", 1.0);
    plant.step_to(60.5).unwrap();
    check(&plant, center_m, "panel[2].sunOffset");
    center_m[0] = -0.7;
    plant.set("spacecraft.centerOfMass[1]", center_m[0]);
    plant.step_to(61.0).unwrap();
    check(&plant, center_m, "spacecraft.centerOfMass");
    plant.set("command.q[1]", 0.5);
    plant.step_to(61.5).unwrap();
    check(&plant, center_m, "command.q");
    plant.set("panel[1].angle", -0.8);
    plant.step_to(62.0).unwrap();
    check(&plant, center_m, "panel[1].angle");
}

#[test]
fn an_orbit_given_on_the_way_begins_when_it_was_given() {
    let named = NamedModel::<MomentumPlant>::shipped();
    // A circle in the X-Y plane: 1e-3 rad/s.
    let (radius_m, rate_rad_s) = (4e6_f64, 1e-3);
    let gm_m3_s2 = rate_rad_s * rate_rad_s * radius_m.powi(3);
    let sets = [
        ("orbit.source", 2.0),
        ("planet.gravitationalParameter", gm_m3_s2),
        ("orbit.position[1]", radius_m),
        ("orbit.velocity[2]", rate_rad_s * radius_m),
    ];
    for model in [1.0, 2.0] {
        let disturbed = [
            ("orbit.dynamics", model),
            ("orbit.sunTide", 0.0),
            ("planet.j2", 0.0),
            ("orbit.radiationFeedback", 0.0),
        ];
        let mut flight = named.initialize(-500.0, &[sets.as_slice(), &disturbed].concat()).unwrap();
        let on_circle = |flight: &NamedInstance<'_, MomentumPlant>, since_s: f64, from_rad: f64| {
            let (sin, cos) = (from_rad + rate_rad_s * (flight.time_s() - since_s)).sin_cos();
            let expected = Vector3::new(cos, sin, 0.0) * radius_m;
            let apart_m = (flight.vector("position") - expected).norm();
            assert!(apart_m < 1e-2, "{model} {} s: {apart_m} m", flight.time_s());
        };
        flight.step_to(0.0).unwrap();
        on_circle(&flight, -500.0, 0.0);
        flight.step_to(700.0).unwrap();
        on_circle(&flight, -500.0, 0.0);
        let quarter = core::f64::consts::FRAC_PI_2;
        for (name, value) in [
            ("orbit.position[1]", 0.0),
            ("orbit.position[2]", radius_m),
            ("orbit.velocity[1]", -rate_rad_s * radius_m),
            ("orbit.velocity[2]", 0.0),
        ] {
            flight.set(name, value);
        }
        for end_s in [760.0, 1700.0] {
            flight.step_to(end_s).unwrap();
            on_circle(&flight, 700.0, quarter);
        }
    }
}

/// Position on a disturbed orbit after a minute.
fn after_a_minute(sets: &[(&str, f64)]) -> Vector3<f64> {
    a_minute(sets)[1]
}

/// Position on a disturbed orbit at its beginning and after a minute.
fn a_minute(sets: &[(&str, f64)]) -> [Vector3<f64>; 2] {
    let named = NamedModel::<MomentumPlant>::shipped();
    let still = [("orbit.dynamics", 2.0), ("orbit.radiationFeedback", 0.0)];
    let mut flight = named.initialize(0.0, &[SUN_INPUTS, &still, sets].concat()).unwrap();
    let start = flight.vector("position");
    flight.step_to(60.0).unwrap();
    [start, flight.vector("position")]
}

/// Over a minute a small acceleration a moves the spacecraft by a t^2 / 2, but for a per cent by which gravity changes.
#[test]
fn the_tide_can_be_left_out_and_is_the_difference_of_two_pulls() {
    let [start, with] = a_minute(&[("planet.j2", 0.0), ("orbit.sunTide", 1.0)]);
    let without = after_a_minute(&[("planet.j2", 0.0), ("orbit.sunTide", 0.0)]);
    let sun_m = Vector3::from(SUN_M);
    let pull = |to_m: Vector3<f64>| to_m * (1.327_124_400_18e20 / to_m.norm().powi(3));
    // What acts early has the longest to act: the mean place lies a third of the way along.
    let mean = start + (with - start) / 3.0;
    let expected_m = (pull(sun_m - mean) - pull(sun_m)) * (0.5 * 60.0 * 60.0);
    let moved_m = with - without;
    assert!((moved_m - expected_m).norm() < 0.01 * expected_m.norm(), "{moved_m} {expected_m}");
}

#[test]
fn flattening_goes_with_the_square_of_its_own_radius() {
    let moved = |sets: &[(&str, f64)]| {
        let with = after_a_minute(&[sets, &[("planet.j2", 1e-3)]].concat());
        let without = after_a_minute(&[sets, &[("planet.j2", 0.0)]].concat());
        with - without
    };
    let once = moved(&[("planet.j2Radius", 1e6)]);
    let twice = moved(&[("planet.j2Radius", 2e6)]);
    assert!(once.norm() > 1e-2 && (twice - once * 4.0).norm() < 1e-4 * twice.norm(), "{once} {twice}");
    let elsewhere = moved(&[("planet.j2Radius", 1e6), ("planet.radius", 2.3e6)]);
    assert!((elsewhere - once).norm() < 1e-6 * once.norm());
}

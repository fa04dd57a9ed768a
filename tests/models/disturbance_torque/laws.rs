//! DisturbanceTorque through FMI's functions gives what its physics gives, has no memory, and refuses by name.

use client::{Message, StatePointer};
use fmi_export::{Model, Status};
use model_description::{Causality, validate};
use models::DisturbanceTorque;
use nalgebra::Vector3;

use super::super::random::RandomNumbers;
use super::driver::Disturbance;

#[test]
fn the_description_is_valid_and_structured() {
    for fmu in [Disturbance::messenger(), Disturbance::shadowed()] {
        assert_eq!(validate(&fmu.description), vec![]);
        assert!(fmu.description.co_simulation.as_ref().unwrap().provides_directional_derivative);
        assert!(fmu.description.structure.outputs.iter().all(|unknown| unknown.dependencies.is_some()));
    }
    let fmu = Disturbance::messenger();
    let has = |name| fmu.find(name).is_some();
    assert!(has("panel[2].angle") && !has("panel[3].angle"));
    assert!(!has("plate[1].temperature"));
    // Three plates and two panels, two of them with rears.
    let fmu = Disturbance::shadowed();
    let has = |name| fmu.find(name).is_some();
    assert!(has("plate[7].force[3]") && !has("plate[8].temperature"));
}

/// Straight into the Sun with the planet far away: the shade's front half and the panels by hand.
#[test]
fn a_panel_facing_the_sun_is_pushed_by_the_flat_plate_law() {
    let mut fmu = Disturbance::messenger();
    fmu.put_vector("sun.positionBody", [0.0, -1.495978707e11, 0.0]);
    fmu.put_vector("planet.positionBody", [0.0, 0.0, 1e12]);
    fmu.start();
    assert_eq!(fmu.step(), Status::Ok);
    let pressure = 1365.0 / 299_792_458.0;
    let (side_cos, front) = (52.8_f64.to_radians().cos(), 1.264 * (0.63 + 0.23 + 2.0 * (0.23 / 3.0 + 0.14)));
    // The side shades make 52.8 deg with -Y in azimuth: 37.2 deg from the Sun.
    let cos = 52.8_f64.to_radians().sin();
    let along_light = (0.64 + 0.22) + 2.0 * (0.22 / 3.0 + 0.14 * cos) * cos;
    let sides = (2.122 + 2.121) * cos * along_light;
    let panels = 2.0 * 2.724 * (0.75 + 2.0 * 0.25);
    let expected = pressure * (front + sides + panels);
    let [x, y, z] = fmu.vector("force.solar");
    assert!((y / expected - 1.0).abs() < 1e-9, "{y} {expected}");
    assert!(z.abs() < 1e-20 && x.abs() < pressure * 0.01 * side_cos, "{x} {z}");
    assert_eq!(fmu.real("sun.litFraction"), 1.0);
    let total = fmu.vector("force.total");
    let parts = ["solar", "albedo", "infrared", "thermal"].map(|name| fmu.vector(&format!("force.{name}")));
    for i in 0..3 {
        assert!((total[i] - parts.iter().map(|part| part[i]).sum::<f64>()).abs() < 1e-19);
    }
    // The planet is a million radii away.
    assert!(parts[1].iter().chain(&parts[2]).all(|x| x.abs() < 1e-12));
}

#[test]
fn there_is_no_memory() {
    let mut fmu = Disturbance::messenger();
    fmu.start();
    let mut random = RandomNumbers(5);
    let outputs = fmu.references(Causality::Output);
    let geometries: Vec<_> = (0..20).map(|_| random.inputs(&fmu, false)).collect();
    let first: Vec<_> = geometries.iter().map(|(at, values)| fmu.outputs_at(at, values, &outputs)).collect();
    for ((at, values), first) in geometries.iter().zip(&first).rev() {
        assert_eq!(&fmu.outputs_at(at, values, &outputs), first);
    }
}

#[test]
fn a_restored_state_goes_on_as_before() {
    let mut fmu = Disturbance::shadowed();
    fmu.start();
    let outputs = fmu.references(Causality::Output);
    let inputs = fmu.references(Causality::Input);
    let (at, values) = RandomNumbers(9).inputs(&fmu, false);
    let expected = fmu.outputs_at(&at, &values, &outputs);
    let (status, bytes) = fmu.fmu.state_bytes();
    assert_eq!(status, Status::Ok);
    let mut other = Disturbance::shadowed();
    other.start();
    let (status, state) = other.fmu.deserialize(&bytes);
    assert_eq!(status, Status::Ok);
    assert_eq!(other.fmu.set_state(&state), Status::Ok);
    let mut state: StatePointer = state;
    other.fmu.free_state(&mut state);
    assert_eq!(other.read(&outputs), expected);
    let seed = vec![1.0; inputs.len()];
    assert_eq!(other.slopes(&outputs, &inputs, &seed), fmu.slopes(&outputs, &inputs, &seed));
    other.time_s = 1.0;
    assert_eq!(other.step(), Status::Ok);
    assert_eq!(other.read(&outputs), expected);
}

fn refusal(change: impl FnOnce(&mut Disturbance)) -> String {
    let mut fmu = Disturbance::messenger();
    change(&mut fmu);
    assert_ne!(fmu.fmu.start(0.0, None), Status::Ok);
    fmu.fmu.drain_messages().into_iter().map(|Message { text, .. }| text).collect()
}

#[test]
fn impossible_geometries_are_refused_by_name() {
    let inside = refusal(|fmu| fmu.put_vector("planet.positionBody", [1e6, 0.0, 0.0]));
    assert!(inside.contains("planet.positionBody") && inside.contains("radius"), "{inside}");
    // The Sun in the planet's centre; all zero would mean that it is not connected yet.
    let sunless = refusal(|fmu| fmu.put_vector("sun.positionBody", [2e6, 3e6, 9e6]));
    assert!(sunless.contains("sun.positionBody"), "{sunless}");
    let dark = refusal(|fmu| fmu.put("planet.emissivity", 0.0));
    assert!(dark.contains("emissivity"), "{dark}");
    let sum = refusal(|fmu| fmu.put("planet.diffuseReflectivity", 0.5));
    assert!(sum.contains("at most 1"), "{sum}");
    let inertia = refusal(|fmu| fmu.put("spacecraft.inertia[1,2]", 900.0));
    for word in ["spacecraft.inertia is [[", "900.0", "allowed: a symmetric matrix"] {
        assert!(inertia.contains(word), "{inertia}");
    }
}

#[test]
fn an_impossible_place_fails_the_step_by_name_and_reset_forgets_it() {
    let whole = |fmu: &mut Disturbance| {
        fmu.start();
        assert_eq!(fmu.step(), Status::Ok);
        fmu.vector("torque.total")
    };
    let mut fmu = Disturbance::messenger();
    let before = whole(&mut fmu);
    for (name, place, why) in [
        ("planet.positionBody", [1e6, -1e6, 0.0], "radius"),
        ("planet.positionBody", [0.0, 0.0, 1.0], "radius"),
        ("sun.positionBody", [2e6, 3e6, 9e6], "Sun"),
    ] {
        fmu.put_vector(name, place);
        assert_eq!(fmu.step(), Status::Error);
        let text: String = fmu.fmu.drain_messages().into_iter().map(|Message { text, .. }| text).collect();
        assert!(text.contains(name) && text.contains(why), "{text}");
        assert_eq!(fmu.fmu.reset(), Status::Ok);
        assert_eq!(whole(&mut fmu), before);
    }
}

#[test]
fn planet_light_beyond_the_work_limit_is_refused_by_name() {
    let by_cells = |belts: i32, limit: i32| {
        move |fmu: &mut Disturbance| {
            fmu.put_integer("planetLight.method", 2);
            fmu.put_integer("planetLight.belts", belts);
            fmu.put_integer("solver.workLimit", limit);
        }
    };
    for (belts, limit) in [(2000, 20_000_000), (45, 1000)] {
        let refused = refusal(by_cells(belts, limit));
        for word in ["solver.workLimit", "planetLight.belts", &limit.to_string()] {
            assert!(refused.contains(word), "{refused}");
        }
    }
    let mut fmu = Disturbance::messenger();
    by_cells(45, 20_000_000)(&mut fmu);
    fmu.start();
}

#[test]
fn without_a_planet_only_sunlight_is_left() {
    let mut fmu = Disturbance::messenger();
    let present = fmu.at("planet.present");
    assert_eq!(fmu.fmu.set_boolean(&[present], &[0]), Status::Ok);
    fmu.put_vector("planet.positionBody", [0.0; 3]);
    fmu.start();
    assert_eq!(fmu.step(), Status::Ok);
    for name in ["force.albedo", "force.infrared", "torque.gravityGradient"] {
        assert_eq!(fmu.vector(name), [0.0; 3]);
    }
    assert!(fmu.vector("force.solar")[1] > 0.0 && fmu.vector("force.thermal")[1] > 0.0);
}

#[test]
fn the_shipped_setup_reads() {
    assert!(DisturbanceTorque::parse_setup("spacecraft.toml", DisturbanceTorque::DEFAULT_SETUP).is_ok());
}

#[test]
fn the_scale_of_sunlight_is_one_of_its_force_and_not_of_its_heat() {
    let read = |fmu: &mut Disturbance, name: &str| Vector3::from(fmu.vector(name));
    let mut fmu = Disturbance::messenger();
    fmu.put_boolean("thermal.enabled", true);
    fmu.put_boolean("planetLight.enabled", true);
    fmu.start();
    let names = [
        "force.solar",
        "force.albedo",
        "force.infrared",
        "force.thermal",
        "torque.gravityGradient",
        "force.total",
    ];
    let loads = |fmu: &mut Disturbance| names.map(|name| read(fmu, name));
    let slope = |fmu: &mut Disturbance| {
        let [sun, output] = [fmu.at("sun.positionBody[2]"), fmu.at("force.solar[2]")];
        fmu.slopes(&[output], &[sun], &[1.0])[0]
    };
    let (once, slope_once) = (loads(&mut fmu), slope(&mut fmu));
    fmu.put("solar.scale", 2.0);
    // What was computed stays until the step.
    assert_eq!((loads(&mut fmu), slope(&mut fmu)), (once, slope_once));
    assert_eq!(fmu.step(), Status::Ok);
    let (twice, slope_twice) = (loads(&mut fmu), slope(&mut fmu));
    assert!(once[..4].iter().all(|force| force.norm() > 0.0) && slope_once != 0.0);
    assert_eq!((twice[0], slope_twice), (once[0] * 2.0, slope_once * 2.0));
    assert_eq!(twice[1..5], once[1..5]);
    assert!((twice[5] - once[5] - once[0]).norm() < 1e-12 * once[0].norm(), "{twice:?} {once:?}");
}

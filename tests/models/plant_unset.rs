//! Zero on every input, as masters send it before the first exchange: nothing acts, the attitude is held, one warning.

use models::{DisturbanceTorque, MomentumPlant};
use nalgebra::Vector3;

use super::named_model::{NamedInstance, NamedModel};

/// Everything from inputs.
const FED: &[(&str, f64)] = &[
    ("attitude.source", 2.0),
    ("orbit.source", 2.0),
    ("ephemeris.source", 3.0),
    ("planetLight.enabled", 1.0),
    ("thermal.enabled", 1.0),
    ("start.q[1]", 0.6),
    ("start.q[4]", 0.8),
    ("start.momentum[2]", 1.5),
];

const CONNECTED: &[(&str, f64)] = &[
    ("orbit.position[1]", 1.2e7),
    ("orbit.velocity[2]", 1_500.0),
    ("orbit.velocity[3]", 300.0),
    ("sun.position[1]", -3e10),
    ("sun.position[2]", 4e10),
    ("earth.position[2]", 1.1e11),
];

fn zero<'h>(named: &'h NamedModel<MomentumPlant>, options: &[(&'h str, f64)]) -> Vec<(&'h str, f64)> {
    options.iter().copied().chain(named.inputs().into_iter().map(|name| (name, 0.0))).collect()
}

fn connect(flight: &mut NamedInstance<'_, MomentumPlant>) {
    for (name, value) in CONNECTED {
        flight.set(name, *value);
    }
}

#[test]
fn zero_on_every_input_holds_the_attitude_and_nothing_acts() {
    let named = NamedModel::<MomentumPlant>::shipped();
    for dynamics in [1.0, 2.0] {
        let options = [FED, &[("orbit.dynamics", dynamics)]].concat();
        let before = named.warnings().len();
        let mut flight = named.initialize(0.0, &zero(&named, &options)).unwrap();
        for time_s in [60.0, 600.0, 90_000.0] {
            flight.step_to(time_s).unwrap();
            assert_eq!(flight.not_finite(), None);
            for name in ["torque.total", "force.total", "sun.direction", "position"] {
                assert_eq!(flight.vector(name), Vector3::zeros(), "{name}");
            }
            assert!((flight.vector("attitude.q") - Vector3::new(0.6, 0.0, 0.0)).norm() < 1e-15);
            assert_eq!(flight.vector("momentum.body"), Vector3::new(0.0, 1.5, 0.0));
        }
        let warnings = named.warnings()[before..].to_vec();
        assert_eq!(warnings.len(), 1, "{warnings:?}");
        for name in ["orbit.position", "orbit.velocity", "sun.position", "command.kind"] {
            assert!(warnings[0].contains(name), "{warnings:?}");
        }
        // The first values that are not zero start the flight: the same as one that has them from the start.
        connect(&mut flight);
        let mut restored = flight.restored();
        flight.step_to(91_000.0).unwrap();
        restored.step_to(91_000.0).unwrap();
        super::named_model::assert_same(&flight, &restored);
        assert!(flight.vector("torque.total").norm() > 1e-8);
        let epoch_s = flight.real("start.epoch") + 90_000.0;
        let known = [&zero(&named, &options)[..], CONNECTED, &[("start.epoch", epoch_s)]].concat();
        let mut known = named.initialize(90_000.0, &known).unwrap();
        known.step_to(91_000.0).unwrap();
        for name in ["torque.total", "momentum.body", "sun.positionBody", "position", "deltaV"] {
            let (a, b) = (flight.vector(name), known.vector(name));
            assert!((a - b).norm() <= 1e-9 * b.norm(), "{name}: {a} {b}");
        }
        assert_eq!(named.warnings().len(), before + 2, "the second flight has no command either");
    }
}

#[test]
fn a_quaternion_of_zero_is_no_command_yet() {
    let named = NamedModel::<MomentumPlant>::shipped();
    for (kind, quaternion) in [(1.0, "command.q"), (2.0, "command.error")] {
        let sets = [
            ("attitude.source", 2.0),
            ("start.q[1]", 0.6),
            ("start.q[4]", 0.8),
            ("command.kind", kind),
            ("command.q[4]", 0.0),
            ("command.error[4]", 0.0),
            ("command.rate[1]", 1e-3),
        ];
        let before = named.warnings().len();
        let mut flight = named.initialize(0.0, &sets).unwrap();
        flight.step_to(100.0).unwrap();
        assert!((flight.real("attitude.q[1]") - 0.6).abs() < 1e-15);
        assert!(flight.vector("torque.solar").norm() > 0.0, "the Sun is known");
        flight.set(&format!("{quaternion}[4]"), 1.0);
        flight.step_to(101.0).unwrap();
        let turned_rad = if kind == 1.0 { 1e-3 } else { 2.0 * 0.6_f64.asin() + 1e-3 };
        assert!((flight.real("attitude.q[1]") - (0.5 * turned_rad).sin()).abs() < 1e-14);
        let warnings = named.warnings()[before..].to_vec();
        assert!(warnings.len() == 1 && warnings[0].contains(quaternion), "{warnings:?}");
    }
}

#[test]
fn a_sun_that_goes_back_to_zero_is_named() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let mut flight = named.initialize(0.0, &[FED, CONNECTED].concat()).unwrap();
    flight.step_to(60.0).unwrap();
    flight.set("sun.position[1]", 0.0);
    flight.set("sun.position[2]", 0.0);
    let text = flight.step_to(120.0).unwrap_err().to_string();
    assert!(text.contains("sun.position is not set") && text.contains("ephemeris.source"), "{text}");
}

#[test]
fn the_memoryless_model_takes_zero_on_every_input() {
    let named = NamedModel::<DisturbanceTorque>::shipped();
    let zero: Vec<(&str, f64)> = named.inputs().into_iter().map(|name| (name, 0.0)).collect();
    for method in [1.0, 2.0] {
        let before = named.warnings().len();
        let options = [("planetLight.method", method)];
        let mut model = named.initialize(0.0, &[&zero[..], &options].concat()).unwrap();
        model.step_to(1.0).unwrap();
        model.step_to(2.0).unwrap();
        assert_eq!(model.not_finite(), None);
        assert_eq!(model.vector("torque.total"), Vector3::zeros());
        assert_eq!(model.vector("force.total"), Vector3::zeros());
        assert_eq!(named.warnings().len(), before + 1);
        // The Sun alone: sunlight and heat, no planet.
        model.set("sun.positionBody[2]", -5e10);
        model.step_to(3.0).unwrap();
        assert_eq!(model.not_finite(), None);
        assert!(model.vector("force.solar").norm() > 0.0 && model.real("sun.litFraction") == 1.0);
        assert_eq!(model.vector("force.infrared"), Vector3::zeros());
        model.set("planet.positionBody[3]", 9e6);
        model.step_to(4.0).unwrap();
        assert!(model.vector("force.infrared").norm() > 0.0);
        assert_eq!(named.warnings().len(), before + 1);
    }
}

#[test]
fn sun_and_planet_in_the_body_frame_are_the_inputs_of_the_memoryless_model() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let sets = [("planetLight.enabled", 1.0), ("solar.flux", 1365.0), ("gravityGradient.enabled", 1.0)];
    let mut flight = named.initialize(0.0, &sets).unwrap();
    let text = <MomentumPlant as fmi_export::Model>::DEFAULT_SETUP;
    let memoryless = NamedModel::<DisturbanceTorque>::with("messenger.toml", text);
    for time_s in [100.0, 9_000.0, 20_000.0] {
        flight.step_to(time_s).unwrap();
        let mut inputs = vec![("planetLight.enabled".to_owned(), 1.0), ("solar.flux".to_owned(), 1365.0)];
        for name in ["sun.positionBody", "planet.positionBody"] {
            let at = flight.vector(name);
            inputs.extend((0..3).map(|i| (format!("{name}[{}]", i + 1), at[i])));
        }
        for k in 1..=2 {
            inputs.push((format!("panel[{k}].angle"), flight.real(&format!("panel[{k}].angleActual"))));
        }
        let inputs: Vec<(&str, f64)> = inputs.iter().map(|(name, value)| (name.as_str(), *value)).collect();
        let alone = memoryless.initialize(0.0, &inputs).unwrap();
        for (name, within) in
            [("torque.solar", 1e-12), ("torque.gravityGradient", 1e-12), ("force.infrared", 1e-4)]
        {
            let (a, b) = (flight.vector(name), alone.vector(name));
            assert!((a - b).norm() <= within * b.norm(), "{name} at {time_s}: {a} {b}");
        }
    }
    let sun = [("orbit.center", 2.0), ("orbit.semiMajorAxis", 6e10), ("orbit.eccentricity", 0.1)];
    let mut about_the_sun = named.initialize(0.0, &sun).unwrap();
    about_the_sun.step_to(60.0).unwrap();
    assert_eq!(about_the_sun.vector("planet.positionBody"), Vector3::zeros());
    let distance_m = about_the_sun.vector("sun.positionBody").norm();
    assert!((distance_m / about_the_sun.real("sun.distance") - 1.0).abs() < 1e-14);
}

//! The set of values that the importer gave belongs to the state: it is saved, restored and reset with the values, to the bit.

use client::{InProcess, Names, StatePointer};
use fmi_export::Status;
use model_description::{Causality, VariableKind};

use crate::scenarios::{Scenario, Simulation};
use crate::support::{SHIPPED, description, fresh, names, ok};

const MODEL: &str = "MomentumPlant";
const VENUS: i32 = 3;
/// Eccentricity of the start values, which are about Mercury.
const ECCENTRICITY: f64 = 0.74;
const SEMI_MAJOR_AXIS_M: f64 = 6e7;

fn real(instance: &mut InProcess, names: &Names, name: &str) -> f64 {
    let mut value = [f64::NAN];
    ok(instance.get_real(&[names.find(name).unwrap()], &mut value));
    value[0]
}

fn distance_m(instance: &mut InProcess, names: &Names) -> f64 {
    (1..=3).map(|axis| real(instance, names, &format!("position[{axis}]")).powi(2)).sum::<f64>().sqrt()
}

/// About Venus on an ellipse whose eccentricity is set to its start value.
fn set(instance: &mut InProcess, names: &Names) {
    ok(instance.set_integer(&[names.find("orbit.center").unwrap()], &[VENUS]));
    ok(instance.set_real(&[names.find("orbit.semiMajorAxis").unwrap()], &[SEMI_MAJOR_AXIS_M]));
    ok(instance.set_real(&[names.find("orbit.eccentricity").unwrap()], &[ECCENTRICITY]));
}

fn bytes(instance: &mut InProcess) -> Vec<u8> {
    let mut state = StatePointer::null();
    ok(instance.get_state(&mut state));
    let (status, bytes) = instance.serialize(&state);
    ok(status);
    bytes
}

fn restored(bytes: &[u8]) -> InProcess {
    let mut instance = fresh(MODEL);
    let (status, state) = instance.deserialize(bytes);
    ok(status);
    ok(instance.set_state(&state));
    instance
}

#[test]
fn what_was_set_is_saved_and_restored_to_the_bit() {
    let names = names(MODEL);
    let mut here = fresh(MODEL);
    set(&mut here, &names);
    let before_the_start = bytes(&mut here);
    let mut there = restored(&before_the_start);
    for instance in [&mut here, &mut there] {
        ok(instance.start(0.0, None));
        // From periapsis; the circle that Venus' own eccentricity is would begin at the axis itself.
        let expected_m = SEMI_MAJOR_AXIS_M * (1.0 - ECCENTRICITY);
        assert!((distance_m(instance, &names) / expected_m - 1.0).abs() < 1e-12);
        ok(instance.do_step(0.0, 600.0));
    }
    let simulated = bytes(&mut here);
    assert_eq!(simulated, bytes(&mut there));
    // On from a state of the flight, in memory and from bytes.
    let mut state = StatePointer::null();
    ok(here.get_state(&mut state));
    ok(here.do_step(600.0, 600.0));
    let once = bytes(&mut here);
    ok(here.set_state(&state));
    assert_eq!(bytes(&mut here), simulated);
    ok(here.do_step(600.0, 600.0));
    assert_eq!(bytes(&mut here), once);
    let mut elsewhere = restored(&simulated);
    ok(elsewhere.do_step(600.0, 600.0));
    assert_eq!(bytes(&mut elsewhere), once);
    // A reset forgets it.
    ok(here.reset());
    ok(here.set_integer(&[names.find("orbit.center").unwrap()], &[VENUS]));
    ok(here.set_real(&[names.find("orbit.semiMajorAxis").unwrap()], &[SEMI_MAJOR_AXIS_M]));
    ok(here.start(0.0, None));
    assert!((distance_m(&mut here, &names) / SEMI_MAJOR_AXIS_M - 1.0).abs() < 1e-12);
}

/// Reading outputs in between changes nothing: what follows the centre is settled once initialization ends.
#[test]
fn parameters_that_follow_read_back_once_initialized() {
    let names = names(MODEL);
    let radius = names.find("planet.radius").unwrap();
    for reads in [false, true] {
        let mut instance = fresh(MODEL);
        ok(instance.set_integer(&[names.find("orbit.center").unwrap()], &[4]));
        ok(instance.setup_experiment(0.0, None));
        ok(instance.enter_initialization_mode());
        if reads {
            distance_m(&mut instance, &names);
        }
        ok(instance.set_integer(&[names.find("orbit.center").unwrap()], &[VENUS]));
        ok(instance.exit_initialization_mode());
        // Radius by the IAU, 2015.
        assert_eq!(real(&mut instance, &names, "planet.radius"), 6_051.8e3);
        assert_eq!(real(&mut instance, &names, "orbit.semiMajorAxis"), 3.0 * 6_051.8e3);
        assert_eq!(instance.set_real(&[radius], &[1.0]), Status::Error);
    }
}

/// Every input and parameter without a closer limit says 1e100 either way, discards what is beyond it, and a state that was
/// written is read whatever was set within.
#[test]
fn what_may_be_set_can_be_saved() {
    for model in SHIPPED {
        let description = description(model);
        let (mut refused, mut saved) = (0, 0);
        for variable in &description.variables {
            let is_given = matches!(variable.causality, Causality::Input | Causality::Parameter);
            let VariableKind::Real { attributes, .. } = &variable.kind else { continue };
            if !is_given {
                continue;
            }
            let limits = [attributes.min, attributes.max].map(|limit| limit.unwrap_or(f64::NAN));
            assert!(limits.iter().all(|limit| limit.abs() <= 1e100), "{model} {} {limits:?}", variable.name);
            // One element stands for its array, and for all panels, wheels and thrusters.
            if variable.name.contains(['2', '3', '4', '5', '6', '7', '8', '9']) {
                continue;
            }
            let reference = [variable.value_reference];
            let mut instance = fresh(model);
            assert_eq!(
                instance.set_real(&reference, &[limits[1].next_up()]),
                Status::Discard,
                "{}",
                variable.name
            );
            ok(instance.set_real(&reference, &limits[1..]));
            if instance.start(0.0, None) != Status::Ok || instance.do_step(0.0, 10.0) != Status::Ok {
                refused += 1;
                continue;
            }
            let mut state = StatePointer::null();
            ok(instance.get_state(&mut state));
            let (status, bytes) = instance.serialize(&state);
            if status == Status::Ok {
                let (status, _state) = fresh(model).deserialize(&bytes);
                assert_eq!(status, Status::Ok, "{model} {} = {:?}", variable.name, limits[1]);
                saved += 1;
            }
        }
        assert!(saved > refused, "{model}: {saved} saved, {refused} refused");
    }
}

/// Angles and shares that cannot be anything else say so, and keep to it in every scenario.
#[test]
fn outputs_keep_within_the_limits_they_state() {
    for scenario in Scenario::ALL {
        let description = description(scenario.model());
        let limited: Vec<_> = description
            .variables
            .iter()
            .filter(|variable| variable.causality == Causality::Output)
            .filter_map(|variable| match &variable.kind {
                VariableKind::Real { attributes, .. } => Some((variable, attributes.min?, attributes.max?)),
                _ => None,
            })
            .collect();
        if ["MomentumPlant", "Guidance", "SpinPlant"].contains(&scenario.model()) {
            assert!(limited.len() >= 4, "{}", scenario.model());
        }
        let mut simulation = Simulation::new(scenario);
        for _ in 0..200 {
            simulation.step();
            for (variable, min, max) in &limited {
                let mut value = [f64::NAN];
                ok(simulation.instance.get_real(&[variable.value_reference], &mut value));
                assert!((*min..=*max).contains(&value[0]), "{} = {:?}", variable.name, value[0]);
            }
        }
    }
}

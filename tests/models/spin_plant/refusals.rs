//! SpinPlant refuses by name what cannot be simulated.

use fmi_export::Status;
use models::SpinPlant;

use super::driver::{Spinner, assert_names};
use crate::named_model::NamedModel;

#[test]
fn what_cannot_be_simulated_is_refused_by_name() {
    assert_names(
        &Spinner::new().set_integer("burn.thruster", 11).refusal(),
        &["burn.thruster", "11", "1 to 10"],
    );
    assert_names(
        &Spinner::new().set("burn.pulseWidth", 6.1).refusal(),
        &["burn.pulseWidth", "6.1", "half a turn"],
    );
    assert_names(&Spinner::new().set("inertia[3]", 700.0).refusal(), &["inertia[3]", "triangle"]);
    assert_names(
        &Spinner::new().set("burn.turnsPerPulse", 0.5).set_integer("burn.oppositeThruster", 0).refusal(),
        &["0.5 turns", "opposite"],
    );
    assert_names(
        &Spinner::new().set("burn.angle", 0.0349).set("burn.maxDuration", 600.0).refusal(),
        &["does not fit its limits", "duration", "burn.maxDuration"],
    );
    assert_names(
        &Spinner::new().set("burn.angle", 0.0349).set("burn.maxNutation", 1e-5).refusal(),
        &["does not fit its limits", "nutation", "burn.maxNutation"],
    );
    assert_names(
        &Spinner::new().set_text("burn.group", "rocket").refusal(),
        &["burn.group", "rocket", "spin up"],
    );
    // What no spinner has is refused where it is set, and the instance lives.
    let mut spinner = Spinner::new();
    for (name, value) in [
        ("burn.pulseWidth", -0.5),
        ("burn.pulseWidth", f64::NAN),
        ("inertia[1]", -1.0),
        ("spin.initialRate", 1e5),
        ("limit.spinRate", 1e9),
    ] {
        let at = spinner.at(name);
        let _ = spinner.fmu.drain_messages();
        assert_eq!(spinner.fmu.set_real(&[at], &[value]), Status::Discard, "{name} = {value}");
        let text: String = spinner.fmu.drain_messages().into_iter().map(|message| message.text).collect();
        assert_names(&text, &[name]);
    }
    spinner.start().to(1.0);
}

/// A step of 1 s that must fail: what the instance says. After Reset it is simulated as ever.
fn failed_step(mut spinner: Spinner) -> String {
    let _ = spinner.fmu.drain_messages();
    assert_eq!(spinner.try_step(1.0), Status::Error);
    let text = spinner.fmu.drain_messages().into_iter().map(|message| message.text).collect();
    assert_eq!(spinner.fmu.reset(), Status::Ok);
    spinner.time_s = 0.0;
    let mut spinner = spinner.start();
    spinner.to(10.0);
    assert!(spinner.outputs().iter().all(|value| value.is_finite()));
    text
}

#[test]
fn a_torque_that_no_body_bears_fails_the_first_step_it_acts_in() {
    let sudden =
        failed_step(Spinner::new().set("torque.applied[1]", 1e100).set_integer("burn.plan", 4).start());
    assert_names(&sudden, &["at 0 s", "1e100 N m", "torque.applied", "1e4 rad/s"]);
    // Slowly enough to be followed, but beyond the limit within the step: 353.82 kg m2 turn at 2e4 rad/s after 1 s.
    let fast = failed_step(Spinner::new().set("torque.applied[3]", 7.1e6).start());
    assert_names(&fast, &["rad/s; allowed", "1e4 rad/s", "torque.applied"]);
    // A thruster does not hide it, nor do slopes.
    let mut spinner = Spinner::new().set("torque.applied[2]", -1e100).set_integer("burn.plan", 4).start();
    spinner.fire(8, true);
    assert_names(&failed_step(spinner), &["1e100 N m", "torque.applied"]);
    let mut spinner = Spinner::new().set_integer("burn.plan", 4).start();
    let reference = spinner.at("torque.applied[1]");
    assert_eq!(spinner.fmu.set_input_derivatives(&[reference], &[1], &[1e100]), Status::Ok);
    assert_names(&failed_step(spinner), &["torque.applied"]);
}

/// Every row a master could read while the torque grows tenfold from flight to flight is finite.
#[test]
fn no_step_that_went_well_leaves_a_number_that_is_none() {
    for exponent in 0..100 {
        let torque_n_m = 10.0_f64.powi(exponent);
        let mut spinner =
            Spinner::new().set("torque.applied[1]", torque_n_m).set("torque.applied[3]", torque_n_m).start();
        for i in 0..5 {
            if spinner.fmu.do_step(0.5 * f64::from(i), 0.5) != Status::Ok {
                break;
            }
            let outputs = spinner.outputs();
            assert!(outputs.iter().all(|value| value.is_finite()), "{torque_n_m} N m: {outputs:?}");
        }
    }
}

#[test]
fn a_direction_too_short_or_too_long_is_refused_where_it_is_used() {
    let with = |name: &str, value: f64, orbit: bool| {
        let source = if orbit { 2 } else { 1 };
        let mut spinner = Spinner::new().set_integer("geometry.source", source);
        for axis in 1..=3 {
            spinner.put(&format!("{name}[{axis}]"), value);
        }
        spinner
    };
    for name in ["sun.direction", "earth.direction", "star.direction"] {
        assert_names(&with(name, 1e-120, false).refusal(), &[name, "1e-120", "length"]);
        assert_names(&with(name, 1e100, false).refusal(), &[name, "1e100", "length"]);
        // In flight as well, by value and by slope.
        let mut spinner = Spinner::new().start();
        (1..=3).for_each(|axis| spinner.put(&format!("{name}[{axis}]"), 1e-120));
        assert_names(&failed_step(spinner), &[name, "1e-120"]);
        let mut spinner = Spinner::new().start();
        let references = [1, 2, 3].map(|axis| spinner.at(&format!("{name}[{axis}]")));
        // Longer than 1e100 after a second, by the root of 3.
        assert_eq!(spinner.fmu.set_input_derivatives(&references, &[1; 3], &[1e100; 3]), Status::Ok);
        assert_names(&failed_step(spinner), &[name]);
    }
    // The L1 orbit has Sun and Earth of its own.
    for name in ["sun.direction", "earth.direction"] {
        with(name, 1e-120, true).start().to(10.0);
    }
    assert_names(&with("star.direction", 1e-120, true).refusal(), &["star.direction"]);
}

#[test]
fn a_tank_that_no_pulse_can_empty_is_refused() {
    let named = NamedModel::<SpinPlant>::shipped();
    let on_board_kg = 123.456;
    let mut flight =
        named.initialize(0.0, &[("burn.plan", 4.0), ("propellant.loaded", on_board_kg)]).unwrap();
    flight.set("thruster[8].fire", 1.0);
    flight.step_to(3.0).unwrap();
    let state = flight.state_bytes();
    let genuine = on_board_kg.to_le_bytes();
    let places: Vec<usize> = (0..state.len() - 8).filter(|&at| state[at..at + 8] == genuine).collect();
    assert!(!places.is_empty(), "the state does not hold what is on board");
    assert!(flight.with_state(&state).is_some());
    let with = |on_board_kg: f64| {
        let mut torn = state.clone();
        for at in &places {
            torn[*at..at + 8].copy_from_slice(&on_board_kg.to_le_bytes());
        }
        flight.with_state(&torn)
    };
    for wrong_kg in [f64::NAN, -1.0, 195.001, f64::INFINITY] {
        assert!(with(wrong_kg).is_none(), "{wrong_kg}");
    }
    // Less than the pulse has used by now is no number too many: it is subtracted when the pulse ends, and ends it at once.
    let mut empty = with(0.0).unwrap();
    empty.step_to(5.0).unwrap();
    assert_eq!(empty.real("propellant.used"), 0.0);
}

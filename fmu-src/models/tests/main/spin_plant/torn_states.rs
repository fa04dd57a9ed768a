//! States whose numbers do not belong together are refused before they can keep the step busy for ever.

use std::time::Instant;

use models::SpinPlant;

use crate::named_model::NamedModel;

#[test]
fn a_tank_that_no_pulse_can_empty_is_refused() {
    let named = NamedModel::<SpinPlant>::shipped();
    let on_board_kg = 123.456;
    let mut flight = named.fly(0.0, &[("burn.plan", 4.0), ("propellant.loaded", on_board_kg)]).unwrap();
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
    // Less than the pulse has used by now is no number too many: it is booked when the pulse ends, and ends it at once.
    let mut empty = with(0.0).unwrap();
    empty.step_to(5.0).unwrap();
    assert_eq!(empty.real("propellant.used"), 0.0);
}

/// Wherever a number may stand in a state, one that is none or no flight's is put there: the state is refused, or the step
/// fails, or every output is a finite number; and none takes long.
#[test]
fn a_forged_number_anywhere_is_refused_or_leaves_finite_outputs() {
    let named = NamedModel::<SpinPlant>::shipped();
    // By closed form in the midst of a train; by cells under a torque with a pulse on, on the L1 orbit with the clock.
    let cases: [(&[(&str, f64)], f64); 2] = [
        (&[("burn.timing", 2.0), ("solver.workLimit", 50_000.0)], 50.0),
        (
            &[
                ("burn.timing", 3.0),
                ("inertia[1]", 230.0),
                ("geometry.source", 2.0),
                ("starTracker.sampling", 2.0),
                ("burn.pulseWidth", 2.0),
                ("burn.count", 10.0),
                ("solver.workLimit", 50_000.0),
            ],
            10.22,
        ),
    ];
    let forged = [f64::NAN, f64::INFINITY, -1e308, 1e200, 1e-308, 0.0, -1.0];
    let (mut refused, mut failed, mut simulated, mut wrong) = (0, 0, 0, Vec::new());
    for (sets, at_s) in cases {
        let mut flight = named.fly(0.0, sets).unwrap();
        flight.step_to(at_s).unwrap();
        let state = flight.state_bytes();
        for at in 0..state.len() - 8 {
            for value in forged {
                let mut torn = state.clone();
                torn[at..at + 8].copy_from_slice(&value.to_le_bytes());
                let Some(mut other) = flight.with_state(&torn) else {
                    refused += 1;
                    continue;
                };
                let begun = Instant::now();
                for end_s in [at_s + 0.5, at_s + 30.0] {
                    if other.step_to(end_s).is_err() {
                        failed += 1;
                        break;
                    }
                    if let Some(name) = other.not_finite() {
                        wrong.push(format!("{value:e} at {at}: {name}"));
                    }
                    simulated += 1;
                }
                assert!(begun.elapsed().as_secs_f64() < 10.0, "{value:e} at {at}");
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
    println!("{refused} refused, {failed} failed, {simulated} steps flown");
    assert!(refused > 1_000 && simulated > 1_000, "{refused} {failed} {simulated}");
}

//! States whose numbers do not belong together are refused before they can keep the step busy for ever.

use models::SpinPlant;

use crate::pilot::Hangar;

#[test]
fn a_tank_that_no_pulse_can_empty_is_refused() {
    let hangar = Hangar::<SpinPlant>::shipped();
    let on_board_kg = 123.456;
    let mut flight = hangar.fly(0.0, &[("burn.plan", 4.0), ("propellant.initial", on_board_kg)]).unwrap();
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

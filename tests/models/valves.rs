//! One law of valves for both spacecraft: how long a valve is open, from the propellant that left.

use fmi_export::Model;
use models::{MomentumPlant, SpinPlant};

use super::named_model::{NamedInstance, NamedModel};
use super::spacecraft::{EXHAUST_M_S, SIMPLE, thruster};

/// Command of one step: its length, delay and time of the pulse, in s.
type Commanded = [f64; 3];

/// Commands, the time for which the valve is open, in s, and whether each step's pulse does not open it.
struct ValveCase {
    commanded: Vec<Commanded>,
    open_s: f64,
    too_short: Vec<bool>,
    pulses: i32,
}

impl ValveCase {
    fn new(commanded: &[Commanded], open_s: f64, too_short: &[bool], pulses: i32) -> Self {
        Self { commanded: commanded.to_vec(), open_s, too_short: too_short.to_vec(), pulses }
    }
}

/// With a shortest time of half a second; the times open are worked out by hand.
fn cases() -> Vec<ValveCase> {
    let many = |step_s: f64, count: usize| vec![[step_s, 0.0, step_s]; count];
    let mut cases = vec![
        // Inside a step, and just long enough.
        ValveCase::new(&[[1.0, 0.2, 0.6]], 0.6, &[false], 1),
        ValveCase::new(&[[1.0, 0.2, 0.5]], 0.5, &[false], 1),
        // Too short inside a step, and beyond it.
        ValveCase::new(&[[1.0, 0.2, 0.3]], 0.0, &[true], 0),
        ValveCase::new(&[[1.0, 1.2, 0.8]], 0.0, &[true], 0),
        // Cut at the step's end, after more than the shortest time and before.
        ValveCase::new(&[[1.0, 0.4, 1.0]], 0.6, &[false], 1),
        ValveCase::new(&[[1.0, 0.99, 0.5]], 0.5, &[false], 1),
        // Too short, but up to the step's end.
        ValveCase::new(&[[1.0, 0.8, 0.2]], 0.5, &[false], 1),
        // One step shorter than the shortest time, and three of them in a row with a pulse each.
        ValveCase::new(&[[0.1, 0.0, 0.1]], 0.5, &[false], 1),
        ValveCase::new(&[[0.1, 0.0, 0.1]; 3], 0.5, &[false; 3], 1),
        // Still open where the next step begins: what it asks for from there joins on, what is too short on its own does not.
        ValveCase::new(&[[1.0, 0.9, 0.1], [1.0, 0.0, 0.7]], 0.8, &[false; 2], 1),
        ValveCase::new(&[[1.0, 0.9, 0.1], [1.0, 0.0, 0.01]], 0.5, &[false; 2], 1),
        ValveCase::new(&[[1.0, 0.0, 1.0], [1.0, 0.0, 0.01]], 1.01, &[false; 2], 1),
        ValveCase::new(&[[1.0, 0.9, 0.1], [1.0, 0.1, 0.35]], 0.5, &[false, true], 1),
        ValveCase::new(&[[1.0, 0.9, 0.1], [1.0, 0.1, 0.6]], 0.8, &[false; 2], 1),
        ValveCase::new(&[[1.0, 0.9, 0.1], [1.0, 0.45, 0.5]], 1.0, &[false; 2], 2),
        // Every second step, each shorter than the shortest time.
        ValveCase::new(&[[0.4, 0.1, 0.3], [0.4, 0.0, 0.0], [0.4, 0.1, 0.3]], 1.0, &[false; 3], 2),
    ];
    // One pulse of 1.5 s, in steps of any length.
    for (step_s, count) in [(1.5, 1), (0.75, 2), (0.5, 3), (0.3, 5), (0.1, 15), (0.05, 30), (0.01, 150)] {
        cases.push(ValveCase::new(&many(step_s, count), 1.5, &vec![false; count], 1));
    }
    cases
}

/// Simulates a case from `start_s` on; what was open, by the propellant, in s.
fn open_s<M: Model>(
    flight: &mut NamedInstance<'_, M>,
    case: &ValveCase,
    start_s: f64,
    flow_kg_s: f64,
) -> f64 {
    let mut time_s = start_s;
    for ([step_s, delay_s, on_s], too_short) in case.commanded.iter().zip(&case.too_short) {
        flight.set("thruster[1].onDelay", *delay_s);
        flight.set("thruster[1].onTime", *on_s);
        time_s += step_s;
        flight.step_to(time_s).unwrap();
        assert_eq!(flight.boolean("thruster[1].tooShort"), *too_short, "{:?}", case.commanded);
    }
    flight.set("thruster[1].onTime", 0.0);
    for step_s in [0.13, 0.4, 1.0] {
        time_s += step_s;
        flight.step_to(time_s).unwrap();
    }
    assert!(!flight.boolean("thruster[1].tooShort"));
    flight.real("propellant.used") / flow_kg_s
}

#[test]
fn valves_of_the_three_axis_plant_open_by_the_law() {
    let text = format!("{SIMPLE}{}", thruster([0.0, 0.1, 0.0], [0.0, 0.0, 1.0], 5.0, ""));
    let named = NamedModel::<MomentumPlant>::with("simple.toml", &text);
    let sets = [
        ("attitude.source", 4.0),
        ("solar.flux", 0.0),
        ("gravityGradient.enabled", 0.0),
        ("dump.threshold[1]", 1e9),
        ("dump.threshold[2]", 1e9),
        ("dump.threshold[3]", 1e9),
        ("thruster[1].minOnTime", 0.5),
    ];
    for start_s in [0.0, 1234.5] {
        for case in cases() {
            let mut flight = named.initialize(start_s, &sets).unwrap();
            let open_s = open_s(&mut flight, &case, start_s, 5.0 / EXHAUST_M_S);
            assert!((open_s - case.open_s).abs() < 1e-9, "{:?}: {open_s} {}", case.commanded, case.open_s);
            assert_eq!(flight.integer("thruster[1].pulses"), case.pulses, "{:?}", case.commanded);
        }
    }
}

#[test]
fn valves_of_the_spinner_open_by_the_law() {
    let named = NamedModel::<SpinPlant>::shipped();
    let sets = [("burn.plan", 4.0), ("pulse.resolution", 0.0), ("thruster[1].minOnTime", 0.5)];
    for start_s in [0.0, 1234.5] {
        for case in cases() {
            let mut flight = named.initialize(start_s, &sets).unwrap();
            let open_s = open_s(&mut flight, &case, start_s, 4.448 / EXHAUST_M_S);
            assert!((open_s - case.open_s).abs() < 1e-9, "{:?}: {open_s} {}", case.commanded, case.open_s);
        }
    }
}

/// A pulse that scatters is one pulse, however many steps it continues through.
#[test]
fn a_pulse_over_many_steps_of_the_spinner_scatters_once() {
    let named = NamedModel::<SpinPlant>::shipped();
    let sets = [("burn.plan", 4.0), ("pulse.resolution", 0.0), ("thruster[1].scatter", 0.1)];
    let used_kg = |step_s: f64, count: usize| {
        let case = ValveCase::new(&vec![[step_s, 0.0, step_s]; count], 0.0, &vec![false; count], 1);
        open_s(&mut named.initialize(0.0, &sets).unwrap(), &case, 0.0, 1.0)
    };
    let whole_kg = used_kg(1.5, 1);
    for (step_s, count) in [(0.75, 2), (0.1, 15), (0.01, 150)] {
        assert!((used_kg(step_s, count) / whole_kg - 1.0).abs() < 1e-9, "{step_s}");
    }
    let nominal_kg = 1.5 * 4.448 / EXHAUST_M_S;
    assert!((whole_kg / nominal_kg - 1.0).abs() > 1e-3, "{whole_kg} {nominal_kg}");
}

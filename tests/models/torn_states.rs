//! A state in which numbers do not belong together, or stand for nothing, is refused, or the step fails, or every output is a
//! finite number; and none keeps the step busy.

use std::time::{Duration, Instant};

use client::short_or_long;
use fmi_export::Model;
use models::{Guidance, MomentumPlant, SpinPlant};

use super::guidance::{CUT, PLACED};
use super::named_model::NamedModel;
use super::plant_light::{BUSY, EFFECTS, SHADOWED};
use super::plant_work::busy;
use super::random::RandomNumbers;
use super::restored_states::SPINNER_BY_CELLS;
use super::spacecraft::{RADIATING, SIMPLE};

/// Largest duration of a step, in time that its thread computed.
const LONGEST: Duration = Duration::from_secs(1);

const FORGED: [f64; 14] = [
    f64::NAN,
    f64::INFINITY,
    f64::NEG_INFINITY,
    f64::MAX,
    -1e308,
    1e200,
    1e99,
    1e20,
    4e4,
    1e-9,
    1e-308,
    5e-324,
    0.0,
    -1.0,
];

/// Numbers that are put everywhere: the first three in the tests' short extent.
const EXTREME: &[f64] = &[f64::NAN, 1e200, -1.0, f64::INFINITY, -1e308, 1e-308, 0.0];

/// One of these numbers wherever one may stand.
fn everywhere(state: &[u8], forged: &[f64]) -> Vec<Vec<u8>> {
    let at = |place: usize, number: f64| {
        let mut torn = state.to_vec();
        torn[place..place + 8].copy_from_slice(&number.to_le_bytes());
        torn
    };
    (0..state.len() - 8).flat_map(|place| forged.iter().map(move |number| at(place, *number))).collect()
}

/// States torn at random by a number, some bytes or a bit.
fn scattered(state: &[u8], count: usize) -> Vec<Vec<u8>> {
    let mut random = RandomNumbers(1);
    let mut tear = || {
        let mut torn = state.to_vec();
        match random.below(3) {
            0 => {
                (0..=random.below(3)).for_each(|_| torn[random.below(state.len())] = random.below(256) as u8)
            }
            1 => torn[random.below(state.len())] ^= 1 << random.below(8),
            _ => {
                let number = FORGED[random.below(FORGED.len())].to_le_bytes();
                torn.iter_mut().skip(random.below(state.len())).zip(number).for_each(|(to, from)| *to = from);
            }
        }
        torn
    };
    (0..count).map(|_| tear()).collect()
}

/// Continues from what `tear` makes of the state at `at_s` to `ends_s`; some are refused or fail, some continue.
fn goes_on_or_fails<M: Model>(
    named: &NamedModel<M>,
    sets: &[(&str, f64)],
    at_s: f64,
    ends_s: &[f64],
    tear: impl Fn(&[u8]) -> Vec<Vec<u8>>,
) {
    let mut flight = named.initialize(0.0, sets).unwrap();
    flight.simulate_to(at_s, 500.0).unwrap();
    let state = flight.state_bytes();
    let (mut refused, mut simulated) = (0, 0);
    for torn in tear(&state) {
        let Some(mut other) = flight.with_state(&torn) else {
            refused += 1;
            continue;
        };
        let changed = || -> Vec<(usize, u8)> {
            (0..state.len()).filter(|at| state[*at] != torn[*at]).map(|at| (at, torn[at])).collect()
        };
        let begun = Instant::now();
        let before = busy(begun);
        for end_s in ends_s {
            if other.step_to(*end_s).is_err() {
                refused += 1;
                break;
            }
            assert_eq!(other.not_finite(), None, "{:?}", changed());
            simulated += 1;
        }
        let took = busy(begun).saturating_sub(before);
        assert!(took < LONGEST, "{took:?}: {:?}", changed());
    }
    assert!(refused > 20 && simulated > 10, "{refused} {simulated}");
}

/// Largest memory that a torn state may ask for in vain; a sound one needs less.
const LIMIT: (&str, f64) = ("solver.workLimit", 2e4);

#[test]
fn a_plant_in_light_and_heat() {
    let named = NamedModel::<MomentumPlant>::with("radiating.toml", RADIATING);
    for feedback in [0.0, 1.0] {
        let sets = [EFFECTS, SHADOWED, BUSY, &[("orbit.radiationFeedback", feedback), LIMIT]].concat();
        goes_on_or_fails(&named, &sets, 5_000.0, &[5_060.0], |state| {
            scattered(state, short_or_long(250, 700))
        });
    }
    let orbiter = include_str!("../../fmu-src/resources/examples/mercury-orbiter.toml");
    let named = NamedModel::<MomentumPlant>::with("mercury-orbiter.toml", orbiter);
    let sets = [&EFFECTS[..2], &[("orbit.dynamics", 2.0), LIMIT]].concat();
    goes_on_or_fails(&named, &sets, 1_000.0, &[2_000.0], |state| scattered(state, short_or_long(500, 1500)));
}

#[test]
fn a_controlled_plant() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let sets = [("attitude.source", 3.0), LIMIT];
    goes_on_or_fails(&named, &sets, 1.0, &[1.03], |state| scattered(state, short_or_long(400, 1000)));
}

#[test]
fn a_guidance() {
    let named = NamedModel::<Guidance>::shipped();
    let forged = short_or_long(&EXTREME[..3], &EXTREME[..6]);
    for case in CUT {
        let sets = [PLACED, case].concat();
        goes_on_or_fails(&named, &sets, 20.5, &[23.0], |state| everywhere(state, forged));
    }
}

/// By closed form in the midst of a train; by cells under a torque with a pulse on, on the L1 orbit with the clock.
#[test]
fn a_spinner() {
    let named = NamedModel::<SpinPlant>::shipped();
    let forged = short_or_long(&EXTREME[..3], EXTREME);
    let cells: Vec<_> = SPINNER_BY_CELLS.into_iter().chain([LIMIT]).collect();
    for (sets, at_s) in [(&[("burn.timing", 2.0), LIMIT][..], 50.0), (&cells[..], 50.0), (&cells[..], 10.22)]
    {
        let ends_s = [at_s + 0.5, at_s + 30.0];
        goes_on_or_fails(&named, sets, at_s, &ends_s, |state| scattered(state, short_or_long(500, 1500)));
        if at_s != 50.0 || sets.len() < 3 {
            goes_on_or_fails(&named, sets, at_s, &ends_s, |state| everywhere(state, forged));
        }
    }
}

/// The state of a flight of each spacecraft, given to each other one: what does not fit the spacecraft is refused before anything
/// else is read, what fits continues or fails.
#[test]
fn states_of_other_spacecraft() {
    // Thrusters, tanks, wheels, modes and pendulums.
    let files = [
        ("messenger.toml", MomentumPlant::DEFAULT_SETUP, [0, 0, 4, 0]),
        ("messenger-full.toml", include_str!("../../fmu-src/resources/messenger-full.toml"), [17, 2, 4, 0]),
        (
            "flexible-craft.toml",
            include_str!("../../fmu-src/resources/examples/flexible-craft.toml"),
            [0, 0, 4, 3],
        ),
        ("cubesat-12u.toml", include_str!("../../fmu-src/resources/examples/cubesat-12u.toml"), [0, 0, 4, 0]),
        (
            "mercury-orbiter.toml",
            include_str!("../../fmu-src/resources/examples/mercury-orbiter.toml"),
            [0, 0, 0, 0],
        ),
        ("simple.toml", SIMPLE, [0, 1, 0, 0]),
    ];
    for source in [1.0, 4.0] {
        let sets = [("attitude.source", source), LIMIT];
        let models = files.map(|(file, text, _)| NamedModel::<MomentumPlant>::with(file, text));
        let mut flights = models.each_ref().map(|named| named.initialize(0.0, &sets).unwrap());
        for flight in &mut flights {
            flight.step_to(1.25).unwrap();
        }
        let (mut refused, mut taken) = (0, 0);
        for (from, (file, _, counts)) in flights.iter().zip(files) {
            let bytes = from.state_bytes();
            for (to, (other, _, other_counts)) in flights.iter().zip(files) {
                let Some(mut flight) = to.with_state(&bytes) else {
                    assert_ne!(file, other);
                    refused += 1;
                    continue;
                };
                let fits = counts[..2] == other_counts[..2] && (source < 3.0 || counts == other_counts);
                assert!(fits, "{source}: {file} taken by {other}");
                taken += 1;
                if flight.step_to(2.0).is_ok() {
                    assert_eq!(flight.not_finite(), None, "{source}: {file} taken by {other}");
                }
            }
        }
        assert!(refused > 10 && taken > 6, "{source}: {refused} refused, {taken} taken");
    }
}

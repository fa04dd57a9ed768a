//! How a master cuts its steps, and whether it saves and restores in between, changes no bit of any output.

use models::Guidance;

use super::super::named_model::{NamedModel, assert_same};
use super::{Flight, PLACED, with};

/// A scan; the monitor at work in Safe Hold; windows of the orbit phase with slews; a burn that times out; downlinks that put
/// the Sun elsewhere, of the scenario and of the orbit phase; science that unloads.
const CASES: [&[(&str, f64)]; 7] = [
    &[
        ("pointing.scenario", 2.0),
        ("aimpoint.option", 7.0),
        ("scan.frame", 2.0),
        ("scan.rate[1]", 1e-3),
        ("scan.rate[3]", -2e-4),
        ("scan.duration[1]", 3.3),
        ("scan.duration[3]", 50.0),
        ("scan.reverse[1]", 1.0),
    ],
    &[
        ("pointing.scenario", 3.0),
        ("monitor.persistence", 7.0),
        ("monitor.margin", 0.0),
        ("estimate.q[1]", 0.6),
        ("estimate.q[4]", 0.8),
        ("sun.sensed[1]", 0.3),
        ("sun.sensed[2]", 1.0),
        ("sun.sensedValid", 1.0),
    ],
    &[
        ("pointing.scenario", 10.0),
        ("guided.downlinkEvery", 1.0),
        ("guided.downlinkStart", 10.0),
        ("guided.slewRate", 1e-3),
    ],
    &[
        ("pointing.scenario", 9.0),
        ("keepIn.enabled", 0.0),
        ("hotPole.enabled", 0.0),
        ("burn.profile[1,1]", 1.0),
        ("burn.profile[2,2]", 1.0),
        ("burn.profile[3,3]", 0.5),
        ("burn.acceleration", 0.01),
        ("burn.start", 3.3),
        ("burn.timeout", 60.7),
        ("accelerometer.deltaV[2]", 0.3),
    ],
    &[
        ("pointing.scenario", 6.0),
        ("keepIn.azimuth", 0.3),
        ("keepIn.elevation", 0.3),
        ("momentum.strategy", 2.0),
        ("momentum.body[1]", 0.3),
        ("momentum.body[3]", -0.4),
        ("dump.threshold[3]", 0.2),
        ("estimate.q[1]", 0.6),
        ("estimate.q[4]", 0.8),
        ("monitor.enabled", 0.0),
    ],
    &[
        ("pointing.scenario", 10.0),
        ("guided.downlinkReference", 2.0),
        ("guided.downlinkStart", 33.3),
        ("guided.downlinkEnd", 9_000.0),
        ("guided.slewRate", 1e-3),
        ("momentum.strategy", 2.0),
        ("momentum.convention", 2.0),
        ("momentum.body[1]", 0.3),
        ("momentum.body[3]", -0.4),
        ("monitor.enabled", 0.0),
    ],
    &[
        ("pointing.scenario", 10.0),
        ("guided.downlinkReference", 2.0),
        ("guided.downlinkStart", 33.3),
        ("guided.downlinkEnd", 90.0),
        ("guided.slewRate", 1e-3),
        ("guided.scienceUnload", 1.0),
        ("momentum.strategy", 2.0),
        ("momentum.body[1]", 1e-4),
        ("momentum.body[3]", -1e-4),
        ("monitor.enabled", 0.0),
    ],
];

/// What `assert_same` leaves out: outputs that change at samples only.
fn discrete(flight: &Flight<'_>) -> Vec<u64> {
    let names = [
        "command.rate[1]",
        "command.rate[2]",
        "command.error[1]",
        "mdis.angle",
        "earth.sunSeparation",
        "dump.target[3]",
    ];
    let bits = names.map(|name| flight.real(name).to_bits());
    let items = ["command.kind", "mode.active", "antenna.select"].map(|name| flight.integer(name) as u64);
    [&bits[..], &items[..]].concat()
}

#[test]
fn the_cut_changes_no_bit() {
    let named = NamedModel::<Guidance>::shipped();
    for case in CASES {
        for start_s in [0.0, -800.25, 1e9] {
            let sets = with(&[PLACED, case]);
            let fly = || named.fly(start_s, &sets).unwrap();
            let mut whole = fly();
            let mut cut: Vec<Flight<'_>> = [0.1, 0.3, 7.0, 60.0].map(|_| fly()).into();
            let ends_s = [60.0, 61.5, 180.0].map(|length_s| start_s + length_s);
            for end_s in ends_s {
                whole.step_to(end_s).unwrap();
                for (flight, step_s) in cut.iter_mut().zip([0.1, 0.3, 7.0, 60.0]) {
                    // Accumulated, as masters do.
                    while flight.time_s() + step_s < end_s {
                        flight.step_to(flight.time_s() + step_s).unwrap();
                    }
                    if flight.time_s() < end_s {
                        flight.step_to(end_s).unwrap();
                    }
                    assert_same(&whole, flight);
                    assert_eq!(discrete(&whole), discrete(flight), "{step_s} s to {end_s} s");
                }
            }
        }
    }
}

#[test]
fn a_restored_flight_goes_on_to_the_bit() {
    let named = NamedModel::<Guidance>::shipped();
    for case in CASES {
        let mut whole = named.fly(0.0, &with(&[PLACED, case])).unwrap();
        let mut relay = named.fly(0.0, &with(&[PLACED, case])).unwrap();
        for number in 1..100 {
            let end_s = f64::from(number) * 1.7;
            whole.step_to(end_s).unwrap();
            relay = relay.restored();
            relay.step_to(end_s).unwrap();
            assert_same(&whole, &relay);
            assert_eq!(discrete(&whole), discrete(&relay));
        }
    }
}

/// Wherever a number may stand in a state, one that is none or no flight's is put there: the state is refused, or the step
/// leaves finite outputs.
#[test]
fn a_forged_number_anywhere_is_refused_or_leaves_finite_outputs() {
    let named = NamedModel::<Guidance>::shipped();
    let (mut refused, mut simulated) = (0, 0);
    for case in CASES {
        let mut flight = named.fly(0.0, &with(&[PLACED, case])).unwrap();
        flight.step_to(20.5).unwrap();
        let state = flight.state_bytes();
        for at in 0..state.len() - 8 {
            for forged in [f64::NAN, f64::INFINITY, -1e308, 1e200, 1e-308, -1.0] {
                let mut torn = state.clone();
                torn[at..at + 8].copy_from_slice(&forged.to_le_bytes());
                let Some(mut other) = flight.with_state(&torn) else {
                    refused += 1;
                    continue;
                };
                if other.step_to(23.0).is_ok() {
                    simulated += 1;
                    assert_eq!(other.not_finite(), None, "{forged} at {at}");
                }
            }
        }
    }
    assert!(refused > 100 && simulated > 10, "{refused} {simulated}");
}

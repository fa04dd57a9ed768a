//! Zero on every input, as masters send it before the first exchange, and any other numbers within their limits.

use models::Guidance;
use nalgebra::Vector3;

use super::super::named_model::NamedModel;
use super::super::random::RandomNumbers;
use super::{PLACED, with};

#[test]
fn zero_on_every_input_holds_the_attitude_with_one_warning() {
    let named = NamedModel::<Guidance>::shipped();
    for source in [1.0, 2.0, 3.0] {
        let options = [("ephemeris.source", source), ("start.q[1]", 0.6), ("start.q[4]", 0.8)];
        let zero: Vec<_> =
            options.into_iter().chain(named.inputs().into_iter().map(|name| (name, 0.0))).collect();
        let before = named.warnings().len();
        let mut flight = named.initialize(0.0, &zero).unwrap();
        // In initialization masters look before they have connected everything.
        assert_eq!(named.warnings().len(), before);
        for end_s in [1.0, 2.5, 60.0] {
            flight.step_to(end_s).unwrap();
            assert_eq!(flight.not_finite(), None);
            // An estimate that is all zero and not valid is not connected while the spacecraft is not placed.
            assert_eq!(flight.integer("mode.active"), 1);
            assert_eq!(flight.integer("command.kind"), 0);
            assert_eq!(flight.quaternion("command.q"), [0.6, 0.0, 0.0, 0.8]);
            assert_eq!(flight.vector("command.rate"), Vector3::zeros());
        }
        let warnings = named.warnings()[before..].to_vec();
        assert_eq!(warnings.len(), 1, "{warnings:?}");
        assert!(warnings[0].contains("position"), "{warnings:?}");
    }
}

#[test]
fn the_first_values_start_the_command_and_bodies_that_are_missing_hold_it() {
    let named = NamedModel::<Guidance>::shipped();
    let nadir = [("pointing.scenario", 3.0)];
    let whole = named.initialize(0.0, &with(&[PLACED, &nadir])).unwrap();
    for missing in ["position", "sun.position", "earth.position"] {
        let zero: Vec<_> = (1..=3).map(|i| format!("{missing}[{i}]")).collect();
        let unset: Vec<_> = zero.iter().map(|name| (name.as_str(), 0.0)).collect();
        let mut flight = named.initialize(0.0, &with(&[PLACED, &nadir, &unset])).unwrap();
        flight.step_to(1.0).unwrap();
        assert_eq!(flight.integer("command.kind"), 0, "{missing}");
        for (name, value) in PLACED.iter().filter(|(name, _)| name.starts_with(missing)) {
            flight.set(name, *value);
        }
        flight.step_to(2.0).unwrap();
        assert_eq!(flight.integer("command.kind"), 1, "{missing}");
        flight.step_to(2.0 + 1e-9).unwrap();
        let (found, expected) = (flight.quaternion("command.q"), whole.quaternion("command.q"));
        let along: f64 = found.iter().zip(expected).map(|(a, b)| a * b).sum();
        assert!((along.abs() - 1.0).abs() < 1e-12, "{missing}: {found:?} {expected:?}");
    }
}

/// A value of a variable within its limits, in any size.
fn drawn(random: &mut RandomNumbers, limits: (f64, f64), whole: bool) -> f64 {
    let (low, high) = limits;
    if whole {
        return random.whole(low.max(-1e9) as i32, high.min(1e9) as i32);
    }
    let sign = if random.next() < 0.5 { -1.0 } else { 1.0 };
    let free = sign * 10.0_f64.powf(random.between(-6.0, 13.0));
    let any = match random.whole(0, 5) as i32 {
        0 => 0.0,
        1 => low.max(-1e20),
        2 => high.min(1e20),
        3 if low > -1e20 && high < 1e20 => random.between(low, high),
        _ => free,
    };
    any.clamp(low, high)
}

#[test]
fn any_inputs_within_their_limits_leave_finite_outputs() {
    let named = NamedModel::<Guidance>::shipped();
    let mut random = RandomNumbers(3);
    let given = named.given();
    let inputs = named.inputs();
    let (mut simulated, mut refused, mut degenerate) = (0, 0, 0);
    while simulated < 10_000 {
        let mut sets = with(&[PLACED]);
        // Left out: what has to go together, and the theory of the planets, which costs most.
        let tied = ["start.", "ephemeris.source", "guided.downlink"];
        let parameters = given.iter().filter(|(name, ..)| {
            !inputs.contains(name) && !tied.iter().any(|beginning| name.starts_with(beginning))
        });
        let parameters: Vec<_> = parameters.collect();
        for _ in 0..8 {
            let (name, limits, whole) = parameters[random.whole(0, parameters.len() as i32 - 1) as usize];
            sets.push((name, drawn(&mut random, *limits, *whole)));
        }
        let Ok(mut flight) = named.initialize(0.0, &sets) else {
            refused += 1;
            continue;
        };
        for number in 1..=50 {
            for _ in 0..12 {
                let at = random.whole(0, given.len() as i32 - 1) as usize;
                let (name, limits, whole) = given[at];
                if inputs.contains(&name) && !name.ends_with(".body") && !name.starts_with("estimate.q") {
                    flight.set(name, drawn(&mut random, limits, whole));
                }
            }
            let q = [0; 4].map(|_| random.between(-0.6, 0.6));
            let norm = q.iter().map(|x| x * x).sum::<f64>().sqrt();
            (0..4).for_each(|i| flight.set(&format!("estimate.q[{}]", i + 1), q[i] / norm));
            if flight.step_to(f64::from(number) * 1.3).is_err() {
                refused += 1;
                break;
            }
            assert_eq!(flight.not_finite(), None, "{sets:?}");
            let norm: f64 = flight.quaternion("command.q").iter().map(|x| x * x).sum();
            assert!((norm - 1.0).abs() < 1e-9, "{norm}");
            degenerate += flight.boolean("geometry.degenerate") as usize;
            simulated += 1;
        }
    }
    assert!(refused < 100 && degenerate > 100, "{refused} refused, {degenerate} degenerate");
}

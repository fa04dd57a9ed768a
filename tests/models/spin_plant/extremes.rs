//! Every step of every legal flight is answered in bounded time, with finite outputs or an error that names what to do.

use std::time::Instant;

use models::SpinPlant;

use super::driver::assert_names;
use crate::named_model::NamedModel;
use crate::plant_work::busy;
use crate::random::RandomNumbers;

/// How many flights; more by HELIOTORQUE_FLIGHTS.
fn flights() -> u64 {
    std::env::var("HELIOTORQUE_FLIGHTS").ok().and_then(|count| count.parse().ok()).unwrap_or(150)
}

#[test]
fn every_step_of_a_legal_flight_is_answered() {
    let named = NamedModel::<SpinPlant>::shipped();
    let given = named.given();
    let (mut refused, mut well, mut failed, mut slowest) = (0, 0, 0, (0.0, String::new()));
    for number in 0..flights() {
        let mut random = RandomNumbers(number.wrapping_mul(0x9E37_79B9_7F4A_7C15) + 1);
        // A tenth of what a millisecond may cost shows the same as the default does.
        let limit = if std::env::var_os("HELIOTORQUE_FLIGHTS").is_some() { 1e6 } else { 5e4 };
        let mut sets: Vec<(&str, f64)> = Vec::new();
        for _ in 0..1 + random.below(6) {
            let (name, limits, whole) = given[random.below(given.len())];
            sets.push((name, random.legal(limits, whole)));
        }
        sets.push(("solver.workLimit", limit));
        let mut keep = |begun: Instant, what: &str| {
            let took_s = begun.elapsed().as_secs_f64();
            if took_s > slowest.0 {
                slowest = (took_s, format!("flight {number}, {what}: {sets:?}"));
            }
            assert!(took_s < 20.0, "flight {number}, {what} took {took_s} s: {sets:?}");
        };
        let begun = Instant::now();
        let started = named.initialize(0.0, &sets);
        keep(begun, "initialization");
        let Ok(mut flight) = started else {
            refused += 1;
            continue;
        };
        for length_s in [1.0, 1e3, 1e6, 1e9, 1e12] {
            let begun = Instant::now();
            let answer = flight.step_to(flight.time_s() + length_s);
            keep(begun, &format!("a step of {length_s} s"));
            if let Err(failure) = answer {
                assert!(!failure.to_string().is_empty());
                failed += 1;
                break;
            }
            well += 1;
            assert_eq!(flight.not_finite(), None, "flight {number}: {sets:?}");
        }
    }
    println!("{refused} refused, {failed} failed, {well} steps went well; slowest {slowest:?}");
    assert!(well > 100 && failed > 20);
}

#[test]
fn the_longest_step_says_how_far_it_came_and_what_took_so_much() {
    let named = NamedModel::<SpinPlant>::shipped();
    // A tenth of the default.
    let mut flight = named.initialize(0.0, &[("solver.workLimit", 2e6)]).unwrap();
    let begun = Instant::now();
    let before = busy(begun);
    let text = flight.step_to(1e12).unwrap_err().to_string();
    let took_s = busy(begun).saturating_sub(before).as_secs_f64();
    println!("{took_s:.2} s: {text}");
    let parts =
        ["the step came to ", "solver.workLimit = 2000000", "crossings of Sun and star", "spin.initialRate"];
    assert_names(&text, &parts);
    // Of a step of the default 20 s are allowed.
    assert!(took_s < 6.0, "{took_s} s");
}

//! A step answers, whatever legal parameters and however long a step: its work is counted and bounded.

use std::time::{Duration, Instant};

use client::short_or_long;
use models::MomentumPlant;

use super::named_model::NamedModel;
use super::random::RandomNumbers;

/// Time this thread spent computing, so that a busy machine does not count; where that is not known, all time.
pub(crate) fn busy(since: Instant) -> Duration {
    let reported = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
    let spent_ns = reported.and_then(|text| text.split(' ').next().and_then(|word| word.parse().ok()));
    spent_ns.map_or(since.elapsed(), Duration::from_nanos)
}

const LIMIT: f64 = 100_000.0;
/// Largest time of a unit; by default a step then ends within 20 s.
const LONGEST_UNIT: Duration = Duration::from_nanos(2_000);
/// Preparing a flight, and the last thing a step did.
const OTHERWISE: Duration = Duration::from_millis(400);

/// Start values, a step in s, and words of the refusal.
type Requested<'a> = (&'a [(&'a str, f64)], f64, &'a [&'a str]);

fn requested(sets: &[(&str, f64)], step_s: f64) -> Result<f64, String> {
    let named = NamedModel::<MomentumPlant>::shipped();
    let mut flight = named.initialize(0.0, sets).map_err(|failure| failure.to_string())?;
    flight.step_to(step_s).map_err(|failure| failure.to_string())?;
    Ok(flight.time_s())
}

#[test]
fn what_asks_for_too_much_is_named_with_how_far_it_came() {
    let limit = ("solver.workLimit", LIMIT);
    let light = [("planetLight.enabled", 1.0), ("thermal.enabled", 1.0)];
    let cases: &[Requested] = &[
        (&[limit], 1e12, &["solver.workLimit = 100000", "solver.step"]),
        (&[limit, ("dump.threshold[1]", 1e-6), ("torque.applied[1]", 1e-6)], 1e9, &["dump.threshold"]),
        (&[limit, ("solver.step", 1e-3)], 1e6, &["solver.step"]),
        (&[limit, ("spacecraft.centerOfMass[1]", 1e4)], 1e9, &["dump.threshold", "spacecraft.centerOfMass"]),
        (&[limit, light[0], light[1], ("solver.disturbanceStep", 1e-3)], 1e6, &["solver.disturbanceStep"]),
        (&[limit, ("orbit.dynamics", 2.0), ("orbit.step", 1.0)], 1e7, &["orbit.step"]),
    ];
    for (sets, step_s, words) in cases {
        let text = requested(sets, *step_s).unwrap_err();
        assert!(words.iter().all(|word| text.contains(word)), "{sets:?}: {text}");
        assert!(text.contains("came to") && text.contains("shorter step"), "{text}");
    }
    // Enough for what it is requested, it comes to the end.
    assert_eq!(requested(&[limit], 86_400.0), Ok(86_400.0));
}

/// Light and heat of a controlled flight are paid from the same budget as its motion, and the message tells that budget.
#[test]
fn light_and_heat_of_a_controlled_flight_count() {
    let plain = [("attitude.source", 3.0), ("command.source", 2.0), ("solver.workLimit", 20_000.0)];
    let lit = [("planetLight.enabled", 1.0), ("thermal.enabled", 1.0), ("solver.disturbanceStep", 0.05)];
    assert_eq!(requested(&plain, 60.0), Ok(60.0));
    let text = requested(&[&plain[..], &lit[..]].concat(), 60.0).unwrap_err();
    for words in ["than the 20000 units", "solver.workLimit = 20000", "light and heat", "came to"] {
        assert!(text.contains(words), "{text}");
    }
}

/// The cost of a step does not depend on what its instance computed before.
#[test]
fn a_step_that_passed_passes_after_its_state_was_restored_elsewhere() {
    let orbiter = include_str!("../../fmu-src/resources/examples/mercury-orbiter.toml");
    let named = NamedModel::<MomentumPlant>::with("mercury-orbiter.toml", orbiter);
    let (mut passed, mut refused) = (0, 0);
    for (source, start_s, step_s) in [(1.0, 40_000.0, 1e6), (3.0, 20.0, 40.0)] {
        for limit in (0..24).map(|k| (1_000.0 * 1.4_f64.powi(k)).round()) {
            let sets = [("attitude.source", source), ("command.source", 2.0), ("solver.workLimit", limit)];
            let Ok(mut flight) = named.initialize(0.0, &sets) else { continue };
            if flight.simulate_to(start_s, start_s / 10.0).is_err() {
                continue;
            }
            let mut elsewhere = flight.with_state(&flight.state_bytes()).unwrap();
            let [here, there] = [&mut flight, &mut elsewhere]
                .map(|it| it.step_to(start_s + step_s).map_err(|e| e.to_string()));
            assert_eq!(here, there, "attitude.source {source}, solver.workLimit {limit}");
            *(if here.is_ok() { &mut passed } else { &mut refused }) += 1;
        }
    }
    assert!(passed > 4 && refused > 4, "{passed} {refused}");
}

#[test]
fn a_mercury_year_with_every_effect_is_far_within_the_default() {
    let orbiter = include_str!("../../fmu-src/resources/examples/mercury-orbiter.toml");
    let named = NamedModel::<MomentumPlant>::with("mercury-orbiter.toml", orbiter);
    let everything = [
        ("planetLight.enabled", 1.0),
        ("thermal.enabled", 1.0),
        ("shadowing.enabled", 1.0),
        ("orbit.dynamics", 2.0),
        ("guided.slewRate", 1e-3),
        // Half of the default for the whole year.
        ("solver.workLimit", short_or_long(0.1, 1.0) * 1e7),
    ];
    let mut flight = named.initialize(0.0, &everything).unwrap();
    flight.step_to(short_or_long(0.1, 1.0) * 87.969 * 86_400.0).unwrap();
    assert_eq!(flight.not_finite(), None);
}

/// Scattered options, parameters and inputs: how long the answer took, and what it was.
fn scattered(named: &NamedModel<MomentumPlant>, seed: u64, limit: f64) -> (Duration, String) {
    let mut random = RandomNumbers(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15));
    let given = named.given();
    let mut sets: Vec<(&str, f64)> = Vec::new();
    for (name, limits, whole) in &given {
        let is_option = *whole && limits.1 - limits.0 < 8.0;
        let chance = if is_option { 0.3 } else { 0.02 };
        if random.next() < chance {
            sets.push((name, random.legal(*limits, *whole)));
        }
    }
    sets.retain(|(name, _)| *name != "solver.workLimit");
    // Guided or commanded; the others are refused.
    let source = 1.0 + random.below(2) as f64;
    sets.extend([("attitude.source", source), ("solver.workLimit", limit)]);
    let step_s = [1.0, 1e3, 1e6, 1e9, 1e12][random.below(5)];
    let now = Instant::now();
    let before = busy(now);
    let answer = match named.initialize(0.0, &sets) {
        Err(failure) => failure.to_string(),
        Ok(mut flight) => match flight.step_to(step_s) {
            Err(failure) => failure.to_string(),
            Ok(()) => flight.not_finite().unwrap_or_else(|| "finite".to_owned()),
        },
    };
    (busy(now).saturating_sub(before), format!("{step_s:e} s with {sets:?}: {answer}"))
}

#[test]
fn any_legal_parameters_get_an_answer() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let trials = std::env::var("HELIOTORQUE_WORK_TRIALS")
        .ok()
        .and_then(|text| text.parse().ok())
        .unwrap_or(short_or_long(80, 200));
    let limit =
        std::env::var("HELIOTORQUE_WORK_LIMIT").ok().and_then(|text| text.parse().ok()).unwrap_or(LIMIT);
    let (mut simulated, mut exhausted, mut worst) = (0, 0, Duration::ZERO);
    for seed in 1..=trials {
        let (took, answer) = scattered(&named, seed, limit);
        let allowed = LONGEST_UNIT.mul_f64(limit) + OTHERWISE;
        assert!(took < allowed, "{took:?} where {allowed:?} is allowed, trial {seed}: {answer}");
        simulated += u32::from(answer.ends_with("finite"));
        exhausted += u32::from(answer.contains("solver.workLimit ="));
        worst = worst.max(took);
    }
    println!("{trials} trials: {simulated} simulated, {exhausted} out of work, the longest {worst:?}");
    assert!(simulated > 0 && exhausted > 0);
}

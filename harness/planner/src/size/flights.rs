//! Flights through the FMU: one without dumps for momentum by source, others by threshold and strategy for dumps.

use std::time::{Duration, Instant};

use fmi::{Recording, Value};
use inputs::variables::{NEVER_N_M_S, elements, numbers, vectors};
use nalgebra::Vector3;
use packing::instance::vector;
use physics::plant::LEAST_DUMP_THRESHOLD_N_M_S;

use super::sized::SizedSpacecraft;
use crate::{Failure, simulation::Flight};

/// Communication points of an orbit at least, and the longest step, in s.
const POINTS_OF_ORBIT: f64 = 48.0;
const LONGEST_STEP_S: f64 = 120.0;
/// Step of a flight whose dumps alone count, in s; one in which several fall is cut between them.
const STEP_OF_DUMPS_S: f64 = 21_600.0;
/// Rows that are kept of a flight at most.
const ROWS: f64 = 300_000.0;
/// Thresholds that are simulated whatever the time.
const MIN_THRESHOLDS: usize = 3;
/// Thresholds that are simulated, as shares of the file's: its own first, then outward.
const SCALES: [f64; 9] = [1.0, 2.0, 0.5, 1.41, 0.71, 4.0, 0.35, 2.83, 0.25];

/// Dumps of one flight, scaled to a year.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Dumped {
    pub strategy: &'static str,
    /// By body axis.
    pub threshold_n_m_s: Vector3<f64>,
    pub dumps: f64,
    /// Sum of the magnitudes, in N m s.
    pub impulse_n_m_s: f64,
    pub propellant_kg: f64,
}

/// Flights that were simulated, and the number that the time did not suffice for.
pub(super) struct Sweep {
    pub dumped: Vec<Dumped>,
    pub left_out: usize,
}

/// Momentum by source and in the body frame, without dumps, with these values beside the spacecraft's.
pub(super) fn undumped(
    sized: &SizedSpacecraft,
    others: &[(String, Value)],
    is_quiet: bool,
) -> Result<Recording, Failure> {
    let bar = terminal::progress(sized.span_s as u64, "s without dumps", is_quiet);
    let undumped = values(sized, Vector3::repeat(NEVER_N_M_S), "dumpsOnly")?;
    let sets = [undumped, others.to_vec()].concat();
    let outputs = ["momentum.*", "attitude.q", "attitude.rate", "torque.total"];
    let shown = |time_s: f64| bar.set_position((time_s - sized.simulation.start_s) as u64);
    let recording = simulated(sized, &sets, &outputs, Some(&shown));
    bar.finish_and_clear();
    recording
}

/// Dumps by threshold and strategy, as far as the time suffices; those of the first three thresholds in any case. Where no wheels
/// give a threshold, it is what they would need.
pub(super) fn sweep(
    sized: &SizedSpacecraft,
    (needed_n_m_s, budget_s): (f64, f64),
    is_quiet: bool,
) -> Result<Sweep, Failure> {
    let own_n_m_s = vector(&mut sized.started()?, "dump.threshold")?;
    let is_never = own_n_m_s.iter().all(|it| *it >= NEVER_N_M_S);
    let own_n_m_s = if is_never { Vector3::repeat(needed_n_m_s) } else { own_n_m_s };
    let scaled = |scale: f64| own_n_m_s.map(|it| scaled_n_m_s(it, scale));
    let until = Instant::now() + Duration::from_secs_f64(budget_s.clamp(0.0, 1e6));
    let strategies = sized.strategies;
    let cases = SCALES.iter().flat_map(|scale| strategies.iter().map(move |strategy| (*scale, *strategy)));
    let cases: Vec<_> = cases.collect();
    let bar = terminal::progress(cases.len() as u64, "flights", is_quiet);
    let mut sweep = Sweep { dumped: Vec::new(), left_out: 0 };
    for (index, (scale, strategy)) in cases.into_iter().enumerate() {
        if index >= MIN_THRESHOLDS * strategies.len() && Instant::now() >= until {
            sweep.left_out += 1;
            continue;
        }
        sweep.dumped.push(dumped(sized, scaled(scale), strategy)?);
        bar.inc(1);
    }
    bar.finish_and_clear();
    sweep.dumped.sort_by(|a, b| a.threshold_n_m_s.sum().total_cmp(&b.threshold_n_m_s.sum()));
    Ok(sweep)
}

fn dumped(
    sized: &SizedSpacecraft,
    threshold_n_m_s: Vector3<f64>,
    strategy: &'static str,
) -> Result<Dumped, Failure> {
    let outputs = ["dump.count", "dump.impulse", "propellant.used"];
    let simulated = simulated(sized, &values(sized, threshold_n_m_s, strategy)?, &outputs, None)?;
    let count = numbers(&simulated, "dump.count")?;
    let impulses_n_m_s = vectors(&simulated, "dump.impulse")?;
    let dumps = count.windows(2).enumerate().filter(|(_, pair)| pair[1] > pair[0]);
    let impulses_n_m_s = dumps.map(|(k, _)| impulses_n_m_s[k + 1].norm());
    let last = |values: &[f64]| values.last().copied().unwrap_or(0.0);
    Ok(Dumped {
        strategy,
        threshold_n_m_s,
        dumps: sized.per_year(last(&count)),
        impulse_n_m_s: sized.per_year(impulses_n_m_s.sum()),
        propellant_kg: sized.per_year(last(&numbers(&simulated, "propellant.used")?)),
    })
}

/// A share of a threshold within what may be set; none of one that is never reached.
fn scaled_n_m_s(threshold_n_m_s: f64, scale: f64) -> f64 {
    if threshold_n_m_s >= NEVER_N_M_S {
        threshold_n_m_s
    } else {
        (threshold_n_m_s * scale).max(LEAST_DUMP_THRESHOLD_N_M_S)
    }
}

/// A threshold and a strategy as values.
fn values(
    sized: &SizedSpacecraft,
    threshold_n_m_s: Vector3<f64>,
    strategy: &str,
) -> Result<Vec<(String, Value)>, Failure> {
    let mut sets: Vec<_> = elements("dump.threshold", threshold_n_m_s).collect();
    let strategy = format!("momentum.strategy={strategy}");
    sets.extend(fmi::parse_assignment(sized.simulation.fmu.description(), &strategy)?);
    Ok(sets)
}

/// One flight; every dump has a row of its own.
fn simulated(
    sized: &SizedSpacecraft,
    sets: &[(String, Value)],
    outputs: &[&str],
    progress: Option<&dyn Fn(f64)>,
) -> Result<Recording, Failure> {
    let dumps_apart = outputs.contains(&"dump.count");
    let step_s = if dumps_apart {
        STEP_OF_DUMPS_S
    } else {
        let longest_s = LONGEST_STEP_S.min(sized.period_s / POINTS_OF_ORBIT).max(sized.span_s / ROWS);
        // A whole number of steps between unloadings, so that rows end the windows.
        sized.every_s / (sized.every_s / longest_s).ceil()
    };
    let (step_s, stop_s) = (Some(step_s), Some(sized.simulation.start_s + sized.span_s));
    let flight = Flight { sets, outputs, step_s, at_s: None, stop_s, dumps_apart, progress };
    let flown = sized.simulation.fly(&flight)?;
    flown.ended?;
    Ok(flown.recording)
}

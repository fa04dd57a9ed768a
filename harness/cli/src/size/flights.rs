//! Flights through the FMU: one without dumps for momentum by source, others by threshold and strategy for dumps.

use std::{
    sync::atomic::AtomicBool,
    time::{Duration, Instant},
};

use loader::{Options, Recording};
use nalgebra::Vector3;

use super::sized::{Failure, SizedSpacecraft};
use crate::{
    instance::vector,
    interrupt,
    variables::{NEVER_N_M_S, elements, numbers, selected, vectors},
};

/// Communication points of an orbit at least, and the longest step, in s.
const POINTS_OF_ORBIT: f64 = 48.0;
const LONGEST_STEP_S: f64 = 120.0;
/// Step of a flight of which only dumps count, in s; one in which several fall is cut between them.
const STEP_OF_DUMPS_S: f64 = 21_600.0;
/// Rows that are kept of a flight at most.
const ROWS: f64 = 300_000.0;
/// Thresholds that are simulated, as shares of the file's: its own first, then outward.
const SCALES: [f64; 9] = [1.0, 2.0, 0.5, 1.41, 0.71, 4.0, 0.35, 2.83, 0.25];

/// Dumps of one flight, scaled to a year.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Dumped {
    pub strategy: String,
    /// By body axis.
    pub threshold_n_m_s: Vector3<f64>,
    pub dumps: f64,
    /// Sum of the magnitudes, in N m s.
    pub impulse_n_m_s: f64,
    pub propellant_kg: f64,
}

/// What was simulated, and what the time did not suffice for.
pub(super) struct Sweep {
    pub dumped: Vec<Dumped>,
    pub left_out: usize,
}

/// Momentum by source and in the body frame, without dumps.
pub(super) fn undumped(sized: &SizedSpacecraft, is_quiet: bool) -> Result<Recording, Failure> {
    let patterns = ["momentum.*", "attitude.q"].map(str::to_owned);
    let record = selected(sized.fmu.description(), &patterns, loader::select_outputs)?;
    let bar = terminal::progress(sized.span_s as u64, "s without dumps", is_quiet);
    let recording = simulated(sized, (Vector3::repeat(NEVER_N_M_S), "dumpsOnly"), record, &mut |time_s| {
        bar.set_position((time_s - sized.start_s) as u64);
    });
    bar.finish_and_clear();
    recording
}

/// Dumps by threshold and strategy, as far as the time suffices; those of the file's own threshold in any case.
pub(super) fn sweep(sized: &SizedSpacecraft, budget_s: f64, is_quiet: bool) -> Result<Sweep, Failure> {
    let own_n_m_s = vector(&mut sized.started()?, "dump.threshold")?;
    let until = Instant::now() + Duration::from_secs_f64(budget_s.clamp(0.0, 1e6));
    let cases =
        SCALES.iter().flat_map(|scale| sized.strategies.iter().map(move |strategy| (*scale, strategy)));
    let cases: Vec<_> = cases.collect();
    let bar = terminal::progress(cases.len() as u64, "flights", is_quiet);
    let mut sweep = Sweep { dumped: Vec::new(), left_out: 0 };
    for (index, (scale, strategy)) in cases.into_iter().enumerate() {
        if index >= sized.strategies.len() && Instant::now() >= until {
            sweep.left_out += 1;
            continue;
        }
        sweep.dumped.push(dumped(sized, own_n_m_s * scale, strategy)?);
        bar.inc(1);
    }
    bar.finish_and_clear();
    sweep.dumped.sort_by(|a, b| a.threshold_n_m_s.x.total_cmp(&b.threshold_n_m_s.x));
    Ok(sweep)
}

fn dumped(sized: &SizedSpacecraft, threshold_n_m_s: Vector3<f64>, strategy: &str) -> Result<Dumped, Failure> {
    let patterns = ["dump.count", "dump.impulse", "propellant.used"].map(str::to_owned);
    let record = selected(sized.fmu.description(), &patterns, loader::select_outputs)?;
    let simulated = simulated(sized, (threshold_n_m_s, strategy), record, &mut |_| {})?;
    let count = numbers(&simulated, "dump.count")?;
    let impulses_n_m_s = vectors(&simulated, "dump.impulse")?;
    let dumps = count.windows(2).enumerate().filter(|(_, pair)| pair[1] > pair[0]);
    let impulses_n_m_s = dumps.map(|(k, _)| impulses_n_m_s[k + 1].norm());
    let last = |values: &[f64]| values.last().copied().unwrap_or(0.0);
    Ok(Dumped {
        strategy: strategy.to_owned(),
        threshold_n_m_s,
        dumps: sized.per_year(last(&count)),
        impulse_n_m_s: sized.per_year(impulses_n_m_s.sum()),
        propellant_kg: sized.per_year(last(&numbers(&simulated, "propellant.used")?)),
    })
}

/// One flight; every dump has a row of its own.
fn simulated(
    sized: &SizedSpacecraft,
    (threshold_n_m_s, strategy): (Vector3<f64>, &str),
    record: Vec<usize>,
    progress: &mut dyn FnMut(f64),
) -> Result<Recording, Failure> {
    let description = sized.fmu.description();
    let mut sets = sized.sets.clone();
    sets.extend(elements("dump.threshold", threshold_n_m_s));
    sets.extend(loader::parse_assignment(description, &format!("momentum.strategy={strategy}"))?);
    let position = |name: &str| description.variables.iter().position(|variable| variable.name == name);
    let counts_dumps = record.iter().any(|at| Some(*at) == position("dump.count"));
    let step_s = if counts_dumps {
        STEP_OF_DUMPS_S
    } else {
        let longest_s = LONGEST_STEP_S.min(sized.period_s / POINTS_OF_ORBIT).max(sized.span_s / ROWS);
        // A whole number of steps between dumps, so that rows end the windows.
        sized.spacing_s / (sized.spacing_s / longest_s).ceil()
    };
    let cancel = AtomicBool::new(false);
    let mut reported = |time_s: f64| {
        cancel.store(interrupt::raised(), std::sync::atomic::Ordering::Relaxed);
        progress(time_s);
    };
    let options = Options {
        start_s: Some(sized.start_s),
        stop_s: Some(sized.start_s + sized.span_s),
        step_s: Some(step_s),
        sets,
        inputs: sized.inputs.as_ref(),
        record: Some(record),
        apart: position("dump.count").filter(|_| counts_dumps),
        progress: Some(&mut reported),
        cancel: Some(&cancel),
        ..Options::default()
    };
    Ok(loader::simulate(&sized.fmu, options)?.recording)
}

//! Runs repeated afresh at the end of a sweep: what an FMU keeps over a reset makes rows depend on their order.

use std::{
    fmt::Write as _,
    sync::{atomic::Ordering, mpsc},
    thread,
};

use fmi::csv::Real;
use isolation::interrupt;

use super::pool::{Attempt, Pool, RunResult};

/// Runs that are repeated at most, one a process.
const MAX_REPEATED: u64 = 4;

/// Runs whose kept results are compared with a simulation in a process of its own.
pub(super) struct Sample {
    runs: Vec<u64>,
    results: Vec<RunResult>,
}

impl Sample {
    /// Evenly spaced, the last one among them: as many as there are processes.
    pub(super) fn new(pool: &Pool<'_>) -> Self {
        let runs = &pool.runs;
        let count = runs.end - runs.start;
        let sampled = pool.workers.min(MAX_REPEATED).min(count);
        Self {
            runs: (1..=sampled).map(|k| runs.start + count * k / sampled - 1).collect(),
            results: Vec::new(),
        }
    }

    /// Takes a run that ended; one whose instance was not reset, or that failed, says nothing.
    pub(super) fn take(&mut self, result: &RunResult) {
        if result.was_reset && !result.status.has_failed() && self.runs.contains(&result.run) {
            self.results.push(result.clone());
        }
    }

    /// Repeats them and warns of what differs.
    ///
    /// # Errors
    /// A process that cannot be started.
    pub(super) fn warn(&self, pool: &Pool<'_>) -> Result<(), String> {
        let columns = pool.started.campaign.kept.columns(pool.started.described);
        let repeated = thread::scope(|scope| {
            let (sender, results) = mpsc::channel();
            let followed: Vec<_> = self
                .results
                .iter()
                .map(|it| {
                    let sender = sender.clone();
                    scope.spawn(move || pool.alone(it.run, Attempt::Afresh).follow(0, &sender))
                })
                .collect();
            drop(sender);
            let repeated: Vec<RunResult> = results.iter().collect();
            let outcomes = followed.into_iter().map(|it| it.join().unwrap_or(Ok(())));
            outcomes.fold(Ok(()), Result::and).map(|()| repeated)
        })?;
        if interrupt::raised() || pool.is_over.load(Ordering::Relaxed) {
            return Ok(());
        }
        let differences = repeated.iter().filter_map(|afresh| {
            let before = self.results.iter().find(|it| it.run == afresh.run)?;
            difference(before, afresh, &columns)
        });
        let mut differences: Vec<(u64, String)> = differences.collect();
        differences.sort();
        if let Some((run, what)) = differences.first() {
            let mut text = format!(
                "run {run}: {what} in a process of its own: what the FMU keeps over fmi2Reset, or draws anew, is in the rows, which depend on their order"
            );
            let _ = write!(text, "; found in {} of {} runs repeated", differences.len(), self.results.len());
            terminal::note(&text);
        }
        Ok(())
    }
}

/// The first number that differs, or how the run ended.
fn difference(before: &RunResult, afresh: &RunResult, columns: &[(String, usize)]) -> Option<(u64, String)> {
    if before.status != afresh.status {
        let [before_word, word] = [before, afresh].map(|it| it.status.word());
        return Some((before.run, format!("it ended as {before_word}, and as {word}")));
    }
    let mut pairs = before.numbers.iter().zip(&afresh.numbers).zip(columns);
    let is_other = |a: f64, b: f64| a != b && !(a.is_nan() && b.is_nan());
    let ((a, b), (name, _)) = pairs.find(|((a, b), _)| is_other(**a, **b))?;
    Some((before.run, format!("{name} is {}, and {}", Real(*a), Real(*b))))
}

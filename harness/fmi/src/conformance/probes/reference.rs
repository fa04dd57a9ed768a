//! The reference flights that an FMU carries, simulated again.

use crate::{
    conformance::findings::{Findings, Outcome},
    reference::{Replay, replays},
};

/// Deviating columns that are shown.
const SHOWN: usize = 5;

/// Simulates every reference flight.
pub(crate) fn flights(findings: &mut Findings<'_>) -> Outcome {
    match replays(findings.fmu) {
        Ok(Some(replays)) if !replays.is_empty() => {
            for replay in replays {
                match replay {
                    Ok(replay) => judge(findings, &replay),
                    Err(problem) => findings.bad(problem),
                }
            }
        }
        Ok(_) => findings.skipped("carries no reference flight"),
        Err(problem) => findings.bad(problem),
    }
    Ok(())
}

fn judge(findings: &mut Findings<'_>, replay: &Replay) {
    let Replay { source, rows, columns, tolerance, is_stated, foreign, .. } = replay;
    if let Some(first) = foreign.first() {
        let (count, all) = (foreign.len(), foreign.len() + columns);
        findings.note(format!(
            "{source}: {count} of {all} columns are no variables of this FMU and are left out, {first:?} the first; a table for FMUs \
             of several versions of FMI has such names"
        ));
    }
    if *columns == 0 {
        return;
    }
    let worst = match replay.deviations.first() {
        Some((_, worst)) => format!("the largest deviation {:.1e}", worst.fraction),
        None => "no deviation".to_owned(),
    };
    let stated = if *is_stated { "" } else { ", no tolerance is stated" };
    let failures: Vec<_> = replay.failures().collect();
    if failures.is_empty() {
        findings.good(format!(
            "{source}: {rows} rows of {columns} columns, {worst}, allowed: {tolerance:e}{stated}"
        ));
    }
    for (time_s, failure) in failures.iter().take(SHOWN) {
        findings.bad(format!(
            "{source}: {} at {time_s} s: found {}, allowed: {} within {tolerance:e} of the largest magnitude{stated}",
            failure.name, failure.found, failure.expected
        ));
    }
    if let Some(more) = failures.len().checked_sub(SHOWN).filter(|more| *more > 0) {
        findings.bad(format!("{source}: {more} more columns"));
    }
}

//! The reference flights that an FMU carries, simulated again.

use crate::Fmu;

use crate::conformance::{Finding, probe::Findings};

/// Deviating columns that are shown.
const SHOWN: usize = 5;

/// Simulates every reference flight.
pub(crate) fn flights(fmu: &Fmu) -> Findings {
    let replays = match crate::reference::replays(fmu) {
        Ok(Some(replays)) if !replays.is_empty() => replays,
        Ok(_) => {
            return Ok(vec![Finding::new(
                crate::conformance::Verdict::Skipped,
                "carries no reference flight",
            )]);
        }
        Err(problem) => return Ok(vec![Finding::bad(problem)]),
    };
    let mut findings = Vec::new();
    for replay in replays {
        let replay = match replay {
            Ok(replay) => replay,
            Err(problem) => {
                findings.push(Finding::bad(problem));
                continue;
            }
        };
        let crate::reference::Replay { source, rows, columns, tolerance, is_stated, foreign, .. } = &replay;
        if let Some(first) = foreign.first() {
            let (count, all) = (foreign.len(), foreign.len() + columns);
            findings.push(Finding::note(format!(
                "{source}: {count} of {all} columns are no variables of this FMU and are left out, {first:?} the first; a table for FMUs \
                 of several versions of FMI has such names"
            )));
        }
        if *columns == 0 {
            continue;
        }
        let worst = match replay.deviations.first() {
            Some((_, worst)) => format!("the largest deviation {:.1e}", worst.fraction),
            None => "no deviation".to_owned(),
        };
        let stated = if *is_stated { "" } else { ", no tolerance is stated" };
        let failures: Vec<_> = replay.failures().collect();
        if failures.is_empty() {
            findings.push(Finding::good(format!(
                "{source}: {rows} rows of {columns} columns, {worst}, allowed: {tolerance:e}{stated}"
            )));
        }
        for (time_s, failure) in failures.iter().take(SHOWN) {
            findings.push(Finding::bad(format!(
                "{source}: {} at {time_s} s: found {}, allowed: {} within {tolerance:e} of the largest magnitude{stated}",
                failure.name, failure.found, failure.expected
            )));
        }
        if let Some(more) = failures.len().checked_sub(SHOWN).filter(|more| *more > 0) {
            findings.push(Finding::bad(format!("{source}: {more} more columns")));
        }
    }
    Ok(findings)
}

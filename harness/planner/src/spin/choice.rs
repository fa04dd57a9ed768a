//! Choice of the plan: the best by the limits of the flags and of the spacecraft's file.

use physics::spin::spinner::Spinner;

use super::{
    PlanError, Task, TrainForecast,
    flight::simulated,
    limit_checks::{broken, check_limits},
};

/// Limits that a train breaks as it is simulated, and over the range where the plan knows it.
///
/// # Errors
/// A train that cannot be simulated.
pub(crate) fn broken_limits(
    spinner: &Spinner,
    task: &Task,
    row: &TrainForecast,
) -> Result<Vec<&'static str>, PlanError> {
    let flight = simulated(spinner, task, row)?;
    Ok(broken(&check_limits(spinner, task, row, &flight)))
}

/// Trains that keep the limits of the flags and break the fewest of the file, in the order of `rows`. The search ends with `most`
/// that break none.
///
/// # Errors
/// None that can be simulated.
pub(crate) fn by_all_limits<'a>(
    spinner: &Spinner,
    task: &Task,
    rows: &'a [TrainForecast],
    most: usize,
) -> Result<Vec<&'a TrainForecast>, PlanError> {
    let (mut simulated, mut failed, mut keeping) = (Vec::new(), None, 0);
    for row in rows.iter().filter(|row| row.fits) {
        match broken_limits(spinner, task, row) {
            Ok(broken) => {
                keeping += usize::from(broken.is_empty());
                simulated.push((broken.len(), row));
            }
            Err(error) => failed = failed.or(Some(error)),
        }
        if keeping == most {
            break;
        }
    }
    let fewest = simulated.iter().map(|(broken, _)| *broken).min();
    simulated.retain(|(broken, _)| Some(*broken) == fewest);
    match failed {
        Some(error) if simulated.is_empty() => Err(error),
        _ => Ok(simulated.into_iter().map(|(_, row)| row).collect()),
    }
}

//! Manoeuvres that would do what the plan does: approach manoeuvres with their errors, and a departure manoeuvre for what is left.

use inputs::plan::keys::Compare;
use nalgebra::Matrix2;

use crate::{
    Failure,
    flyby::{
        FlybyTask, Sensitivity,
        maneuvers::{ExecutionErrors, Miss, approach, departure},
        miss::MissCost,
        report::Compared,
    },
    plans::momentum::planned::Planned,
};

/// Refuses times of manoeuvres that the flight does not have, before anything is planned.
pub(super) fn check(planned: &Planned<'_>, flyby_task: &FlybyTask) -> Result<(), Failure> {
    let file = &planned.file;
    let Some(compare) = file.compare.as_ref().map(|at| &at.it) else { return Ok(()) };
    let encounter = &flyby_task.first.encounter;
    let next_s = planned.mission.time_in_file_s(file, &compare.next, compare.next.it)?;
    if next_s <= encounter.time_s + compare.departure_s {
        let what = "found a date before the departure manoeuvre, allowed: a later one";
        return Err(file.problem(&compare.next, what).into());
    }
    for at in &compare.approach_s {
        let at_s = encounter.time_s + at.it;
        if at_s < planned.mission.start_s || at_s >= encounter.epoch_s {
            let what = "found a time outside of the flight, allowed: between its start and the encounter";
            return Err(file.problem(at, what).into());
        }
    }
    Ok(())
}

/// Manoeuvres compared, by the tables of a plan.
pub(super) fn compared(
    compare: &Compare,
    (planned, flyby_task): (&Planned<'_>, &FlybyTask),
    after: &Sensitivity,
) -> Result<Compared, Failure> {
    let file = &planned.file;
    let arrival_s = flyby_task.first.encounter.time_s;
    let next_s = planned.mission.time_in_file_s(file, &compare.next, compare.next.it)?;
    let departure_s = arrival_s + compare.departure_s;
    let cost = MissCost::new(after, &flyby_task.force_model, [departure_s, next_s])?;
    let errors =
        ExecutionErrors { direction_rad: compare.direction_error_rad, magnitude: compare.magnitude_error };
    let of = |sensitivity: &Sensitivity| Miss {
        mean_m: flyby_task.aimpoint.miss(&sensitivity.encounter).xy(),
        covariance_m2: Matrix2::zeros(),
    };
    let mut miss = of(&flyby_task.first);
    let mut all = Vec::new();
    for at in &compare.approach_s {
        let at_s = arrival_s + at.it;
        let by_velocity = flyby_task.first.by_velocity(at_s).fixed_rows::<2>(0).into_owned();
        let Some(found) = approach(&miss, &by_velocity, &errors) else {
            let what = "found a time at which no velocity moves both components of B, allowed: another";
            return Err(file.problem(at, what).into());
        };
        miss = found.left;
        all.push((at_s, found));
    }
    let sizes = [of(&flyby_task.first), miss, of(after)].map(|miss| departure(&miss, &cost.by_miss_1_s).1);
    Ok(Compared { approach: all, departure_s, departure_m_s: sizes, cost })
}

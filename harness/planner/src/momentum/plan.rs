//! The optimal plan: fewest dumps, then fewest changes of the arrays, then least tilt, simulated and linearised again until both agree.
//!
//! Each round linearises the momentum about the present controls, solves, and simulates the answer through the FMU; what the flight gained
//! more than the model is added to the model of the next round, half of it where the last did not halve the difference. A round ends the
//! search where flight and plan differ by no more than [`AGREED`] of the limit and the flight stays below the limit. A plan holds where its
//! flight stays below the limit, however far both differ; the best of those flown is the answer, the mission as it is among them. Within a round the programme is solved again about its own answer
//! (sequential convex programming) with the range of the controls around it narrowed, for tilt, windmilling and alternation multiply.

use std::time::{Duration, Instant};

use nalgebra::Vector3;
use physics::constants::DAY_S;

pub(super) use super::planned::greatest_n_m_s;
pub use super::planned::{
    AGREED, Exceeded, Least, MomentumPlan, PlanError, PlanProblem, PlanTask, PlannedDump, PlannedRow,
    Simulates,
};
use super::{
    as_it_is::{are_allowed, array_changes, is_better, may_stay, own_windows},
    baseline::OffsetStep,
    controls::{ALL, Controls},
    counted::{self, Groups},
    formulation::{Formulation, Part, index},
    model::Model,
    program::{GUARD, Goal, Program, Solution, WHOLE},
    simulated::{MomentumSize, SAME_S, SimulatedFlight},
    windows::Window,
};

/// Rounds at most.
const MAX_ROUNDS: usize = 8;
/// Share of a flight's correction that a model takes where the last one did not bring both nearer by half.
const DAMPED: f64 = 0.5;
/// Solutions within a round at most.
const MAX_STEPS: usize = 24;
/// By which the range about the present controls narrows where the model fails, and where that ends.
const NARROWED: f64 = 0.4;
const MIN_TRUST: f64 = 2e-3;
/// Cost of a N m s over the limit, against a day with a radian of tilt.
const PENALTY: f64 = 1e3;
/// Shares of the range behind a flight, from which little is left to correct.
const LITTLE: [f64; 3] = [0.05, 0.15, 0.5];
/// A gain in merit below this share is none.
const TAKEN: f64 = 1e-4;

/// Gives every window the controls of a solution, and every dump its momentum.
pub(super) fn give(model: &mut Model<'_>, leaders: &[usize], solution: &Solution) {
    for number in 0..model.windows.len() {
        let mut controls = Controls::default();
        for control in ALL {
            controls = controls.with(control, solution.controls[index(leaders, number, control)]);
        }
        model.windows[number].controls = controls;
    }
    for ((_, after), begin) in model.dumps.iter_mut().zip(&solution.begins) {
        *after = *begin;
    }
}

/// Merit of a solution: cost, and excess over the limits.
fn merit(program: &Program, controls: &[f64], excess_n_m_s: f64, goal: Goal) -> f64 {
    match goal {
        Goal::LeastExcess | Goal::Farthest => excess_n_m_s,
        Goal::LeastCost => program.cost(controls) + PENALTY * excess_n_m_s.max(0.0),
    }
}

/// Solves about its own answers, from `trust` of the range of every control on; whether the limits are kept.
///
/// A trust region: an answer is taken where the model about it is better by the merit, and the range narrows where it is not.
pub(super) fn refine(
    model: &mut Model<'_>,
    leaders: &[usize],
    (goal, mut trust): (Goal, f64),
    simulates: &mut dyn Simulates,
) -> Result<bool, PlanError> {
    let limit = model.limit.momentum_n_m_s;
    // What instants leave, rows between them may use in part.
    let exceeded = |model: &Model<'_>| model.excess_beyond_n_m_s(0.5 * GUARD).0;
    model.look_between();
    let mut merit_now = f64::INFINITY;
    for step in 0..MAX_STEPS {
        simulates.progress("momentum");
        let formulation = Formulation { model, leaders };
        let program = formulation.program(Part::whole(model), [GUARD, trust]);
        if step == 0 && formulation.is_kept() {
            merit_now = merit(&program, &formulation.controls(), exceeded(model), goal);
        }
        let cheapest = (goal == Goal::LeastCost).then(|| program.solve(Goal::LeastCost)).flatten();
        let Some(solution) = cheapest.or_else(|| program.solve(Goal::LeastExcess)) else {
            if step == 0 {
                return Err(PlanError::Programme("the bounds of the controls leave none"));
            }
            break;
        };
        let mut next = model.clone();
        give(&mut next, leaders, &solution);
        next.linearise();
        next.look_between();
        let found = merit(&program, &solution.controls, exceeded(&next), goal);
        let predicted = merit(&program, &solution.controls, solution.excess, goal);
        if found < merit_now || (step == 0 && merit_now.is_infinite()) {
            let gained = merit_now - found;
            let promised = merit_now - predicted;
            *model = next;
            merit_now = found;
            // What is gained no more is not sought.
            if gained < TAKEN * found.abs().max(limit) && exceeded(model) <= 0.0 {
                break;
            }
            match gained / promised {
                ratio if ratio > 0.75 => trust = (2.0 * trust).min(WHOLE),
                ratio if ratio < 0.25 => trust *= NARROWED,
                _ => {}
            }
        } else {
            trust *= NARROWED;
            if trust < MIN_TRUST {
                break;
            }
        }
    }
    Ok(model.excess_n_m_s().0 <= 0.0)
}

/// Counts of an earlier round.
#[derive(Default)]
struct Structure {
    groups: Groups,
    dumps_at_least: usize,
    exceeded: Option<Exceeded>,
}

/// Counts dumps and changes about the model and sets its controls by them; returns whether these keep the limits.
fn structure(
    model: &mut Model<'_>,
    task: &PlanTask,
    simulates: &mut dyn Simulates,
) -> Result<(Structure, bool), PlanError> {
    let single = counted::single(model);
    let goal = task.least.goal();
    let (mut dumps_at_least, mut exceeded) = (0, None);
    let start = model.windows.clone();
    if !refine(model, &single, (goal, WHOLE), simulates)? {
        // Another way: from the start again, as far below the limit as it goes.
        let first = (model.excess_n_m_s().0, model.windows.clone());
        model.windows = start;
        model.linearise();
        if !refine(model, &single, (Goal::LeastExcess, WHOLE), simulates)? {
            if first.0 < model.excess_n_m_s().0 {
                model.windows = first.1;
                model.linearise();
            }
            // A target that is missed needs no dump.
            let mut alone = model.clone();
            if task.target.is_some() {
                alone.set_target(None, None);
                refine(&mut alone, &single, (Goal::LeastExcess, WHOLE), simulates)?;
            }
            let excess_n_m_s = alone.excess_n_m_s().0;
            if excess_n_m_s > 0.0 {
                simulates.progress("dumps");
                alone.look_at_departures();
                let found = counted::fewest_dumps(&alone, GUARD, &mut || simulates.progress("dumps"));
                let Some(found) = found else {
                    let (_, row) = alone.excess_n_m_s();
                    let rows = &alone.simulated.rows;
                    let day = (rows[row.min(rows.len() - 1)].time_s - rows[0].time_s) / DAY_S;
                    return Err(PlanError::Limit {
                        excess_n_m_s,
                        limit_n_m_s: alone.limit.momentum_n_m_s,
                        day,
                    });
                };
                dumps_at_least = found.at_least;
                if let Some(row) = found.rows.first() {
                    let first_s =
                        counted::first_exceeded_s(&alone).unwrap_or(model.simulated.rows[*row].time_s);
                    exceeded = Some(Exceeded { excess_n_m_s, first_s });
                }
                model.dumps = found.rows.into_iter().map(|row| (row, Vector3::zeros())).collect();
                refine(model, &single, (goal, WHOLE), simulates)?;
            }
        }
    }
    model.look_at_departures();
    let until = Instant::now() + Duration::from_secs_f64(task.budget_s.clamp(0.0, 1e6));
    let mut at_least = None;
    // Linear programmes count too few changes over wide ranges: count again in narrower ones about controls that keep the limits.
    for trust in [WHOLE].into_iter().chain(LITTLE.into_iter().rev()) {
        simulates.progress("changes");
        let groups =
            counted::fewest_changes(model, [GUARD, trust], until, &mut || simulates.progress("changes"));
        let Some(groups) = groups else { break };
        let at_least = *at_least.get_or_insert(groups.at_least);
        let mut grouped = model.clone();
        if refine(&mut grouped, &groups.leaders, (goal, WHOLE), simulates)? {
            *model = grouped;
            return Ok((Structure { groups: Groups { at_least, ..groups }, dumps_at_least, exceeded }, true));
        }
    }
    let groups = Groups { changes: single.len() - 1, at_least: at_least.unwrap_or(0), leaders: single };
    let is_kept = model.excess_n_m_s().0 <= 0.0;
    Ok((Structure { groups, dumps_at_least, exceeded }, is_kept))
}

/// The optimal plan of a mission whose flight is given; the mission as it is where that is no worse than what was found.
///
/// # Errors
/// A corridor without an offset, a flight that fails, a programme without an answer.
pub fn plan(problem: &PlanProblem<'_>, simulates: &mut dyn Simulates) -> Result<MomentumPlan, PlanError> {
    let laid_out = problem.windows()?;
    let own = as_it_is(problem, simulates)?;
    let found = searched(problem, laid_out, simulates);
    match (own, found) {
        (None, found) => found,
        (Some(own), Err(PlanError::Programme(_))) => Ok(own),
        (Some(_), Err(error)) => Err(error),
        (Some(own), Ok(found)) => {
            // What was flown is possible.
            let [dumps_at_least, changes_at_least, rounds] = [
                found.dumps_at_least.min(own.dumps.len()),
                found.changes_at_least.min(own.changes),
                found.rounds + own.rounds,
            ];
            let best = if is_better(&own, &found, problem.task) { own } else { found };
            Ok(MomentumPlan { dumps_at_least, changes_at_least, rounds, ..best })
        }
    }
}

/// The mission as it is, where it keeps the bounds of the plan and its flight the limit.
fn as_it_is(
    problem: &PlanProblem<'_>,
    simulates: &mut dyn Simulates,
) -> Result<Option<MomentumPlan>, PlanError> {
    let PlanProblem { task, simulated, .. } = *problem;
    let limit = &task.limit;
    if simulated.greatest(limit.size).0 > limit.kept_n_m_s() {
        return Ok(None);
    }
    let own = own_windows(problem);
    let Some(windows) = own.filter(|own| are_allowed(&task.layout, own, simulated)) else { return Ok(None) };
    simulates.progress("flight");
    let flight = simulates.simulate(&windows, &[]).map_err(PlanError::Flight)?;
    let mut model = problem.model(windows);
    model.take(&flight, 1.0);
    let mut baseline: Vec<OffsetStep> = Vec::new();
    for window in model.windows.iter().filter(|it| it.has_arrays()) {
        let step = OffsetStep { at_s: window.start_s, offset_rad: window.baseline_rad.abs() };
        if baseline.last().is_none_or(|last| last.offset_rad != step.offset_rad) {
            baseline.push(step);
        }
    }
    let none = Structure::default();
    let plan =
        MomentumPlan { is_mission: true, ..flown(task, &model, (baseline, &none), (flight, Vec::new(), 1)) };
    Ok(plan.holds.then_some(plan))
}

/// A plan with its flight, its dumps and the number of flights so far.
fn flown(
    task: &PlanTask,
    model: &Model<'_>,
    (baseline, counts): (Vec<OffsetStep>, &Structure),
    (flight, dumps, rounds): (SimulatedFlight, Vec<PlannedDump>, usize),
) -> MomentumPlan {
    let limit = &task.limit;
    let rows = rows(model, &flight);
    let below = rows.iter().all(|row| row.simulated_n_m_s <= row.allowed_n_m_s)
        && flight.greatest(limit.size).0 <= limit.kept_n_m_s();
    let miss = flight.encountered.as_ref().map(|it| it.miss);
    let meets = task.target.zip(miss).is_none_or(|(target, miss)| target.is_met(&miss));
    let changes = array_changes(&task.layout, &model.windows);
    let edge = usize::from(may_stay(&task.layout, &model.windows));
    MomentumPlan {
        windows: model.windows.clone(),
        baseline,
        dumps,
        dumps_at_least: counts.dumps_at_least,
        changes,
        changes_at_least: counts.groups.at_least.saturating_sub(edge).min(changes),
        rows,
        rounds,
        holds: below && meets,
        is_mission: false,
        exceeded: counts.exceeded,
        flight,
    }
}

/// The best plan that a search finds in windows on their baseline.
fn searched(
    problem: &PlanProblem<'_>,
    (windows, baseline): (Vec<Window>, Vec<OffsetStep>),
    simulates: &mut dyn Simulates,
) -> Result<MomentumPlan, PlanError> {
    let task = problem.task;
    let mut model = problem.model(windows);
    model.set_target(task.target, own_windows(problem));
    let mut counts: Option<Structure> = None;
    let mut best: Option<MomentumPlan> = None;
    let (mut rounds, mut off_before_n_m_s) = (0, f64::INFINITY);
    loop {
        rounds += 1;
        let (found, kept) = match counts.take() {
            None => structure(&mut model, task, simulates)?,
            Some(found) => {
                let mut kept = false;
                for trust in LITTLE {
                    let goal = task.least.goal();
                    kept = kept || refine(&mut model, &found.groups.leaders, (goal, trust), simulates)?;
                }
                (found, kept)
            }
        };
        let dumps: Vec<PlannedDump> = model
            .dumps
            .iter()
            .map(|(row, after)| PlannedDump { at_s: model.simulated.rows[*row].time_s, after_n_m_s: *after })
            .collect();
        simulates.progress("flight");
        let flight = simulates.simulate(&model.windows, &dumps).map_err(PlanError::Flight)?;
        let present = flown(task, &model, (baseline.clone(), &found), (flight.clone(), dumps, rounds));
        let off_n_m_s = present.difference_n_m_s();
        let agrees = off_n_m_s <= AGREED * task.limit.momentum_n_m_s;
        let is_last = (present.holds && agrees) || rounds == MAX_ROUNDS;
        let best_now = match best.take() {
            Some(best) if best.holds && !is_better(&present, &best, task) => best,
            _ => present,
        };
        if is_last {
            return Ok(MomentumPlan { rounds, ..best_now });
        }
        best = Some(best_now);
        let share = if off_n_m_s > 0.5 * off_before_n_m_s { DAMPED } else { 1.0 };
        off_before_n_m_s = off_n_m_s;
        model.take(&flight, share);
        model.look_between();
        if kept {
            counts = Some(found);
        } else {
            // What was counted does not do about the flight.
            model.dumps.clear();
        }
    }
}

fn rows(model: &Model<'_>, flight: &SimulatedFlight) -> Vec<PlannedRow> {
    let (momentum, allowed) = (model.momentum_n_m_s(), model.allowed_n_m_s());
    let size: MomentumSize = model.limit.size;
    let is_at_dump = |time_s: f64| {
        let of_model =
            model.dumps.iter().any(|(row, _)| (model.simulated.rows[*row].time_s - time_s).abs() <= SAME_S);
        of_model || model.is_reset_at(time_s)
    };
    let all = model.simulated.rows.iter().zip(&momentum).zip(&allowed);
    all.map(|((row, planned), allowed)| {
        let simulated = flight.momentum_n_m_s(row.time_s);
        // At a dump the one is before it, the other behind.
        let difference = if is_at_dump(row.time_s) { 0.0 } else { (simulated - planned).norm() };
        PlannedRow {
            time_s: row.time_s,
            planned_n_m_s: size.size(planned),
            simulated_n_m_s: size.size(&simulated),
            allowed_n_m_s: *allowed,
            difference_n_m_s: difference,
        }
    })
    .collect()
}

#[cfg(test)]
mod tests;

//! The optimal plan: fewest dumps, then fewest changes of the arrays, then least tilt, simulated and linearised again until both agree.
//!
//! Each round linearises the momentum about the present controls, solves, and simulates the answer through the FMU; what the flight gained
//! more than the model is added to the model of the next round. A round ends the search where flight and plan differ by no more than
//! [`AGREED`] of the limit and the flight stays below the limit. Within a round the programme is solved again about its own answer
//! (sequential convex programming) with the range of the controls around it narrowed, for tilt, windmilling and alternation multiply.

use std::time::{Duration, Instant};

use nalgebra::Vector3;
use physics::momentum::Convention;

use super::{
    baseline::{NoOffset, OffsetStep},
    counted::{self, Groups},
    model::{Limit, Model},
    program::{GUARD, Goal, Program, Solution, WHOLE},
    simulated::{MomentumSize, SAME_S, SimulatedFlight},
    target::Target,
    torque::{ALL, Controls, SunlitSpacecraft},
    windows::{Layout, Window},
};
use crate::Failure;

/// Flight and plan agree where they differ by less than this share of the limit.
pub const AGREED: f64 = 0.02;
/// Rounds at most.
const MOST_ROUNDS: usize = 8;
/// Solutions within a round at most.
const MOST_STEPS: usize = 24;
/// By which the range about the present controls narrows where the model fails, and where that ends.
const NARROWED: f64 = 0.4;
const LEAST_TRUST: f64 = 2e-3;
/// What a N m s over the limit costs, against a day with a radian of tilt.
const PENALTY: f64 = 1e3;
/// Shares of the range behind a flight, from which little is left to correct.
const LITTLE: [f64; 3] = [0.05, 0.15, 0.5];
/// A gain in merit below this share is none.
const TAKEN: f64 = 1e-4;

/// What a plan has least of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Least {
    /// Tilt of the Sun off -Y, by its time.
    Tilt,
    /// Greatest momentum.
    Momentum,
}

impl Least {
    fn goal(self) -> Goal {
        match self {
            Self::Tilt => Goal::LeastCost,
            Self::Momentum => Goal::LeastExcess,
        }
    }
}

/// What is planned.
#[derive(Clone, Debug)]
pub struct PlanTask {
    /// Windows, contacts, how far controls go.
    pub layout: Layout,
    /// What momentum is kept below.
    pub limit: Limit,
    /// Dumps that the plan may have.
    pub dumps: usize,
    /// What is least of all plans with the fewest dumps and changes.
    pub least: Least,
    /// Time for counted changes, in s.
    pub budget_s: f64,
    /// What the flight is aimed at; without effect where it has no encounter.
    pub target: Option<Target>,
}

/// A dump of the plan.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlannedDump {
    /// In s of the flight.
    pub at_s: f64,
    /// Momentum after it, EME2000, in N m s.
    pub after_n_m_s: Vector3<f64>,
}

/// What a plan says at a row of its flight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlannedRow {
    /// In s of the flight.
    pub time_s: f64,
    /// |H| as planned, in N m s.
    pub planned_n_m_s: f64,
    /// |H| as simulated, in N m s.
    pub simulated_n_m_s: f64,
    /// What it may come to, in N m s.
    pub allowed_n_m_s: f64,
    /// Length of the difference of both, in N m s.
    pub difference_n_m_s: f64,
}

/// What stands in the way of a plan without dumps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Exceeded {
    /// By which the limit is exceeded without dumps at best, in N m s.
    pub excess_n_m_s: f64,
    /// When it is first, in s of the flight: no choice of controls keeps the limit up to then.
    pub first_s: f64,
}

/// A plan.
#[derive(Clone, Debug)]
pub struct MomentumPlan {
    /// With their controls.
    pub windows: Vec<Window>,
    /// Steps of the baseline.
    pub baseline: Vec<OffsetStep>,
    /// Its dumps, in order.
    pub dumps: Vec<PlannedDump>,
    /// No plan has fewer.
    pub dumps_at_least: usize,
    /// Changes of the arrays.
    pub changes: usize,
    /// No plan has fewer.
    pub changes_at_least: usize,
    /// Row by row.
    pub rows: Vec<PlannedRow>,
    /// Flights that it took.
    pub rounds: usize,
    /// Whether the last flight agrees with it and stays below the limit.
    pub holds: bool,
    /// Where the limit is not kept without dumps.
    pub exceeded: Option<Exceeded>,
    /// The last flight.
    pub flight: SimulatedFlight,
}

/// The greatest |H| of rows as planned and as simulated, in N m s.
pub(super) fn greatest_n_m_s<'a>(rows: impl Iterator<Item = &'a PlannedRow>) -> [f64; 2] {
    rows.fold([0.0; 2], |[planned, simulated], row| {
        [row.planned_n_m_s.max(planned), row.simulated_n_m_s.max(simulated)]
    })
}

impl MomentumPlan {
    /// Greatest |H| as planned and as simulated, in N m s.
    pub fn greatest_n_m_s(&self) -> [f64; 2] {
        greatest_n_m_s(self.rows.iter())
    }

    /// Greatest difference of flight and plan, in N m s.
    pub fn difference_n_m_s(&self) -> f64 {
        self.rows.iter().map(|row| row.difference_n_m_s).fold(0.0, f64::max)
    }
}

/// Why there is no plan at all.
#[derive(Debug, thiserror::Error)]
pub enum PlanError {
    /// The corridor is empty somewhere.
    #[error("no offset keeps the light on the cells in its corridor {distance_au:.3} AU from the Sun", distance_au = .0.distance_au)]
    Corridor(NoOffset),
    /// A limit that dumps do not help to keep.
    #[error(
        "found a momentum {excess_n_m_s:.3} N.m.s above the limit of {limit_n_m_s} N.m.s on day {day:.1} at best, between two instants at which \
         a dump could be, allowed: a greater limit, or more room for the controls"
    )]
    Limit {
        /// By which it is exceeded at best, in N m s.
        excess_n_m_s: f64,
        /// The limit, in N m s.
        limit_n_m_s: f64,
        /// When it is exceeded most, in d of the flight.
        day: f64,
    },
    /// A flight failed.
    #[error("{0}")]
    Flight(Failure),
    /// The solver found nothing.
    #[error("no programme was solved: {0}")]
    Programme(&'static str),
}

/// How a plan is simulated.
pub trait Simulates {
    /// Simulates windows and dumps.
    ///
    /// # Errors
    /// The flight fails.
    fn simulate(&mut self, windows: &[Window], dumps: &[PlannedDump]) -> Result<SimulatedFlight, Failure>;

    /// Receives what is being done.
    fn progress(&mut self, _doing: &str) {}
}

/// Gives every window the controls of a solution, and every dump its momentum.
pub(super) fn give(model: &mut Model, leaders: &[usize], solution: &Solution) {
    for index in 0..model.windows.len() {
        let mut controls = Controls::default();
        for control in ALL {
            controls = controls.with(control, solution.controls[Model::index(leaders, index, control)]);
        }
        model.windows[index].controls = controls;
    }
    for ((_, after), begin) in model.dumps.iter_mut().zip(&solution.begins) {
        *after = *begin;
    }
}

/// What a solution is judged by: cost, and what the limits are exceeded by.
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
    model: &mut Model,
    sunlit: &SunlitSpacecraft,
    leaders: &[usize],
    (goal, mut trust): (Goal, f64),
    simulates: &mut dyn Simulates,
) -> Result<bool, PlanError> {
    let limit = model.limit.momentum_n_m_s;
    // What instants leave, rows between them may use in part.
    let exceeded = |model: &Model| model.excess_n_m_s().0 + 0.5 * GUARD * limit;
    model.look_between();
    let mut merit_now = f64::INFINITY;
    for step in 0..MOST_STEPS {
        simulates.progress("momentum");
        let program = model.program(leaders, model.whole(), [GUARD, trust]);
        if step == 0 && model.is_of(leaders) {
            merit_now = merit(&program, &model.controls(leaders), exceeded(model), goal);
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
        next.linearise(sunlit);
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
            if trust < LEAST_TRUST {
                break;
            }
        }
    }
    Ok(model.excess_n_m_s().0 <= 0.0)
}

/// What was counted in an earlier round.
struct Structure {
    groups: Groups,
    dumps_at_least: usize,
    exceeded: Option<Exceeded>,
}

/// Counts dumps and changes about the model and sets its controls by them; returns whether these keep the limits.
fn structure(
    model: &mut Model,
    sunlit: &SunlitSpacecraft,
    task: &PlanTask,
    simulates: &mut dyn Simulates,
) -> Result<(Structure, bool), PlanError> {
    let single = counted::single(model);
    let goal = task.least.goal();
    let (mut dumps_at_least, mut exceeded) = (0, None);
    let start = model.windows.clone();
    if !refine(model, sunlit, &single, (goal, WHOLE), simulates)? {
        // Another way: from the start again, as far below the limit as it goes.
        let first = (model.excess_n_m_s().0, model.windows.clone());
        model.windows = start;
        model.linearise(sunlit);
        if !refine(model, sunlit, &single, (Goal::LeastExcess, WHOLE), simulates)? {
            if first.0 < model.excess_n_m_s().0 {
                model.windows = first.1;
                model.linearise(sunlit);
            }
            // A target that is missed needs no dump.
            let mut alone = model.clone();
            if task.target.is_some() {
                alone.set_target(sunlit, None);
                refine(&mut alone, sunlit, &single, (Goal::LeastExcess, WHOLE), simulates)?;
            }
            let excess_n_m_s = alone.excess_n_m_s().0;
            if excess_n_m_s > 0.0 {
                simulates.progress("dumps");
                let found = counted::fewest_dumps(&alone, GUARD, &mut || simulates.progress("dumps"));
                let Some(found) = found else {
                    let (_, row) = alone.excess_n_m_s();
                    let rows = &alone.simulated.rows;
                    let day = (rows[row.min(rows.len() - 1)].time_s - rows[0].time_s) / 86_400.0;
                    return Err(PlanError::Limit {
                        excess_n_m_s,
                        limit_n_m_s: alone.limit.momentum_n_m_s,
                        day,
                    });
                };
                dumps_at_least = found.at_least;
                if let Some(row) = found.rows.first() {
                    let first_s =
                        counted::first_exceeded_s(&alone, GUARD).unwrap_or(model.simulated.rows[*row].time_s);
                    exceeded = Some(Exceeded { excess_n_m_s, first_s });
                }
                model.dumps = found.rows.into_iter().map(|row| (row, Vector3::zeros())).collect();
                refine(model, sunlit, &single, (goal, WHOLE), simulates)?;
            }
        }
    }
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
        if refine(&mut grouped, sunlit, &groups.leaders, (goal, WHOLE), simulates)? {
            *model = grouped;
            return Ok((Structure { groups: Groups { at_least, ..groups }, dumps_at_least, exceeded }, true));
        }
    }
    let groups = Groups { changes: single.len() - 1, at_least: at_least.unwrap_or(0), leaders: single };
    let is_kept = model.excess_n_m_s().0 <= 0.0;
    Ok((Structure { groups, dumps_at_least, exceeded }, is_kept))
}

/// The optimal plan of a mission whose flight is given.
///
/// # Errors
/// A corridor without an offset, a flight that fails, a programme without an answer.
pub fn plan(
    task: &PlanTask,
    sunlit: &SunlitSpacecraft,
    simulated: &SimulatedFlight,
    simulates: &mut dyn Simulates,
) -> Result<MomentumPlan, PlanError> {
    let (windows, baseline) = task.layout.windows(sunlit, simulated).map_err(PlanError::Corridor)?;
    let mut model = Model::new(sunlit, simulated.clone(), windows, task.limit.clone());
    model.set_target(sunlit, task.target);
    let mut counts: Option<Structure> = None;
    let mut rounds = 0;
    loop {
        rounds += 1;
        let (found, kept) = match counts.take() {
            None => structure(&mut model, sunlit, task, simulates)?,
            Some(found) => {
                let mut kept = false;
                for trust in LITTLE {
                    let goal = task.least.goal();
                    kept =
                        kept || refine(&mut model, sunlit, &found.groups.leaders, (goal, trust), simulates)?;
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
        let rows = rows(&model, &flight);
        let limit = task.limit.momentum_n_m_s;
        let off = rows.iter().map(|row| row.difference_n_m_s).fold(0.0, f64::max);
        let below = rows.iter().all(|row| row.simulated_n_m_s <= row.allowed_n_m_s)
            && flight.greatest(task.limit.size).0 <= limit * (1.0 - task.limit.margin);
        let miss = flight.encountered.as_ref().map(|it| it.miss);
        let meets = task.target.zip(miss).is_none_or(|(target, miss)| target.is_met(&miss));
        let holds = off <= AGREED * limit && below && meets;
        if holds || rounds == MOST_ROUNDS {
            return Ok(MomentumPlan {
                windows: model.windows,
                baseline,
                dumps,
                dumps_at_least: found.dumps_at_least,
                changes: found.groups.changes,
                changes_at_least: found.groups.at_least,
                rows,
                rounds,
                holds,
                exceeded: found.exceeded,
                flight,
            });
        }
        model.take(sunlit, &flight);
        model.look_between();
        if kept {
            counts = Some(found);
        } else {
            // What was counted does not do about the flight.
            model.dumps.clear();
        }
    }
}

/// Momentum after a dump in the body frame as it stands then, in N m s.
pub fn body_momentum_n_m_s(
    sunlit: &SunlitSpacecraft,
    simulated: &SimulatedFlight,
    windows: &[Window],
    dump: &PlannedDump,
) -> Vector3<f64> {
    if sunlit.convention == Convention::BodyIntegral {
        return dump.after_n_m_s;
    }
    let Some(row) = simulated.at(dump.at_s) else { return dump.after_n_m_s };
    let holds = |window: &&Window| window.start_s <= dump.at_s && window.stop_s > dump.at_s;
    let window = windows.iter().find(holds);
    let inertial_from_body =
        window.map_or(row.inertial_from_body, |window| window.inertial_from_body(sunlit, &row, dump.at_s));
    inertial_from_body.inverse() * dump.after_n_m_s
}

fn rows(model: &Model, flight: &SimulatedFlight) -> Vec<PlannedRow> {
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
            planned_n_m_s: size.of(planned),
            simulated_n_m_s: size.of(&simulated),
            allowed_n_m_s: *allowed,
            difference_n_m_s: difference,
        }
    })
    .collect()
}

#[cfg(test)]
mod tests;

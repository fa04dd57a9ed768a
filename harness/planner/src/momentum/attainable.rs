//! Bounds of what any choice of controls attains, by the linear model before any flight of a plan: excess, dumps, places in the B-plane.
//!
//! The places that the target can be moved to are convex as far as it is linear in the controls. Each of their corners is the farthest in
//! one direction, solved again about its own answer, for tilt, windmilling and alternation multiply; a direction whose own place is behind
//! another one's begins again from that. The polygon is a lower bound: every corner is a place that was found.

use nalgebra::{Vector2, Vector3};
use rayon::prelude::*;

use super::{
    as_it_is::own_windows,
    controls::{Control, Controls},
    counted,
    formulation::{Formulation, Part},
    model::Model,
    plan::{PlanError, PlanProblem, PlannedDump, Simulates, give, refine},
    program::{GUARD, Goal, TargetRow, WHOLE},
    region::{Point, Region},
    simulated::{FlightRow, SimulatedFlight},
    target::{LinearMiss, Target},
    torque::{Attitude, SunlitSpacecraft},
    windows::Window,
};
use crate::Failure;

/// Directions in which the farthest places are sought.
const DIRECTIONS: usize = 16;
/// Rows of the flight that the reach is computed with are no closer, in s.
const REACH_ROWS_S: f64 = 6.0 * 3600.0;
/// By which the range of the controls about an answer narrows where the next is no farther, and where that ends.
const NARROWED: f64 = 0.5;
const MIN_RANGE: f64 = 0.01;
/// A place farther by less than this share is the last.
const GAINED: f64 = 2e-3;
/// Times that directions begin again from the farthest of all corners, at most.
const RESTARTS: usize = 3;
/// Largest offset across an axis along which a place is sought: in m by the model, and in the end relative to the way.
const ASIDE_M: f64 = 10.0;
const ASIDE: f64 = 0.03;

/// The model of a mission before any flight of a plan.
fn bare<'a>(problem: &PlanProblem<'a>) -> Result<Model<'a>, PlanError> {
    Ok(problem.model(problem.windows()?.0))
}

/// Simulates nothing and reports no progress.
struct Silent;

impl Simulates for Silent {
    fn simulate(&mut self, _: &[Window], _: &[PlannedDump]) -> Result<SimulatedFlight, Failure> {
        Err("nothing is simulated here".into())
    }
}

/// By how much the limit is exceeded from a time on without dumps at best, in N m s, by the model before any flight of a plan; negative
/// below.
///
/// # Errors
/// A corridor without an offset, a programme without an answer.
pub fn least_excess_n_m_s(problem: &PlanProblem<'_>, from_s: f64) -> Result<f64, PlanError> {
    let mut model = bare(problem)?;
    model.judged_from_s = from_s;
    let single = counted::single(&model);
    refine(&mut model, &single, (Goal::LeastExcess, WHOLE), &mut Silent)?;
    Ok(model.excess_n_m_s().0)
}

/// The fewest dumps, by the same model; `None` where dumps do not help.
///
/// # Errors
/// A corridor without an offset, a programme without an answer.
pub fn fewest_dumps(problem: &PlanProblem<'_>) -> Result<Option<usize>, PlanError> {
    let mut model = bare(problem)?;
    let single = counted::single(&model);
    if refine(&mut model, &single, (Goal::LeastExcess, WHOLE), &mut Silent)? {
        return Ok(Some(0));
    }
    Ok(counted::fewest_dumps(&model, GUARD, &mut || {}).map(|found| found.rows.len()))
}

/// Momentum that a downlink with the Sun on -Y would gather over a span, the arrays standing as in the windows, EME2000, in N m s.
pub fn downlink_momentum_n_m_s(
    sunlit: &SunlitSpacecraft,
    simulated: &SimulatedFlight,
    windows: &[Window],
    [from_s, to_s]: [f64; 2],
) -> Vector3<f64> {
    let with = simulated.with_rows_at(&[from_s, to_s]);
    let inside: Vec<_> = with.within([from_s, to_s]).collect();
    let torque = |row: &FlightRow| {
        let window = windows.iter().find(|window| window.stop_s >= row.time_s);
        let controls = window.map(|window| window.controls).unwrap_or_default();
        sunlit.torque_n_m(row, Attitude::Downlink, &controls.with_place([0.0; 2])) + row.other_torque_n_m
    };
    let pairs = inside.windows(2);
    pairs.map(|pair| (torque(pair[0]) + torque(pair[1])) * (0.5 * (pair[1].time_s - pair[0].time_s))).sum()
}

/// Places in the B-plane that the controls can move an encounter to, from where it is, in m along T and R.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Reachable {
    /// Farthest along +T, -T, +R, -R, the other one unchanged; `None` where no place there was found.
    pub along_m: [Option<f64>; 4],
    /// Least convex region with all places that were found.
    pub region_m: Region,
}

/// The places that the target of a flight can be moved to within the limits: those that were found, which all others may lie beyond.
///
/// # Errors
/// A corridor without an offset, a programme without an answer.
pub fn reachable(problem: &PlanProblem<'_>, simulates: &mut dyn Simulates) -> Result<Reachable, PlanError> {
    let PlanProblem { task, simulated, .. } = *problem;
    let thinned = simulated.thinned(REACH_ROWS_S);
    let mut model = bare(&PlanProblem { simulated: &thinned, ..*problem })?;
    // The target itself is no limit here.
    let free = task.target.map(|_| Target { tolerance: [None; 3] });
    model.set_target(free, own_windows(problem));
    simulates.progress("reach");
    let Some(encountered) = &simulated.encountered else { return Ok(Reachable::default()) };
    let single = counted::single(&model);
    if model.excess_n_m_s().0 > 0.0 {
        refine(&mut model, &single, (Goal::LeastExcess, WHOLE), simulates)?;
    }
    let search = Search { model, here: encountered.miss.xy() };
    let axes = [Vector2::x(), -Vector2::x(), Vector2::y(), -Vector2::y()];
    // As far as it goes, and straight.
    let found: Vec<[Option<Corner>; 2]> = axes
        .par_iter()
        .map(|axis| [false, true].map(|is_straight| search.first((*axis, is_straight))))
        .collect();
    let widest = [0, 1, 2, 3].map(|at| found[at][0].as_ref().map_or(0.0, |it| it.place_m.dot(&axes[at])));
    let scale = Vector2::new(widest[0].max(widest[1]), widest[2].max(widest[3])).add_scalar(1.0);
    // Normals of an ellipse of that size, between the axes.
    let between = (0..DIRECTIONS).filter(|k| k % (DIRECTIONS / 4) != 0);
    let normals = between
        .map(|k| core::f64::consts::TAU * k as f64 / DIRECTIONS as f64)
        .map(|angle| Vector2::new(angle.cos() / scale.x, angle.sin() / scale.y).normalize());
    let normals: Vec<Vector2<f64>> = normals.collect();
    let of_normals: Vec<Option<Corner>> =
        normals.par_iter().map(|normal| search.first((*normal, false))).collect();
    let mut reached: Vec<(Vector2<f64>, Option<Corner>)> = normals.into_iter().zip(of_normals).collect();
    let mut all: Vec<Corner> = search.start().into_iter().collect();
    for (axis, [farthest, straight]) in axes.iter().zip(found) {
        reached.push((*axis, farthest));
        all.extend(straight);
    }
    search.restart(&mut reached, &all);
    all.extend(reached.into_iter().filter_map(|(_, corner)| corner));
    let mut places: Vec<Vector2<f64>> = all.iter().map(|corner| corner.place_m).collect();
    // The flight as it is, where it keeps the limits.
    if simulated.greatest(task.limit.size).0 <= task.limit.kept_n_m_s() {
        places.push(Vector2::zeros());
    }
    let region_m = Region::hull(places.into_iter().map(Point::from));
    Ok(Reachable { along_m: axes.map(|axis| along_m(&region_m, &axis)), region_m })
}

/// Whether the programme of a plan meets the target within the limits, by the model before any flight of it.
///
/// # Errors
/// A corridor without an offset, a programme without an answer.
pub fn meets_target(problem: &PlanProblem<'_>, simulates: &mut dyn Simulates) -> Result<bool, PlanError> {
    let mut model = bare(problem)?;
    model.set_target(problem.task.target, own_windows(problem));
    let single = counted::single(&model);
    refine(&mut model, &single, (Goal::LeastExcess, WHOLE), simulates)
}

/// A place in the B-plane from where the flight meets it, in m, and the controls of the windows that lead there by the model.
#[derive(Clone, Debug)]
struct Corner {
    place_m: Vector2<f64>,
    controls: Vec<Controls>,
}

/// Direction of a climb, and whether it goes straight there: nowhere aside.
type Heading = (Vector2<f64>, bool);

/// Search of the places farthest from `here`, where the flight meets the B-plane.
struct Search<'a> {
    model: Model<'a>,
    here: Vector2<f64>,
}

impl Search<'_> {
    /// The model's place and controls; `None` without a target.
    fn corner(&self, model: &Model<'_>) -> Option<Corner> {
        let controls = model.windows.iter().map(|window| window.controls).collect();
        Some(Corner { place_m: model.miss()?.xy() - self.here, controls })
    }

    /// The first controls, where they keep the limits.
    fn start(&self) -> Option<Corner> {
        if self.model.excess_n_m_s().0 <= 0.0 { self.corner(&self.model) } else { None }
    }

    /// The farthest place from the first controls on. Sought without the alternate attitude too, for it takes away what tilt does, and from
    /// half of its greatest share on, for at none the place of the Sun in it moves nothing.
    fn first(&self, heading: Heading) -> Option<Corner> {
        let found = [None, Some(0.0), Some(0.5)].map(|share| {
            let mut model = self.model.clone();
            if let Some(share) = share {
                for window in &mut model.windows {
                    let [_, most] = &mut window.bounds[Control::Alternate as usize];
                    window.controls = window.controls.with(Control::Alternate, share * *most);
                    *most = if share > 0.0 { *most } else { 0.0 };
                }
                model.linearise();
            }
            self.climb(&mut model, heading, None)
        });
        farthest(found.iter().flatten(), &heading.0).cloned()
    }

    /// Climbs again from the farthest of all corners where a direction's own is behind it, or there is none.
    fn restart(&self, reached: &mut [(Vector2<f64>, Option<Corner>)], others: &[Corner]) {
        for _ in 0..RESTARTS {
            let all: Vec<&Corner> =
                reached.iter().filter_map(|(_, corner)| corner.as_ref()).chain(others).collect();
            let again = |(direction, own): &(Vector2<f64>, Option<Corner>)| {
                let from = farthest(all.iter().copied(), direction)?;
                let ahead_m = direction.dot(&from.place_m);
                let is_behind = own
                    .as_ref()
                    .is_none_or(|own| ahead_m - direction.dot(&own.place_m) > GAINED * ahead_m.abs());
                is_behind.then(|| self.climb_from(from, *direction))
            };
            let found: Vec<Option<Corner>> = reached.par_iter().map(again).collect();
            if found.iter().all(Option::is_none) {
                break;
            }
            for ((_, own), found) in reached.iter_mut().zip(found) {
                *own = found.or(own.take());
            }
        }
    }

    /// The farthest place from a corner on; that corner where nothing is farther.
    fn climb_from(&self, from: &Corner, direction: Vector2<f64>) -> Corner {
        let mut model = self.model.clone();
        model.windows.iter_mut().zip(&from.controls).for_each(|(window, it)| window.controls = *it);
        model.linearise();
        self.climb(&mut model, (direction, false), Some(from.clone())).unwrap_or_else(|| from.clone())
    }

    /// Climbs from the model's controls on, which lead to `found` if they keep the limits: an answer is taken where it is farther, and the
    /// range about it narrows where it is not.
    fn climb(
        &self,
        model: &mut Model<'_>,
        (direction, is_straight): Heading,
        mut found: Option<Corner>,
    ) -> Option<Corner> {
        let leaders = counted::single(model);
        model.look_between();
        let aside = Vector2::new(-direction.y, direction.x);
        let mut trust = WHOLE;
        while trust > MIN_RANGE {
            let formulation = Formulation { model, leaders: &leaders };
            let LinearMiss { constant, terms } = formulation.linear_miss()?;
            let mut program = formulation.program(Part::whole(model), [GUARD, trust]);
            let by = |axis: Vector2<f64>| terms.iter().map(move |(index, by)| (*index, axis.dot(&by.xy())));
            let size = by(direction).map(|(_, by)| by.abs()).fold(0.0, f64::max);
            if size == 0.0 {
                return found.or_else(|| self.start());
            }
            program.gains = by(direction).map(|(index, by)| (index, by / size)).collect();
            if is_straight {
                program.targets.push(TargetRow {
                    constant: aside.dot(&(constant.xy() - self.here)),
                    terms: by(aside).collect(),
                    within: ASIDE_M,
                    per_excess: ASIDE_M,
                });
            }
            let Some(solution) = program.solve(Goal::Farthest) else { break };
            let mut next = model.clone();
            give(&mut next, &leaders, &solution);
            next.linearise();
            next.look_between();
            let corner = self.corner(&next)?;
            let along_m = |corner: &Corner| direction.dot(&corner.place_m);
            let aside_m = aside.dot(&corner.place_m).abs();
            let is_aside = is_straight && aside_m > ASIDE * along_m(&corner).abs() + ASIDE_M;
            let is_kept = next.excess_n_m_s().0 <= 0.0 && !is_aside;
            let gained_m = found.as_ref().map_or(f64::INFINITY, |found| along_m(&corner) - along_m(found));
            if is_kept && gained_m > 0.0 {
                *model = next;
                let is_last = gained_m < GAINED * along_m(&corner).abs();
                found = Some(corner);
                if is_last {
                    break;
                }
                trust = (trust / NARROWED).min(WHOLE);
            } else {
                // Nothing yet: the next linearisation is about the answer all the same.
                if found.is_none() {
                    *model = next;
                }
                trust *= NARROWED;
            }
        }
        found
    }
}

/// The corner that is farthest in a direction.
fn farthest<'a>(corners: impl Iterator<Item = &'a Corner>, direction: &Vector2<f64>) -> Option<&'a Corner> {
    let along_m = |corner: &Corner| direction.dot(&corner.place_m);
    corners.max_by(|a, b| along_m(a).total_cmp(&along_m(b)))
}

/// How far a convex region goes along a ray from the origin, in m; `None` where the ray does not meet it.
fn along_m(region_m: &Region, axis: &Vector2<f64>) -> Option<f64> {
    let places = || region_m.corners.iter().map(|corner| Vector2::from(*corner));
    let crossed = places().zip(places().cycle().skip(1)).filter_map(|(from, to)| {
        let [aside, next] = [from, to].map(|place| axis.perp(&place));
        if aside == 0.0 {
            return Some(axis.dot(&from));
        }
        let share = aside / (aside - next);
        (aside * next < 0.0).then(|| axis.dot(&from.lerp(&to, share)))
    });
    crossed.filter(|along_m| *along_m >= 0.0).max_by(f64::total_cmp)
}

#[cfg(test)]
mod tests;

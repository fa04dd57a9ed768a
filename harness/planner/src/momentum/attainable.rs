//! What any choice of controls attains, by the linear model before any flight of a plan: excess, dumps, places in the B-plane.
//!
//! The places that the target can be moved to are convex as far as it is linear in the controls. Each of their corners is the farthest in
//! one direction, solved again about its own answer, for tilt, windmilling and alternation multiply.

use nalgebra::{Vector2, Vector3};
use rayon::prelude::*;

use super::{
    counted,
    model::Model,
    plan::{PlanError, PlanTask, PlannedDump, Simulates, give, refine},
    program::{GUARD, Goal, TargetRow, WHOLE},
    region::Region,
    simulated::{FlightRow, SAME_S, SimulatedFlight},
    target::{LinearMiss, Target},
    torque::{Attitude, Control, SunlitSpacecraft},
    windows::Window,
};
use crate::Failure;

/// Directions in which the farthest places are sought.
const DIRECTIONS: usize = 16;
/// Rows of the flight that the reach is computed with are no closer, in s.
const REACH_ROWS_S: f64 = 6.0 * 3600.0;
/// By which the range of the controls about an answer narrows where the next is no farther, and where that ends.
const NARROWED: f64 = 0.5;
const LEAST_RANGE: f64 = 0.01;
/// A place farther by less than this share is the last.
const GAINED: f64 = 2e-3;
/// Along one axis the other one is kept within so many m by the model, and within this share of the way in the end.
const ASIDE_M: f64 = 10.0;
const ASIDE: f64 = 0.03;

/// The model of a mission before any flight of a plan.
fn bare(task: &PlanTask, sunlit: &SunlitSpacecraft, simulated: &SimulatedFlight) -> Result<Model, PlanError> {
    let (windows, _) = task.layout.windows(sunlit, simulated).map_err(PlanError::Corridor)?;
    Ok(Model::new(sunlit, simulated.clone(), windows, task.limit.clone()))
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
pub fn least_excess_n_m_s(
    task: &PlanTask,
    sunlit: &SunlitSpacecraft,
    simulated: &SimulatedFlight,
    from_s: f64,
) -> Result<f64, PlanError> {
    let mut model = bare(task, sunlit, simulated)?;
    model.judged_from_s = from_s;
    let single = counted::single(&model);
    refine(&mut model, sunlit, &single, (Goal::LeastExcess, WHOLE), &mut Silent)?;
    Ok(model.excess_n_m_s().0)
}

/// The fewest dumps, by the same model; `None` where dumps do not help.
///
/// # Errors
/// A corridor without an offset, a programme without an answer.
pub fn fewest_dumps(
    task: &PlanTask,
    sunlit: &SunlitSpacecraft,
    simulated: &SimulatedFlight,
) -> Result<Option<usize>, PlanError> {
    let mut model = bare(task, sunlit, simulated)?;
    let single = counted::single(&model);
    if refine(&mut model, sunlit, &single, (Goal::LeastExcess, WHOLE), &mut Silent)? {
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
    let inside: Vec<_> =
        with.rows.iter().filter(|row| (from_s - SAME_S..=to_s + SAME_S).contains(&row.time_s)).collect();
    let torque = |row: &FlightRow| {
        let window = windows.iter().find(|window| window.stop_s >= row.time_s);
        let controls = window.map(|window| window.controls).unwrap_or_default();
        let controls = controls.with(Control::Azimuth, 0.0).with(Control::Elevation, 0.0);
        sunlit.torque_n_m(row, Attitude::Downlink, &controls) + row.other_torque_n_m
    };
    let pairs = inside.windows(2);
    pairs.map(|pair| (torque(pair[0]) + torque(pair[1])) * (0.5 * (pair[1].time_s - pair[0].time_s))).sum()
}

/// Places in the B-plane that the controls can move an encounter to, from where it is, in m along T and R.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Reachable {
    /// Farthest along +T, -T, +R, -R, the other one unchanged; `None` where that keeps no limit.
    pub along_m: [Option<f64>; 4],
    /// Corners of all places, counterclockwise from T to R.
    pub polygon_m: Vec<[f64; 2]>,
}

/// The places that the target of a flight can be moved to within the limits.
///
/// # Errors
/// A corridor without an offset, a programme without an answer.
pub fn reachable(
    task: &PlanTask,
    sunlit: &SunlitSpacecraft,
    simulated: &SimulatedFlight,
    simulates: &mut dyn Simulates,
) -> Result<Reachable, PlanError> {
    let mut model = bare(task, sunlit, &simulated.thinned(REACH_ROWS_S))?;
    // The target itself is no limit here.
    model.set_target(sunlit, task.target.map(|_| Target { tolerance: [None; 3] }));
    simulates.progress("reach");
    let Some(here) = model.miss() else { return Ok(Reachable::default()) };
    let here = here.xy();
    let single = counted::single(&model);
    if model.excess_n_m_s().0 > 0.0 {
        refine(&mut model, sunlit, &single, (Goal::LeastExcess, WHOLE), simulates)?;
    }
    let farthest =
        |direction: Vector2<f64>, is_straight: bool| farthest(&model, sunlit, (here, direction), is_straight);
    let axes = [Vector2::x(), -Vector2::x(), Vector2::y(), -Vector2::y()];
    // As far as it goes, and straight.
    let found: Vec<[Option<Vector2<f64>>; 2]> =
        axes.par_iter().map(|axis| [false, true].map(|is_straight| farthest(*axis, is_straight))).collect();
    // One behind where it is: the limits do not let it stay there.
    let along = |at: usize| found[at][1].map(|place| place.dot(&axes[at])).filter(|along_m| *along_m >= 0.0);
    let widest = [0, 1, 2, 3].map(|at| found[at][0].map_or(0.0, |place| place.dot(&axes[at])));
    let scale = Vector2::new(widest[0].max(widest[1]), widest[2].max(widest[3])).add_scalar(1.0);
    // Normals of an ellipse of that size, between the axes.
    let between = (0..DIRECTIONS).filter(|k| k % (DIRECTIONS / 4) != 0);
    let normals: Vec<Vector2<f64>> = between
        .map(|k| core::f64::consts::TAU * k as f64 / DIRECTIONS as f64)
        .map(|angle| Vector2::new(angle.cos() / scale.x, angle.sin() / scale.y).normalize())
        .collect();
    let mut corners: Vec<Option<Vector2<f64>>> =
        normals.par_iter().map(|normal| farthest(*normal, false)).collect();
    corners.extend(found.iter().flatten());
    let polygon_m = hull(corners.into_iter().flatten().collect());
    Ok(Reachable { along_m: [0, 1, 2, 3].map(along), polygon_m })
}

/// The place farthest in a direction from where the encounter was; straight: nowhere aside. Sought with the alternate attitude and
/// without, for it takes away what tilt does.
fn farthest(
    model: &Model,
    sunlit: &SunlitSpacecraft,
    (here, direction): (Vector2<f64>, Vector2<f64>),
    is_straight: bool,
) -> Option<Vector2<f64>> {
    let mut best: Option<Vector2<f64>> = None;
    for alternates in [true, false] {
        let mut model = model.clone();
        if !alternates {
            model.windows.iter_mut().for_each(|window| window.bounds[Control::Alternate as usize] = [0.0; 2]);
            model.linearise(sunlit);
        }
        let found = climb(&mut model, sunlit, (here, direction), is_straight);
        let is_farther =
            |found: &Vector2<f64>| best.is_none_or(|best| direction.dot(found) > direction.dot(&best));
        best = found.filter(is_farther).or(best);
    }
    best
}

/// The same from the model's controls on: an answer is taken where it is farther, and the range about it narrows where it is not.
fn climb(
    model: &mut Model,
    sunlit: &SunlitSpacecraft,
    (here, direction): (Vector2<f64>, Vector2<f64>),
    is_straight: bool,
) -> Option<Vector2<f64>> {
    let leaders = counted::single(model);
    let aside = Vector2::new(-direction.y, direction.x);
    let (mut place, mut trust): (Option<Vector2<f64>>, f64) = (None, WHOLE);
    let limit_n_m_s = model.limit.momentum_n_m_s;
    while trust > LEAST_RANGE {
        let LinearMiss { constant, terms } = model.linear_miss(&leaders)?;
        let mut program = model.program(&leaders, model.whole(), [GUARD, trust]);
        let by = |axis: Vector2<f64>| terms.iter().map(move |(index, by)| (*index, axis.dot(&by.xy())));
        let size = by(direction).map(|(_, by)| by.abs()).fold(0.0, f64::max);
        if size == 0.0 {
            return Some(Vector2::zeros());
        }
        program.gains = by(direction).map(|(index, by)| (index, by / size)).collect();
        if is_straight {
            program.targets.push(TargetRow {
                constant: aside.dot(&(constant.xy() - here)),
                terms: by(aside).collect(),
                within: ASIDE_M,
                per_excess: ASIDE_M,
            });
        }
        let Some(solution) = program.solve(Goal::Farthest) else { break };
        let mut next = model.clone();
        give(&mut next, &leaders, &solution);
        next.linearise(sunlit);
        let found = next.miss()?.xy() - here;
        let is_aside = is_straight && aside.dot(&found).abs() > ASIDE * direction.dot(&found).abs() + ASIDE_M;
        let is_kept = next.excess_n_m_s().0 <= GUARD * limit_n_m_s && !is_aside;
        let gained = place.map_or(f64::INFINITY, |place| direction.dot(&(found - place)));
        if is_kept && gained > 0.0 {
            *model = next;
            place = Some(found);
            if gained < GAINED * direction.dot(&found).abs() {
                break;
            }
        } else {
            // Nothing yet: the next linearisation is about the answer all the same.
            if place.is_none() {
                *model = next;
            }
            trust *= NARROWED;
        }
    }
    place
}

/// Corners of the least convex region with all of these places, counterclockwise.
fn hull(places: Vec<Vector2<f64>>) -> Vec<[f64; 2]> {
    Region::hull(places.into_iter().map(|place| [place.x, place.y])).corners
}

#[cfg(test)]
mod tests;

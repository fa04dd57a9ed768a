//! The mission as it is, as a plan: what a search must not fall behind.
//!
//! Its windows are the spans in which its own commands leave arrays, Sun's place and attitude alone. It is a plan where these keep the
//! bounds of the task and its flight stays below the limit.

use super::{
    baseline::OffsetStep,
    controls::{ARRAYS, Control, Controls, PLACE},
    in_force::{ActiveControls, mean},
    planned::{AGREED, Least, MomentumPlan, PlanProblem, PlanTask},
    simulated::{SAME_S, SimulatedFlight},
    windows::{Layout, Span, Window, WindowKind},
};

/// Arrays and places that differ by less are one, in rad: timelines have a ten-thousandth of a degree.
const SAME_RAD: f64 = 2e-6;
/// Half of the longest cycle of normal and alternate attitude, in s: a span may begin or end within one.
const HALF_CYCLE_S: f64 = 43_200.0;

fn is_within(value: f64, [low, high]: [f64; 2]) -> bool {
    value >= low - SAME_RAD && value <= high + SAME_RAD
}

/// Offset and windmill angle of the mission just before a time, where they are known, in rad.
fn arrays_before_rad(own: &[ActiveControls], at_s: f64) -> Option<[f64; 2]> {
    own.iter().rfind(|it| it.at_s < at_s - SAME_S).map(|it| it.controls.each(ARRAYS))
}

/// Times at which the arrays move in the windows, that at the end of the frozen time among them.
pub(super) fn array_changes(layout: &Layout, windows: &[Window]) -> usize {
    let frozen = windows.first().filter(|window| window.kind == WindowKind::Frozen);
    // Arrays that are not known move.
    let mut last =
        frozen.map(|window| arrays_before_rad(&layout.own, window.stop_s).unwrap_or([f64::NAN; 2]));
    let mut changes = 0;
    for window in windows.iter().filter(|it| it.has_arrays()) {
        let now = window.controls.each(ARRAYS);
        let stays = |last: [f64; 2]| last.iter().zip(now).all(|(a, b)| (a - b).abs() < SAME_RAD);
        changes += usize::from(last.is_some_and(|last| !stays(last)));
        last = Some(now);
    }
    changes
}

/// Whether the first windows behind the frozen time may leave the arrays as they are.
pub(super) fn may_stay(layout: &Layout, windows: &[Window]) -> bool {
    let [first, next, ..] = windows else { return false };
    let before = arrays_before_rad(&layout.own, first.stop_s).filter(|_| first.kind == WindowKind::Frozen);
    let bounds = ARRAYS.map(|it| next.bounds[it as usize]);
    before.is_some_and(|before| before.into_iter().zip(bounds).all(|(rad, bounds)| is_within(rad, bounds)))
}

/// Layout of the spans that the mission holds fixed and of those between, in one piece each.
fn undivided(layout: &Layout) -> Layout {
    Layout { window_s: f64::MAX, ..layout.clone() }
}

/// The mission's own windows; `None` where they are not known.
pub(super) fn own_windows(problem: &PlanProblem<'_>) -> Option<Vec<Window>> {
    let PlanProblem { task, sunlit, simulated } = *problem;
    let layout = &task.layout;
    layout.own.first()?;
    let whole = undivided(layout);
    let mut windows = Vec::new();
    for ([start_s, stop_s], kind, command) in whole.spans(simulated) {
        if kind == WindowKind::Frozen {
            windows.push(whole.window([start_s, stop_s], (kind, command), (sunlit, simulated), &[]));
            continue;
        }
        let mut cuts_s: Vec<f64> = layout.own.iter().map(|it| it.at_s).collect();
        cuts_s.retain(|at_s| *at_s > start_s + SAME_S && *at_s < stop_s - SAME_S);
        cuts_s.push(stop_s);
        let mut from_s = start_s;
        for to_s in cuts_s {
            let own = mean(&layout.own, [from_s, to_s])?;
            let offset_rad = layout.offset_sign * own.get(Control::Offset);
            let step = OffsetStep { at_s: from_s, offset_rad };
            let mut window = whole.window([from_s, to_s], (kind, command), (sunlit, simulated), &[step]);
            window.controls = match kind {
                WindowKind::Free if own.get(Control::Alternate) > 0.0 && !window.is_apart() => {
                    own.alternate()
                }
                WindowKind::Free => own,
                _ => Controls::default()
                    .with(Control::Offset, own.get(Control::Offset))
                    .with(Control::Windmill, own.get(Control::Windmill)),
            };
            windows.push(window);
            from_s = to_s;
        }
    }
    Some(windows)
}

/// Whether the mission's own windows keep the bounds of the plan.
pub(super) fn are_allowed(layout: &Layout, windows: &[Window], simulated: &SimulatedFlight) -> bool {
    let mut moved = windows.iter().filter(|window| window.kind != WindowKind::Frozen);
    let most = layout.control_bounds.alternate.min(1.0 - layout.contact_share);
    let alternates = |([start_s, stop_s], ..): Span| {
        let inside = windows.iter().filter(|window| (start_s..stop_s).contains(&window.start_s));
        let alternate_s: f64 =
            inside.map(|window| window.controls.get(Control::Alternate) * window.length_s()).sum();
        alternate_s > 0.0 && (most <= 0.0 || alternate_s > most * (stop_s - start_s) + HALF_CYCLE_S)
    };
    moved.all(|window| is_allowed(layout, window, simulated))
        && !undivided(layout).spans(simulated).into_iter().any(alternates)
}

/// Whether the controls of a window of the mission are a plan's: within its bounds, the corridor and the times without contact.
fn is_allowed(layout: &Layout, window: &Window, simulated: &SimulatedFlight) -> bool {
    let controls = &window.controls;
    let place_rad = controls.each(PLACE);
    let within = |control: Control| is_within(controls.get(control), window.bounds[control as usize]);
    let is_lit = window.sides.is_empty() || {
        let rows: Vec<_> = simulated.within([window.start_s, window.stop_s]).collect();
        let allowed = layout.corridor_rad(&rows);
        let [offset_rad, windmill_rad] = controls.each(ARRAYS);
        within(Control::Windmill)
            && window.sides.iter().all(|side| is_within(offset_rad + side * windmill_rad, allowed))
    };
    let is_free = controls.get(Control::Alternate) <= 0.0 || window.free_s() >= window.length_s() - SAME_S;
    let is_place = window.kind != WindowKind::Free
        || (PLACE.into_iter().all(within)
            && window.places.iter().all(|side| {
                is_within(
                    side.weights[0] * place_rad[0] + side.weights[1] * place_rad[1],
                    [f64::NEG_INFINITY, side.most],
                )
            }));
    is_lit && is_free && is_place
}

/// Cost that a plan minimises after dumps and changes.
fn cost(plan: &MomentumPlan, task: &PlanTask) -> f64 {
    let free = plan.windows.iter().filter(|window| window.kind == WindowKind::Free);
    match task.least {
        Least::Tilt => free
            .map(|it| {
                let [azimuth_rad, elevation_rad] = it.controls.each(PLACE);
                it.length_s() * azimuth_rad.hypot(elevation_rad)
            })
            .sum(),
        Least::Momentum => plan.flight.greatest(task.limit.size).0,
    }
}

/// Whether a plan is better than another: it holds, has fewer dumps, fewer changes, agrees with its flight, has less of what is least.
pub(super) fn is_better(one: &MomentumPlan, other: &MomentumPlan, task: &PlanTask) -> bool {
    let departs = |plan: &MomentumPlan| plan.difference_n_m_s() > AGREED * task.limit.momentum_n_m_s;
    let rank =
        |plan: &MomentumPlan| (!plan.holds, plan.dumps.len(), plan.changes, departs(plan), cost(plan, task));
    rank(one) < rank(other)
}

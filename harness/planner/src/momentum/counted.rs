//! Counts: fewest dumps, fewest changes of the arrays, each with a bound from below.
//!
//! **Dumps.** A dump leaves any momentum within the limit, so the flight falls into parts that do not know of one another, and a part of
//! a feasible part is feasible: continuing as far as some choice of controls allows and dumping there gives the fewest (of the linear
//! model). Among the plans with that number the one with the smallest limit is taken. From below: the same by relaxed programmes.
//!
//! **Changes.** The arrays stand alike over groups of neighbouring windows. Steps of the baseline begin a group in any case. From below:
//! windows that cannot share a windmill angle whatever the momentum before them have a change among them; such spans that share no edge
//! are counted. From above: each group continues as long as a plan for the rest exists in which every later window is a group by itself.
//! Where both differ, branch and bound over the places of the changes, depth first: a branch ends where even single windows
//! behind it find no plan, or where the count from below exceeds what is left. It stops by the clock; the gap is reported. Plans leave a
//! guard and follow a linear model; the same search by relaxed programmes proves that there are not fewer. Controls of plans stay within a range about the model's: the programmes are linear, and over a wide range their groups may not keep the limits.

use std::{collections::HashMap, time::Instant};

use super::{
    controls::ARRAYS,
    formulation::{Formulation, Part},
    model::Model,
    program::{GUARD, Goal, WHOLE},
    simulated::SAME_S,
    windows::WindowKind,
};

/// A limit counts as kept up to this share of it.
const KEPT: f64 = 1e-4;

/// Dumps of a plan.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Dumps {
    /// Rows of the flight at which they are.
    pub rows: Vec<usize>,
    /// No plan on the baseline has fewer.
    pub at_least: usize,
}

/// Groups of windows whose arrays stand alike.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Groups {
    /// First window of the group of every window.
    pub leaders: Vec<usize>,
    /// Changes of the arrays.
    pub changes: usize,
    /// No plan on the baseline with these dumps has fewer; 0 within less than the whole range of the controls.
    pub at_least: usize,
}

/// Every window by itself, but that the arrays do not move where they are held.
pub(super) fn single(model: &Model<'_>) -> Vec<usize> {
    (0..model.windows.len()).collect()
}

/// Whether some controls of a part keep this much of the limit; `ranges` are the share of it that is left, and that of every control's range.
fn is_kept(of: Formulation<'_>, part: Part, ranges: [f64; 2], scale: f64) -> bool {
    let mut program = of.program(part, ranges);
    program.steps.iter_mut().for_each(|step| step.limit *= scale);
    let found = program.solve(Goal::LeastExcess);
    found.is_some_and(|it| it.excess <= KEPT * of.model.limit.momentum_n_m_s)
}

/// The greatest number in a range for which what holds for less holds, found by going ahead in doubled strides; `low` holds.
fn farthest(low: usize, high: usize, mut holds: impl FnMut(usize) -> bool) -> usize {
    let (mut good, mut stride) = (low, 1);
    let mut bad = high + 1;
    while good < high {
        let next = (good + stride).min(high);
        if holds(next) {
            (good, stride) = (next, 2 * stride);
        } else {
            bad = next;
            break;
        }
    }
    while bad - good > 1 {
        let middle = good + (bad - good) / 2;
        if holds(middle) { good = middle } else { bad = middle }
    }
    good
}

/// The farthest step up to which a part from `from` on has controls that keep the limit.
fn farthest_kept(of: Formulation<'_>, (from, free): (usize, bool), ranges: [f64; 2], scale: f64) -> usize {
    let holds = |to: usize| is_kept(of, Part { steps: [from, to], free }, ranges, scale);
    farthest(from, of.model.instants.len(), holds)
}

/// Ends of the parts between dumps, in steps; `None` where one step alone exceeds the limit.
fn parts(model: &Model<'_>, guard: f64, scale: f64, most: usize) -> Option<Vec<usize>> {
    let leaders = single(model);
    let of = Formulation { model, leaders: &leaders };
    let mut ends = Vec::new();
    let mut from = 0;
    while from < model.instants.len() {
        if ends.len() > most {
            return None;
        }
        // Where the limit is exceeded at once nothing is to be dumped yet.
        let to = farthest_kept(of, (from, from > 0), [guard, WHOLE], scale);
        if to == from {
            return None;
        }
        ends.push(to);
        from = to;
    }
    Some(ends)
}

/// Dumps that no plan on the baseline can do without: each falls somewhere in the step that no relaxed programme reaches the end of.
fn least_dumps(model: &Model<'_>) -> usize {
    let (leaders, count) = (single(model), model.instants.len());
    let (mut from, mut dumps) = (0, 0);
    while from < count {
        let of = Formulation { model, leaders: &leaders };
        let to = farthest_kept(of, (from, dumps > 0), [0.0, WHOLE], 1.0);
        if to >= count {
            break;
        }
        (from, dumps) = (to + 1, dumps + 1);
    }
    dumps
}

/// The fewest dumps about the model's controls; `None` where dumps do not help.
pub(super) fn fewest_dumps(model: &Model<'_>, guard: f64, progress: &mut dyn FnMut()) -> Option<Dumps> {
    let ends = parts(model, guard, 1.0, usize::MAX - 1)?;
    let count = ends.len() - 1;
    progress();
    let (mut best, mut low, mut high) = (ends, 0.3, 1.0);
    if count > 0 {
        for _ in 0..5 {
            let scale = 0.5 * (low + high);
            match parts(model, guard, scale, count) {
                Some(ends) if ends.len() == count + 1 => (best, high) = (ends, scale),
                _ => low = scale,
            }
            progress();
        }
    }
    best.pop();
    let at_least = least_dumps(model).min(count);
    let rows = best.into_iter().filter_map(|end| model.instants.get(end - 1).copied()).collect();
    Some(Dumps { rows, at_least })
}

/// The end of the first step up to which no controls are found that keep the limit without a dump, in s; `None` where some do throughout.
/// Other controls may keep it longer: the model is linear.
pub(super) fn first_exceeded_s(model: &Model<'_>) -> Option<f64> {
    let leaders = single(model);
    let of = Formulation { model, leaders: &leaders };
    let kept = farthest_kept(of, (0, false), [GUARD, WHOLE], 1.0);
    model.instants.get(kept).map(|row| model.simulated.rows[*row].time_s)
}

/// Searches the places of the changes.
struct Search<'m> {
    model: &'m Model<'m>,
    /// Share of the limit that is left, and of every control's range about its present value.
    ranges: [f64; 2],
    /// Windows that begin a group in any case.
    forced: Vec<bool>,
    /// First step of every window, and behind the last.
    steps: Vec<usize>,
    until: Instant,
    reached: HashMap<usize, usize>,
}

impl Search<'_> {
    fn leaders(&self, changes: &[usize], single_from: usize) -> Vec<usize> {
        let mut leader = 0;
        let begins =
            |window: usize| self.forced[window] || changes.contains(&window) || window >= single_from;
        (0..self.forced.len())
            .map(|window| {
                if begins(window) {
                    leader = window;
                }
                leader
            })
            .collect()
    }

    fn is_kept(&self, leaders: &[usize], part: Part) -> bool {
        is_kept(Formulation { model: self.model, leaders }, part, self.ranges, 1.0)
    }

    /// Whether a plan exists with these changes, all windows from one on by themselves.
    fn is_open(&self, changes: &[usize], single_from: usize) -> bool {
        self.is_kept(&self.leaders(changes, single_from), Part::whole(self.model))
    }

    /// The window up to which those from `from` on can share their arrays, whatever comes before and after.
    fn reach_alone(&mut self, from: usize) -> usize {
        if let Some(to) = self.reached.get(&from) {
            return *to;
        }
        let leaders = self.leaders(&[from], usize::MAX);
        let to = farthest(from, self.forced.len(), |to| {
            let part = Part { steps: [self.steps[from], self.steps[to]], free: from > 0 };
            part.steps[0] >= part.steps[1] || self.is_kept(&leaders, part)
        });
        let to = to.max(from + 1);
        self.reached.insert(from, to);
        to
    }

    /// Changes that windows from one on need beside the forced ones.
    fn at_least_from(&mut self, from: usize) -> usize {
        let (mut at, mut count) = (from, 0);
        loop {
            let to = self.reach_alone(at);
            if to >= self.forced.len() {
                return count;
            }
            (at, count) = (to, count + 1);
        }
    }

    /// The last place of the next change behind `changes`; the number of windows where none is needed.
    fn reach(&self, changes: &[usize]) -> usize {
        let from = changes.last().copied().unwrap_or(0);
        farthest(from + 1, self.forced.len(), |to| self.is_open(changes, to))
    }

    fn greedy(&self, progress: &mut dyn FnMut()) -> Vec<usize> {
        let mut changes = Vec::new();
        loop {
            let next = self.reach(&changes);
            progress();
            if next >= self.forced.len() {
                return changes;
            }
            changes.push(next);
        }
    }

    /// Searches a plan with that many more changes; `None` where there is none or the time is over.
    fn descend(
        &mut self,
        changes: &mut Vec<usize>,
        left: usize,
        progress: &mut dyn FnMut(),
    ) -> Option<Vec<usize>> {
        if Instant::now() >= self.until {
            return None;
        }
        progress();
        let farthest = self.reach(changes);
        if farthest >= self.forced.len() {
            return Some(changes.clone());
        }
        if left == 0 {
            return None;
        }
        let from = changes.last().copied().unwrap_or(0);
        for next in (from + 1..=farthest).rev() {
            if self.at_least_from(next) > left - 1 {
                break;
            }
            changes.push(next);
            let found = self.descend(changes, left - 1, progress);
            changes.pop();
            if found.is_some() {
                return found;
            }
        }
        None
    }
}

/// The fewest changes of the arrays with which the limits are kept within a range about the model's controls, sought until a time;
/// `None` where not even a change at every window keeps them.
pub(super) fn fewest_changes(
    model: &Model<'_>,
    ranges: [f64; 2],
    until: Instant,
    progress: &mut dyn FnMut(),
) -> Option<Groups> {
    let windows = &model.windows;
    let is_forced = |window: usize| {
        window == 0
            || windows[window - 1].kind == WindowKind::Frozen
            || windows[window].kind == WindowKind::Frozen
            || windows[window].baseline_rad != windows[window - 1].baseline_rad
    };
    let forced: Vec<bool> = (0..windows.len()).map(is_forced).collect();
    let has_arrays = windows.iter().any(|window| !window.sides.is_empty());
    let base = if has_arrays { forced.iter().filter(|it| **it).count().saturating_sub(1) } else { 0 };
    let mut steps = vec![0; windows.len() + 1];
    let mut window = 0;
    for (step, &row) in model.instants.iter().enumerate() {
        let end_s = model.simulated.rows[row].time_s;
        while window < windows.len() && windows[window].stop_s <= end_s + SAME_S {
            window += 1;
            steps[window] = step + 1;
        }
    }
    let search = |ranges: [f64; 2]| {
        let (forced, steps) = (forced.clone(), steps.clone());
        Search { model, ranges, forced, steps, until, reached: HashMap::new() }
    };
    let (mut search, mut proof) = (search(ranges), search([0.0, WHOLE]));
    if !windows.iter().any(|window| ARRAYS.iter().any(|control| window.moves(*control))) {
        let leaders = search.leaders(&[], usize::MAX);
        return Some(Groups { leaders, changes: base, at_least: base });
    }
    if !search.is_open(&[], 0) {
        return None;
    }
    let mut best = search.greedy(progress);
    let is_over = || Instant::now() >= until;
    for count in search.at_least_from(0)..best.len() {
        match search.descend(&mut Vec::new(), count, progress) {
            Some(found) => {
                best = found;
                break;
            }
            None if is_over() => break,
            None => {}
        }
    }
    let at_least = match ranges[1] < WHOLE {
        true => 0,
        false => {
            let mut at_least = proof.at_least_from(0);
            while at_least < best.len()
                && proof.descend(&mut Vec::new(), at_least, progress).is_none()
                && !is_over()
            {
                at_least += 1;
            }
            base + at_least.min(best.len())
        }
    };
    Some(Groups { leaders: search.leaders(&best, usize::MAX), changes: base + best.len(), at_least })
}

#[cfg(test)]
mod tests;

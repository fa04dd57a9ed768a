//! Programmes of a linear model: bounds, steps, target, corridor and costs of the controls over a part of a flight.

use nalgebra::Vector3;
use physics::constants::DAY_S;

use super::{
    baseline::meet,
    cell::Cell,
    controls::{ALL, ALTERNATE_PLACE, ARRAYS, CONTROLS, Control, PLACE},
    model::{Model, UNJUDGED},
    program::{Begin, Program, Step},
    relaxed::{Placed, relax},
    target::LinearMiss,
    windows::WindowKind,
};

/// Cost of a day in the alternate attitude or of a radian of windmilling, against a day with a radian of tilt.
const SLIGHT: f64 = 1e-3;

/// Part of the flight that a programme covers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Part {
    /// Its first and its behind-last step.
    pub steps: [usize; 2],
    /// Whether it may begin with any momentum.
    pub free: bool,
}

impl Part {
    /// The whole flight of a model.
    pub(super) fn whole(model: &Model<'_>) -> Self {
        Self { steps: [0, model.instants.len()], free: false }
    }
}

/// Index of a control in the programmes, the arrays of every window standing as those of its leader.
pub(super) fn index(leaders: &[usize], window: usize, control: Control) -> usize {
    let of = if ARRAYS.contains(&control) { leaders[window] } else { window };
    CONTROLS * of + control as usize
}

/// A model whose arrays stand alike in every window and its leader.
#[derive(Clone, Copy)]
pub(super) struct Formulation<'m> {
    pub model: &'m Model<'m>,
    pub leaders: &'m [usize],
}

impl Formulation<'_> {
    fn indices<const N: usize>(&self, window: usize, controls: [Control; N]) -> [usize; N] {
        controls.map(|control| index(self.leaders, window, control))
    }

    /// Whether the arrays of every window stand as those of its leader.
    pub(super) fn is_kept(&self) -> bool {
        let windows = &self.model.windows;
        windows.iter().zip(self.leaders).all(|(window, leader)| {
            let leader = &windows[*leader].controls;
            ARRAYS.iter().all(|it| (window.controls.get(*it) - leader.get(*it)).abs() < 1e-9)
        })
    }

    /// Present controls by their indices.
    pub(super) fn controls(&self) -> Vec<f64> {
        let mut all = vec![0.0; CONTROLS * self.model.windows.len()];
        for (number, window) in self.model.windows.iter().enumerate() {
            for control in ALL {
                all[index(self.leaders, number, control)] = window.controls.get(control);
            }
        }
        all
    }

    /// The programme of a part; `guard` is a share of the limit that is left (0: a relaxed programme, for bounds from below), `trust` the
    /// share of each control's range by which it may leave its present value.
    pub(super) fn program(&self, part: Part, [guard, trust]: [f64; 2]) -> Program {
        let model = self.model;
        let steps = self.steps(part, guard);
        let mut program =
            Program { size: model.limit.size, bounds: self.bounds(trust), steps, ..Program::default() };
        if part == Part::whole(model)
            && let (Some(targeting), Some(miss)) = (&model.targeting, self.linear_miss())
        {
            program.targets = targeting.target.rows(&miss, model.limit.momentum_n_m_s);
        }
        self.add_corridor(&mut program);
        if guard <= 0.0 {
            let placed: Vec<Placed> = (part.steps[0]..part.steps[1]).map(|step| self.placed(step)).collect();
            let unjudged_n_m_s = UNJUDGED * model.limit.momentum_n_m_s;
            relax(&mut program, &placed, &model.windows, &model.departures_n_m, unjudged_n_m_s);
        }
        self.add_costs(&mut program);
        program
    }

    /// Bounds of the controls by their indices.
    fn bounds(&self, trust: f64) -> Vec<[f64; 2]> {
        let mut bounds: Vec<Option<[f64; 2]>> = vec![None; CONTROLS * self.model.windows.len()];
        for (number, window) in self.model.windows.iter().enumerate() {
            for control in ALL {
                let [low, high] = window.bounds[control as usize];
                let present = window.controls.get(control);
                let reach = trust * (high - low);
                let own = [low.max(present - reach), high.min(present + reach)];
                let all = &mut bounds[index(self.leaders, number, control)];
                *all = Some(all.map_or(own, |all| meet(all, own)));
            }
        }
        bounds.into_iter().map(Option::unwrap_or_default).collect()
    }

    /// Lengths and magnitudes that cost, and the places of the Sun that are allowed.
    fn add_costs(&self, program: &mut Program) {
        for (number, window) in self.model.windows.iter().enumerate() {
            if window.kind != WindowKind::Free {
                continue;
            }
            let days = (window.stop_s - window.start_s) / DAY_S;
            let own = self.indices(number, ALTERNATE_PLACE);
            let is_apart = own.iter().any(|at| program.moves(*at));
            let alternate = if is_apart { 0.5 * window.bounds[Control::Alternate as usize][1] } else { 0.0 };
            program.lengths.extend(is_apart.then_some((own, days * alternate)));
            let pair = self.indices(number, PLACE);
            if pair.iter().any(|at| program.moves(*at)) {
                program.lengths.push((pair, days * (1.0 - alternate)));
                let sides = window.places.iter();
                program.sums.extend(sides.map(|side| (side.terms(pair), side.most)));
            }
            // Behind the tilt: a hundredth of a degree, not to alternate or windmill for nothing.
            let slight = self.indices(number, [Control::Alternate, Control::Windmill]);
            program.magnitudes.extend(slight.map(|at| (at, SLIGHT * days)));
        }
    }

    fn placed(&self, step: usize) -> Placed {
        let model = self.model;
        let [from, to] = model.rows_of(step);
        let window = model.cells[to - 1].window;
        let is_other = |cell: Option<&Cell>| cell.is_none_or(|cell| cell.window != window);
        Placed {
            window,
            begins: is_other(from.checked_sub(1).and_then(|before| model.cells.get(before))),
            ends: is_other(model.cells.get(to)),
            duration_s: model.simulated.rows[to].time_s - model.simulated.rows[from].time_s,
        }
    }

    fn steps(&self, part: Part, guard: f64) -> Vec<Step> {
        let (allowed, shares) = (self.model.allowed_n_m_s(), self.model.guard_shares());
        let steps = part.steps[0]..part.steps[1];
        steps
            .map(|step| {
                let [from, to] = self.model.rows_of(step);
                let mut begin = match step == part.steps[0] {
                    true if part.free => Begin::Free,
                    // A part that does not begin freely is the flight's beginning.
                    true => Begin::At(self.model.simulated.rows[from].momentum_n_m_s),
                    false => Begin::Follows,
                };
                if self.model.dumps.iter().any(|(row, _)| *row == from) {
                    begin = Begin::Free;
                }
                let share = if part.free { 1.0 } else { shares[to] };
                let left_n_m_s = guard * share * self.model.limit.momentum_n_m_s;
                let between_n_m_s = if guard > 0.0 { self.model.between[step] } else { 0.0 };
                let limit = allowed[to] - left_n_m_s - between_n_m_s;
                self.step(from..to, Step { begin, drift: Vector3::zeros(), terms: Vec::new(), limit })
            })
            .collect()
    }

    /// A step with what its cells gain.
    fn step(&self, cells: core::ops::Range<usize>, mut step: Step) -> Step {
        for at in cells {
            let cell = &self.model.cells[at];
            if let Some(after) = cell.reset {
                step.begin = Begin::At(after);
                continue;
            }
            step.drift += cell.gain + self.model.corrections[at];
            let controls = &self.model.windows[cell.window].controls;
            for control in ALL {
                let gain = cell.by_control[control as usize];
                if gain == Vector3::zeros() {
                    continue;
                }
                step.drift -= gain * controls.get(control);
                let at = index(self.leaders, cell.window, control);
                match step.terms.iter_mut().find(|(index, _)| *index == at) {
                    Some((_, sum)) => *sum += gain,
                    None => step.terms.push((at, gain)),
                }
            }
        }
        step
    }

    /// Miss of the target as linear in the controls: constant, and by unit of each.
    pub(super) fn linear_miss(&self) -> Option<LinearMiss> {
        let mut constant = self.model.miss()?;
        let mut by = vec![Vector3::zeros(); CONTROLS * self.model.windows.len()];
        for cell in &self.model.cells {
            let controls = &self.model.windows[cell.window].controls;
            for control in ALL {
                let moves = cell.moves.by_control[control as usize];
                constant -= moves * controls.get(control);
                by[index(self.leaders, cell.window, control)] += moves;
            }
        }
        let moved = by.into_iter().enumerate().filter(|(_, by)| *by != Vector3::zeros());
        Some(LinearMiss { constant, terms: moved.collect() })
    }

    /// The light on the cells of every panel within its corridor.
    fn add_corridor(&self, program: &mut Program) {
        for (number, window) in self.model.windows.iter().enumerate() {
            let [offset, windmill] = self.indices(number, ARRAYS);
            if !program.moves(windmill) && !program.moves(offset) {
                continue;
            }
            for &side in &window.sides {
                let [low, high] = window.offsets_rad;
                program.sums.push((vec![(offset, 1.0), (windmill, side)], high));
                program.sums.push((vec![(offset, -1.0), (windmill, -side)], -low));
            }
        }
    }
}

//! Linear model of a flight: momentum gained from row to row in windows, by unit of each control of each window.
//!
//! Between two rows of the flight the momentum gained is the mean of both torques times the time (trapezoid), about the present controls;
//! what a flight through the FMU gained more with the same controls is added. So the model agrees with the last flight whatever effects
//! that had, and its derivatives are those of sunlight.

use nalgebra::{Matrix3, Matrix3x4, Matrix4, SymmetricEigen, Vector3};
use physics::constants::DAY_S;

use super::{
    cell::{At, Cell, cell, guard_shares, instants},
    program::{Begin, Program, Step},
    relaxed::{Placed, departures_n_m, relax},
    simulated::{FlightRow, MomentumSize, SAME_S, SimulatedFlight},
    target::{LinearMiss, Target, Targeting},
    torque::{ALL, CONTROLS, Control, SunlitSpacecraft},
    windows::{Window, WindowKind},
};

/// Deviations of the refit's errors that the margin holds.
const SIGMAS: f64 = 3.0;

/// Limit of the momentum.
#[derive(Clone, Debug, PartialEq)]
pub struct Limit {
    /// Greatest |H|, in N m s.
    pub momentum_n_m_s: f64,
    /// Measure of |H|.
    pub size: MomentumSize,
    /// Share of it that is left.
    pub margin: f64,
    /// Covariance of the centre of mass (body frame, m) and of the scale of sunlight, where a refit gave it.
    pub covariance: Option<Matrix4<f64>>,
}

/// A flight with windows, linear in their controls.
#[derive(Clone, Debug)]
pub(super) struct Model {
    /// Geometry, with rows at all edges.
    pub simulated: SimulatedFlight,
    /// The windows.
    pub windows: Vec<Window>,
    /// The limit.
    pub limit: Limit,
    /// Before this time nothing is judged, in s.
    pub judged_from_s: f64,
    /// Rows at which planned dumps leave any momentum, with what they leave.
    pub dumps: Vec<(usize, Vector3<f64>)>,
    targeting: Option<Targeting>,
    cells: Vec<Cell>,
    /// Momentum that the last flight gained beyond the model, by cell.
    corrections: Vec<Vector3<f64>>,
    /// Last rows of the programme's steps.
    instants: Vec<usize>,
    /// By how much |H| between instants exceeds that at them, by step.
    between: Vec<f64>,
    /// By how much the torque of every window departs from the model at most, in N m; nothing unless it was looked at.
    departures_n_m: Vec<Vector3<f64>>,
}

/// Part of the flight that a programme covers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Part {
    /// Its first and its behind-last step.
    pub steps: [usize; 2],
    /// Whether it may begin with any momentum.
    pub free: bool,
}

impl Model {
    /// About the controls of the windows.
    pub(super) fn new(
        sunlit: &SunlitSpacecraft,
        simulated: SimulatedFlight,
        windows: Vec<Window>,
        limit: Limit,
    ) -> Self {
        let edges_s: Vec<f64> = windows.iter().flat_map(Window::edges_s).collect();
        let simulated = simulated.with_rows_at(&edges_s);
        let mut model = Self {
            corrections: vec![Vector3::zeros(); simulated.rows.len().saturating_sub(1)],
            simulated,
            windows,
            limit,
            judged_from_s: f64::NEG_INFINITY,
            dumps: Vec::new(),
            targeting: None,
            cells: Vec::new(),
            instants: Vec::new(),
            between: Vec::new(),
            departures_n_m: Vec::new(),
        };
        model.linearise(sunlit);
        model.instants = instants(&model.cells, &model.windows, &model.simulated.rows);
        model.between = vec![0.0; model.instants.len()];
        model
    }

    /// With a target of the plan, where the flight had an encounter.
    pub(super) fn set_target(&mut self, sunlit: &SunlitSpacecraft, target: Option<Target>) {
        let encountered = self.simulated.encountered.clone();
        self.targeting = target.zip(encountered).map(|(target, encountered)| Targeting {
            target,
            encountered,
            simulated: Vector3::zeros(),
        });
        // From their own first time on.
        self.cells.clear();
        self.linearise(sunlit);
        // The flight of the mission had its own arrays and attitudes.
        let simulated = self.recorded_moves(sunlit);
        if let Some(targeting) = &mut self.targeting {
            targeting.simulated = simulated;
        }
    }

    /// Returns the change of the target by sunlight as it was recorded, where windows are not frozen.
    fn recorded_moves(&self, sunlit: &SunlitSpacecraft) -> Vector3<f64> {
        let Some(targeting) = &self.targeting else { return Vector3::zeros() };
        let rows = self.simulated.rows.iter();
        let rates: Vec<_> = rows
            .map(|row| targeting.by_impulse(sunlit, row) * sunlit.simulated(row).normal.force_n)
            .collect();
        let cells = self.cells.iter().enumerate();
        let free = cells.filter(|(_, cell)| self.windows[cell.window].kind != WindowKind::Frozen);
        free.map(|(index, _)| {
            let duration_s = self.simulated.rows[index + 1].time_s - self.simulated.rows[index].time_s;
            (rates[index] + rates[index + 1]) * (0.5 * duration_s)
        })
        .sum()
    }

    fn moves(&self) -> Vector3<f64> {
        self.cells.iter().map(|cell| cell.moves.at).sum()
    }

    /// Miss of the target at the present controls; `None` without one.
    pub(super) fn miss(&self) -> Option<Vector3<f64>> {
        let targeting = self.targeting.as_ref()?;
        Some(targeting.encountered.miss + self.moves() - targeting.simulated)
    }

    /// Anew about the present controls.
    pub(super) fn linearise(&mut self, sunlit: &SunlitSpacecraft) {
        let rows = &self.simulated.rows;
        let mut cells = Vec::with_capacity(rows.len());
        let mut window = 0;
        // The end of a cell is the beginning of the next one in the same window.
        let mut last: Option<(usize, usize, At)> = None;
        for index in 0..rows.len().saturating_sub(1) {
            let middle_s = 0.5 * (rows[index].time_s + rows[index + 1].time_s);
            while window + 1 < self.windows.len() && self.windows[window].stop_s < middle_s {
                window += 1;
            }
            let of = &self.windows[window];
            // What stays is known from the first time on.
            if of.kind == WindowKind::Frozen
                && let Some(cell) = self.cells.get(index)
            {
                cells.push(cell.clone());
                continue;
            }
            let share = of.alternate_at(middle_s);
            // What stays moves nothing.
            let targeting = self.targeting.as_ref().filter(|_| of.kind != WindowKind::Frozen);
            let by_impulse = |row: &FlightRow| {
                targeting.map_or_else(Matrix3::zeros, |targeting| targeting.by_impulse(sunlit, row))
            };
            let from = match last.take() {
                Some((at_window, at, value)) if at_window == window && at == index => value,
                _ => At::new(sunlit, &rows[index], of, by_impulse(&rows[index])),
            };
            let to = At::new(sunlit, &rows[index + 1], of, by_impulse(&rows[index + 1]));
            cells.push(cell(window, of, [&rows[index], &rows[index + 1]], [&from, &to], share));
            last = Some((window, index + 1, to));
        }
        self.cells = cells;
    }

    /// The whole flight as a part.
    pub(super) fn whole(&self) -> Part {
        Part { steps: [0, self.instants.len()], free: false }
    }

    /// The rows at which the programme's steps end.
    pub(super) fn instants(&self) -> &[usize] {
        &self.instants
    }

    /// Takes a share of what a flight of the present controls gained beyond the model, and how it missed the target.
    pub(super) fn take(&mut self, sunlit: &SunlitSpacecraft, flight: &SimulatedFlight, share: f64) {
        let momentum = |row: &FlightRow| flight.momentum_n_m_s(row.time_s);
        let count_at = |time_s: f64| {
            let after = flight.rows.partition_point(|row| row.time_s <= time_s + SAME_S);
            after.checked_sub(1).and_then(|at| flight.rows.get(at)).map_or(0, |row| row.dumps)
        };
        for (index, cell) in self.cells.iter().enumerate() {
            let [from, to] = [&self.simulated.rows[index], &self.simulated.rows[index + 1]];
            if cell.reset.is_some() || count_at(from.time_s - 2.0 * SAME_S) != count_at(to.time_s) {
                continue;
            }
            let gained = momentum(to) - momentum(from) - cell.gain;
            self.corrections[index] = self.corrections[index].lerp(&gained, share);
        }
        if let (Some(targeting), Some(encountered)) = (&mut self.targeting, &flight.encountered) {
            targeting.encountered = encountered.clone();
            self.linearise(sunlit);
            let simulated = self.moves();
            if let Some(targeting) = &mut self.targeting {
                targeting.simulated = simulated;
            }
        }
    }

    /// Whether the mission dumps in a cell that ends or begins there.
    pub(super) fn is_reset_at(&self, time_s: f64) -> bool {
        let is_at = |row: usize| (self.simulated.rows[row].time_s - time_s).abs() <= SAME_S;
        let cells = self.cells.iter().enumerate();
        cells.filter(|(_, cell)| cell.reset.is_some()).any(|(index, _)| is_at(index) || is_at(index + 1))
    }

    /// Momentum at every row by the model at the present controls, in N m s.
    pub(super) fn momentum_n_m_s(&self) -> Vec<Vector3<f64>> {
        let mut at = self.simulated.rows.first().map_or_else(Vector3::zeros, |row| row.momentum_n_m_s);
        let mut all = vec![at];
        for (index, cell) in self.cells.iter().enumerate() {
            if let Some((_, after)) = self.dumps.iter().find(|(row, _)| *row == index) {
                at = *after;
            }
            at = cell.reset.unwrap_or(at + cell.gain + self.corrections[index]);
            all.push(at);
        }
        all
    }

    /// Returns the largest |H| that is allowed at every row: the limit less its margin, in N m s.
    pub(super) fn allowed_n_m_s(&self) -> Vec<f64> {
        let limit = &self.limit;
        let most = limit.momentum_n_m_s * (1.0 - limit.margin);
        let judged = |row: usize, allowed: f64| {
            let is_judged = self.simulated.rows[row].time_s >= self.judged_from_s - SAME_S;
            if is_judged { allowed } else { allowed + UNJUDGED * limit.momentum_n_m_s }
        };
        let rows = self.simulated.rows.len();
        let Some(covariance) = limit.covariance else {
            return (0..rows).map(|row| judged(row, most)).collect();
        };
        let mut by_error = Matrix3x4::zeros();
        let mut all = vec![most];
        for (index, cell) in self.cells.iter().enumerate() {
            if cell.reset.is_some() || self.dumps.iter().any(|(row, _)| *row == index) {
                by_error = Matrix3x4::zeros();
            }
            by_error += cell.by_error;
            let of_momentum = by_error * covariance * by_error.transpose();
            let variance = SymmetricEigen::new(of_momentum).eigenvalues.max().max(0.0);
            all.push(most - SIGMAS * variance.sqrt());
        }
        all.into_iter().enumerate().map(|(row, allowed)| judged(row, allowed)).collect()
    }

    /// By how much |H| exceeds what is allowed at the worst row, in N m s, and that row; the target's excess counts as at the last.
    pub(super) fn excess_n_m_s(&self) -> (f64, usize) {
        self.excess_beyond_n_m_s(0.0)
    }

    /// The same where this share of the limit is left too.
    pub(super) fn excess_beyond_n_m_s(&self, guard: f64) -> (f64, usize) {
        let limit_n_m_s = self.limit.momentum_n_m_s;
        let momentum = self.momentum_n_m_s();
        let rows = momentum.iter().zip(self.allowed_n_m_s()).zip(self.guard_shares());
        let over = rows.map(|((momentum, allowed), share)| {
            self.limit.size.size(momentum) - allowed + share * guard * limit_n_m_s
        });
        let of_target =
            self.targeting.as_ref().zip(self.miss()).map(|(targeting, miss)| {
                targeting.target.excess_n_m_s(&miss, limit_n_m_s) + guard * limit_n_m_s
            });
        let all = over.enumerate().chain(of_target.map(|over| (self.cells.len(), over)));
        let least = (f64::NEG_INFINITY, 0);
        all.fold(least, |worst, (row, over)| if over > worst.0 { (over, row) } else { worst })
    }

    fn guard_shares(&self) -> Vec<f64> {
        let is_dump = |row: usize| self.dumps.iter().any(|(at, _)| *at == row);
        guard_shares(&self.cells, &self.windows, &self.simulated.rows, is_dump)
    }

    /// Looks at how far |H| goes between the instants.
    pub(super) fn look_between(&mut self) {
        let momentum: Vec<f64> = self.momentum_n_m_s().iter().map(|it| self.limit.size.size(it)).collect();
        let allowed = self.allowed_n_m_s();
        let over = |row: usize| momentum[row] - allowed[row];
        let mut from = 0;
        for (step, &to) in self.instants.iter().enumerate() {
            let inside = (from..=to).map(over).fold(f64::NEG_INFINITY, f64::max);
            self.between[step] = (inside - over(from).max(over(to))).max(0.0);
            from = to;
        }
        // What lies beyond an instant is held by it too.
        for step in 1..self.between.len() {
            self.between[step - 1] = self.between[step - 1].max(self.between[step]);
        }
    }

    /// Index of a control in the programmes.
    pub(super) fn index(leaders: &[usize], window: usize, control: Control) -> usize {
        let of = match control {
            Control::Offset | Control::Windmill => leaders[window],
            _ => window,
        };
        CONTROLS * of + control as usize
    }

    /// Whether the arrays of every window stand as those of its leader.
    pub(super) fn is_of(&self, leaders: &[usize]) -> bool {
        let same = |window: usize, control: Control| {
            let leader = &self.windows[leaders[window]].controls;
            (self.windows[window].controls.get(control) - leader.get(control)).abs() < 1e-9
        };
        (0..self.windows.len()).all(|it| same(it, Control::Offset) && same(it, Control::Windmill))
    }

    /// Present controls by their indices.
    pub(super) fn controls(&self, leaders: &[usize]) -> Vec<f64> {
        let mut all = vec![0.0; CONTROLS * self.windows.len()];
        for (index, window) in self.windows.iter().enumerate() {
            for control in ALL {
                all[Self::index(leaders, index, control)] = window.controls.get(control);
            }
        }
        all
    }

    /// The programme of a part, the arrays of every window standing as those of its leader; `guard` is a share of the limit that is
    /// left (0: a relaxed programme, for bounds from below), `trust` the share of
    /// each control's range by which it may leave its present value.
    pub(super) fn program(&self, leaders: &[usize], part: Part, [guard, trust]: [f64; 2]) -> Program {
        let bounds = vec![[0.0, 0.0]; CONTROLS * self.windows.len()];
        let mut program = Program { size: self.limit.size, bounds, ..Program::default() };
        let mut is_set = vec![false; program.bounds.len()];
        for (index, window) in self.windows.iter().enumerate() {
            for control in ALL {
                let at = Self::index(leaders, index, control);
                let [low, high] = window.bounds[control as usize];
                let present = window.controls.get(control);
                let reach = trust * (high - low);
                let own = [low.max(present - reach), high.min(present + reach)];
                let bounds = &mut program.bounds[at];
                *bounds = if is_set[at] { [bounds[0].max(own[0]), bounds[1].min(own[1])] } else { own };
                is_set[at] = true;
            }
        }
        self.add_steps(&mut program, leaders, part, guard);
        if !part.free && part.steps == [0, self.instants.len()] {
            self.add_target(&mut program, leaders);
        }
        self.add_corridor(&mut program, leaders);
        if guard <= 0.0 {
            let placed: Vec<Placed> = (part.steps[0]..part.steps[1]).map(|step| self.placed(step)).collect();
            let unjudged_n_m_s = UNJUDGED * self.limit.momentum_n_m_s;
            relax(&mut program, &placed, &self.windows, &self.departures_n_m, unjudged_n_m_s);
        }
        for (index, window) in self.windows.iter().enumerate() {
            if window.kind != WindowKind::Free {
                continue;
            }
            let days = (window.stop_s - window.start_s) / DAY_S;
            let own = [Control::AlternateAzimuth, Control::AlternateElevation]
                .map(|it| Self::index(leaders, index, it));
            let is_apart = own.iter().any(|at| program.bounds[*at][0] < program.bounds[*at][1]);
            let alternate = if is_apart { 0.5 * window.bounds[Control::Alternate as usize][1] } else { 0.0 };
            program.lengths.extend(is_apart.then_some((own, days * alternate)));
            let pair = [Control::Azimuth, Control::Elevation].map(|it| Self::index(leaders, index, it));
            let has_tilt = pair.iter().any(|at| program.bounds[*at][0] < program.bounds[*at][1]);
            if has_tilt {
                program.lengths.push((pair, days * (1.0 - alternate)));
                let sides = window.places.iter();
                program.sums.extend(sides.map(|side| (side.terms(pair), side.most)));
            }
            // Behind the tilt: a hundredth of a degree, not to alternate or windmill for nothing.
            for control in [Control::Alternate, Control::Windmill] {
                program.magnitudes.push((Self::index(leaders, index, control), SLIGHT * days));
            }
        }
        program
    }

    /// Looks at what the model leaves out about the present controls.
    pub(super) fn look_at_departures(&mut self, sunlit: &SunlitSpacecraft) {
        self.departures_n_m = departures_n_m(sunlit, &self.simulated, &self.windows);
    }

    fn placed(&self, step: usize) -> Placed {
        let [from, to] = [step.checked_sub(1).map_or(0, |before| self.instants[before]), self.instants[step]];
        let window = self.cells[to - 1].window;
        let is_other = |cell: Option<&Cell>| cell.is_none_or(|cell| cell.window != window);
        Placed {
            window,
            begins: is_other(from.checked_sub(1).and_then(|before| self.cells.get(before))),
            ends: is_other(self.cells.get(to)),
            duration_s: self.simulated.rows[to].time_s - self.simulated.rows[from].time_s,
        }
    }

    fn add_steps(&self, program: &mut Program, leaders: &[usize], part: Part, guard: f64) {
        let (allowed, shares) = (self.allowed_n_m_s(), self.guard_shares());
        let start = self.simulated.rows.first().map_or_else(Vector3::zeros, |row| row.momentum_n_m_s);
        for step in part.steps[0]..part.steps[1] {
            let from = step.checked_sub(1).map_or(0, |before| self.instants[before]);
            let to = self.instants[step];
            let mut begin = match step == part.steps[0] {
                true if part.free => Begin::Free,
                true if step == 0 => Begin::At(start),
                // A part that does not begin freely is the flight's beginning.
                true => Begin::At(self.simulated.rows[from].momentum_n_m_s),
                false => Begin::Follows,
            };
            if self.dumps.iter().any(|(row, _)| *row == from) {
                begin = Begin::Free;
            }
            let mut drift = Vector3::zeros();
            let mut terms: Vec<(usize, Vector3<f64>)> = Vec::new();
            for index in from..to {
                let cell = &self.cells[index];
                if let Some(after) = cell.reset {
                    begin = Begin::At(after);
                    continue;
                }
                drift += cell.gain + self.corrections[index];
                let controls = &self.windows[cell.window].controls;
                for control in ALL {
                    let gain = cell.by_control[control as usize];
                    if gain == Vector3::zeros() {
                        continue;
                    }
                    drift -= gain * controls.get(control);
                    let at = Self::index(leaders, cell.window, control);
                    match terms.iter_mut().find(|(index, _)| *index == at) {
                        Some((_, sum)) => *sum += gain,
                        None => terms.push((at, gain)),
                    }
                }
            }
            let share = if part.free { 1.0 } else { shares[to] };
            let left_n_m_s = guard * share * self.limit.momentum_n_m_s;
            let limit = allowed[to] - left_n_m_s - if guard > 0.0 { self.between[step] } else { 0.0 };
            program.steps.push(Step { begin, drift, terms, limit });
        }
    }

    /// Miss of the target as linear in the controls: constant, and by unit of each.
    pub(super) fn linear_miss(&self, leaders: &[usize]) -> Option<LinearMiss> {
        let mut constant = self.miss()?;
        let mut by = vec![Vector3::zeros(); CONTROLS * self.windows.len()];
        for cell in &self.cells {
            let controls = &self.windows[cell.window].controls;
            for control in ALL {
                let moves = cell.moves.by_control[control as usize];
                constant -= moves * controls.get(control);
                by[Self::index(leaders, cell.window, control)] += moves;
            }
        }
        let moved = by.into_iter().enumerate().filter(|(_, by)| *by != Vector3::zeros());
        Some(LinearMiss { constant, terms: moved.collect() })
    }

    fn add_target(&self, program: &mut Program, leaders: &[usize]) {
        let (Some(targeting), Some(miss)) = (&self.targeting, self.linear_miss(leaders)) else { return };
        program.targets = targeting.target.rows(&miss, self.limit.momentum_n_m_s);
    }

    /// The light on the cells of every panel within its corridor.
    fn add_corridor(&self, program: &mut Program, leaders: &[usize]) {
        for (index, window) in self.windows.iter().enumerate() {
            let [offset, windmill] =
                [Control::Offset, Control::Windmill].map(|it| Self::index(leaders, index, it));
            if program.bounds[windmill][0] >= program.bounds[windmill][1]
                && program.bounds[offset][0] >= program.bounds[offset][1]
            {
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

/// Limits by which nothing is judged, of the limit.
const UNJUDGED: f64 = 1e3;
/// Cost of a day in the alternate attitude or of a radian of windmilling, against a day with a radian of tilt.
const SLIGHT: f64 = 1e-3;

#[cfg(test)]
mod tests;

//! Linear model of a flight: momentum gained from row to row in windows, by unit of each control of each window.
//!
//! Between two rows of the flight the momentum gained is the mean of both torques times the time (trapezoid), about the present controls;
//! what a flight through the FMU gained more with the same controls is added. So the model agrees with the last flight whatever effects
//! that had, and its derivatives are those of sunlight.

use nalgebra::{Matrix3, Matrix3x4, Matrix4, SymmetricEigen, Vector3};

use super::{
    cell::{At, Cell, cell, instants},
    relaxed::departures_n_m,
    simulated::{FlightRow, MomentumSize, SAME_S, SimulatedFlight},
    target::{Target, Targeting},
    torque::SunlitSpacecraft,
    windows::{Window, WindowKind},
};

/// Deviations of the refit's errors that the margin holds.
const SIGMAS: f64 = 3.0;
/// Limit that never binds, of the limit.
pub(super) const UNJUDGED: f64 = 1e3;

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

impl Limit {
    /// The limit less its margin, in N m s.
    pub(super) fn kept_n_m_s(&self) -> f64 {
        self.momentum_n_m_s * (1.0 - self.margin)
    }
}

/// A flight with windows, linear in their controls.
#[derive(Clone, Debug)]
pub(super) struct Model<'a> {
    /// Spacecraft in sunlight.
    pub sunlit: &'a SunlitSpacecraft,
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
    /// The target and its last flight.
    pub targeting: Option<Targeting>,
    /// From row to row.
    pub cells: Vec<Cell>,
    /// Momentum that the last flight gained beyond the model, by cell.
    pub corrections: Vec<Vector3<f64>>,
    /// Last rows of the programme's steps.
    pub instants: Vec<usize>,
    /// By how much |H| between instants exceeds that at them, by step.
    pub between: Vec<f64>,
    /// By how much the torque of every window departs from the model at most, in N m; nothing unless it was looked at.
    pub departures_n_m: Vec<Vector3<f64>>,
}

impl<'a> Model<'a> {
    /// About the controls of the windows.
    pub(super) fn new(
        sunlit: &'a SunlitSpacecraft,
        simulated: SimulatedFlight,
        windows: Vec<Window>,
        limit: Limit,
    ) -> Self {
        let edges_s: Vec<f64> = windows.iter().flat_map(Window::edges_s).collect();
        let simulated = simulated.with_rows_at(&edges_s);
        let mut model = Self {
            sunlit,
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
        model.linearise();
        model.instants = instants(&model.cells, &model.windows, &model.simulated.rows);
        model.between = vec![0.0; model.instants.len()];
        model
    }

    /// With a target of the plan, where the flight had an encounter; `own` is that flight in windows of the mission's own controls, where
    /// they are known.
    pub(super) fn set_target(&mut self, target: Option<Target>, own: Option<Vec<Window>>) {
        let encountered = self.simulated.encountered.clone();
        self.targeting = target.zip(encountered).map(|(target, encountered)| Targeting {
            target,
            encountered,
            simulated: Vector3::zeros(),
        });
        // From their own first time on.
        self.cells.clear();
        self.linearise();
        // The flight of the mission had its own arrays and attitudes.
        let simulated = match own {
            Some(windows) => self.moves_by(windows),
            None => self.recorded_moves(),
        };
        if let Some(targeting) = &mut self.targeting {
            targeting.simulated = simulated;
        }
    }

    /// Returns the change of the target by sunlight in the mission's own windows, where they are not frozen. Its controls jump between
    /// rows and at them, and a row has one side of a jump alone: the mean of two rows would be off by half of the jump.
    fn moves_by(&self, windows: Vec<Window>) -> Vector3<f64> {
        if self.targeting.is_none() {
            return Vector3::zeros();
        }
        // The mission alternates in contacts too.
        let windows = windows.into_iter();
        let windows = windows.map(|it| Window { free_of_contact: vec![[it.start_s, it.stop_s]], ..it });
        let mut own = Self::new(self.sunlit, self.simulated.clone(), windows.collect(), self.limit.clone());
        own.targeting.clone_from(&self.targeting);
        own.cells.clear();
        own.linearise();
        own.moves()
    }

    /// Returns the change of the target by sunlight as it was recorded, where windows are not frozen.
    fn recorded_moves(&self) -> Vector3<f64> {
        let Some(targeting) = &self.targeting else { return Vector3::zeros() };
        let rows = self.simulated.rows.iter();
        let rates: Vec<_> = rows
            .map(|row| targeting.by_impulse(self.sunlit, row) * self.sunlit.simulated(row).normal.force_n)
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
    pub(super) fn linearise(&mut self) {
        let (sunlit, rows) = (self.sunlit, &self.simulated.rows);
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

    /// First and last row of a programme's step.
    pub(super) fn rows_of(&self, step: usize) -> [usize; 2] {
        [step.checked_sub(1).map_or(0, |before| self.instants[before]), self.instants[step]]
    }

    /// Takes a share of what a flight of the present controls gained beyond the model, and how it missed the target.
    pub(super) fn take(&mut self, flight: &SimulatedFlight, share: f64) {
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
            self.linearise();
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
        let most = limit.kept_n_m_s();
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

    /// Share of a guard that is left at every row: nothing while the flight is as the mission has it, growing to all over the first
    /// window that a plan moves, for what it cannot know grows with it; all behind a planned dump.
    pub(super) fn guard_shares(&self) -> Vec<f64> {
        let rows = &self.simulated.rows;
        let mut shares = vec![0.0];
        let mut share: f64 = 0.0;
        for (index, cell) in self.cells.iter().enumerate() {
            let window = &self.windows[cell.window];
            if self.dumps.iter().any(|(row, _)| *row == index) {
                share = 1.0;
            }
            if cell.reset.is_some() {
                share = 0.0;
            } else if window.kind != WindowKind::Frozen {
                let duration_s = rows[index + 1].time_s - rows[index].time_s;
                share = (share + duration_s / window.length_s().max(SAME_S)).min(1.0);
            }
            shares.push(share);
        }
        shares
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

    /// Looks at what the model leaves out about the present controls.
    pub(super) fn look_at_departures(&mut self) {
        self.departures_n_m = departures_n_m(self.sunlit, &self.simulated, &self.windows);
    }
}

#[cfg(test)]
mod tests;

//! Convex programme: momentum over time, linear in bounded controls, within a ball or a cube at every instant.
//!
//! h_j = h_(j-1) + d_j + sum_i g_ji x_i with |h_j| <= L_j, length or largest component: second-order cones, or six half-spaces, an
//! instant on sparse equations. Solved by the interior-point method of Clarabel (Goulart and Chen 2024) to a relative gap of 1e-8. Three questions are put:
//! Targets are sums of controls within bounds that excess widens, each by its own measure.
//!
//! - the least excess, min t with |h_j| <= L_j + t: a negative one is what is left below every limit;
//! - within the limits, the least sum of the lengths of pairs of controls and of a linear cost;
//! - within the limits, the greatest linear gain.

use clarabel::{
    algebra::CscMatrix,
    solver::{
        DefaultSettingsBuilder, DefaultSolver, IPSolver, SolverStatus,
        SupportedConeT::{self, NonnegativeConeT, SecondOrderConeT, ZeroConeT},
    },
};
use nalgebra::Vector3;

use super::simulated::MomentumSize;

/// Share of the limit that a plan leaves, for what it cannot know before the flight.
pub(super) const GUARD: f64 = 0.01;
/// Share of every control's range about its present value: all of it.
pub(super) const WHOLE: f64 = 1.0;

/// How a step's momentum begins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Begin {
    /// End of the step before.
    Follows,
    /// At this momentum, in N m s.
    At(Vector3<f64>),
    /// Anywhere within the step's limit.
    Free,
}

/// From one instant to the next.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Step {
    /// How it begins.
    pub begin: Begin,
    /// Momentum gained with every control at 0, in N m s.
    pub drift: Vector3<f64>,
    /// Momentum gained by unit of a control, by its index.
    pub terms: Vec<(usize, Vector3<f64>)>,
    /// Greatest |h| at its end, in N m s.
    pub limit: f64,
}

/// A sum of controls that is kept near zero.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct TargetRow {
    /// With every control at 0.
    pub constant: f64,
    /// By unit of a control, by its index.
    pub terms: Vec<(usize, f64)>,
    /// How far it may be off zero.
    pub within: f64,
    /// By how much farther for each N m s of excess.
    pub per_excess: f64,
}

impl TargetRow {
    /// By which controls exceed it, in N m s; negative within.
    pub(super) fn excess(&self, controls: &[f64]) -> f64 {
        let terms = self.terms.iter().map(|(index, by)| by * controls[*index]);
        ((self.constant + terms.sum::<f64>()).abs() - self.within) / self.per_excess
    }
}

/// A programme.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Program {
    /// Measure of |h|.
    pub size: MomentumSize,
    /// Least and greatest value of each control.
    pub bounds: Vec<[f64; 2]>,
    /// In the order of time.
    pub steps: Vec<Step>,
    /// Pairs of controls and what a unit of their length costs.
    pub lengths: Vec<([usize; 2], f64)>,
    /// Controls and what a unit costs, up or down.
    pub magnitudes: Vec<(usize, f64)>,
    /// Sums of controls by their weights, and the most that they may come to.
    pub sums: Vec<(Vec<(usize, f64)>, f64)>,
    /// Sums of controls near zero.
    pub targets: Vec<TargetRow>,
    /// Controls and what a unit of each gains.
    pub gains: Vec<(usize, f64)>,
}

/// Goal of a programme.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Goal {
    /// The least excess.
    LeastExcess,
    /// Least cost within the limits.
    LeastCost,
    /// Greatest gain within the limits.
    Farthest,
}

/// A solution.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Solution {
    /// Value of every control.
    pub controls: Vec<f64>,
    /// Momentum at the end of every step, in N m s.
    pub momentum: Vec<Vector3<f64>>,
    /// Momentum at the free beginnings, in their order, in N m s.
    pub begins: Vec<Vector3<f64>>,
    /// By which the worst instant exceeds its limit, in N m s; negative below.
    pub excess: f64,
}

/// A bounded control, in units of its own range; one whose bounds are apart has a column of the solver.
struct Moved {
    column: Option<usize>,
    middle: f64,
    half: f64,
}

impl Moved {
    fn new([low, high]: [f64; 2], columns: &mut usize) -> Self {
        let half = 0.5 * (high - low);
        let column = (half > 1e-12).then_some(*columns);
        *columns += usize::from(column.is_some());
        Self { column, middle: 0.5 * (low + high), half }
    }

    /// The entry of a row that has the control `by` times.
    fn entry(&self, by: f64) -> Option<(usize, f64)> {
        Some((self.column?, by * self.half))
    }

    fn value(&self, [low, high]: [f64; 2], found: &[f64]) -> f64 {
        self.column.map_or(self.middle, |column| (self.middle + self.half * found[column]).clamp(low, high))
    }
}

/// Columns of the solver's matrix for a goal, group by group.
struct Columns<'p> {
    moved: Vec<Moved>,
    /// First column of the momentum at the ends of the steps, and of that at the free beginnings.
    momentum: usize,
    begins: usize,
    free: usize,
    excess: Option<usize>,
    /// First column of a group and what it is of.
    lengths: (usize, &'p [([usize; 2], f64)]),
    magnitudes: (usize, Vec<&'p (usize, f64)>),
    count: usize,
}

impl<'p> Columns<'p> {
    fn new(program: &'p Program, goal: Goal) -> Self {
        let mut count = 0;
        let moved: Vec<Moved> = program.bounds.iter().map(|bounds| Moved::new(*bounds, &mut count)).collect();
        let costs = goal == Goal::LeastCost;
        let lengths = if costs { program.lengths.as_slice() } else { &[] };
        let magnitudes = program.magnitudes.iter();
        let magnitudes: Vec<_> =
            magnitudes.filter(|(index, _)| costs && moved[*index].column.is_some()).collect();
        let free = program.steps.iter().filter(|step| step.begin == Begin::Free).count();
        let mut take = |columns: usize| {
            count += columns;
            count - columns
        };
        Self {
            momentum: take(3 * program.steps.len()),
            begins: take(3 * free),
            free,
            excess: (goal == Goal::LeastExcess).then(|| take(1)),
            lengths: (take(lengths.len()), lengths),
            magnitudes: (take(magnitudes.len()), magnitudes),
            moved,
            count,
        }
    }

    /// Sum of terms with every control in the middle of its bounds.
    fn middles(&self, terms: &[(usize, f64)]) -> f64 {
        terms.iter().map(|(index, by)| by * self.moved[*index].middle).sum()
    }

    /// Entries of a row with `sign` times these terms.
    fn entries(&self, terms: &[(usize, f64)], sign: f64) -> impl Iterator<Item = (usize, f64)> {
        terms.iter().filter_map(move |(index, by)| self.moved[*index].entry(sign * by))
    }
}

/// Rows and columns of the solver's matrix, cone by cone.
#[derive(Default)]
struct Rows {
    triplets: (Vec<usize>, Vec<usize>, Vec<f64>),
    right: Vec<f64>,
    cones: Vec<SupportedConeT<f64>>,
}

impl Rows {
    /// A row a.x + s = b.
    fn row(&mut self, entries: impl IntoIterator<Item = (usize, f64)>, right: f64) {
        for (column, value) in entries {
            self.triplets.0.push(self.right.len());
            self.triplets.1.push(column);
            self.triplets.2.push(value);
        }
        self.right.push(right);
    }
}

impl Program {
    /// Whether the bounds of a control leave a choice.
    pub(super) fn moves(&self, control: usize) -> bool {
        let [low, high] = self.bounds[control];
        low < high
    }

    /// Returns the cost of controls.
    pub(super) fn cost(&self, controls: &[f64]) -> f64 {
        let lengths = self.lengths.iter().map(|([a, b], weight)| weight * controls[*a].hypot(controls[*b]));
        let magnitudes = self.magnitudes.iter().map(|(index, weight)| weight * controls[*index].abs());
        lengths.sum::<f64>() + magnitudes.sum::<f64>()
    }

    /// The answer; `None` where no controls are within their bounds, where the limits cannot be kept, or where the method fails.
    pub(super) fn solve(&self, goal: Goal) -> Option<Solution> {
        if self.bounds.iter().any(|[low, high]| low > high || low.is_nan() || high.is_nan()) {
            return None;
        }
        let columns = Columns::new(self, goal);
        if columns.count == 0 {
            return Some(Solution {
                controls: Vec::new(),
                momentum: Vec::new(),
                begins: Vec::new(),
                excess: f64::NEG_INFINITY,
            });
        }
        let mut rows = Rows::default();
        self.add_equations(&mut rows, &columns);
        self.add_inequalities(&mut rows, &columns);
        self.add_balls(&mut rows, &columns);
        let (first, lengths) = columns.lengths;
        for (at, (pair, _)) in lengths.iter().enumerate() {
            rows.row([(first + at, -1.0)], 0.0);
            for index in pair {
                rows.row(columns.moved[*index].entry(-1.0), columns.moved[*index].middle);
            }
            rows.cones.push(SecondOrderConeT(3));
        }
        let found = minimised(&self.objective(goal, &columns), rows)?;
        let vectors = |from: usize, count: usize| -> Vec<Vector3<f64>> {
            found[from..from + 3 * count].chunks_exact(3).map(Vector3::from_column_slice).collect()
        };
        let momentum = vectors(columns.momentum, self.steps.len());
        let over =
            momentum.iter().zip(&self.steps).map(|(momentum, step)| self.size.size(momentum) - step.limit);
        let controls = self.bounds.iter().zip(&columns.moved);
        let controls: Vec<f64> = controls.map(|(bounds, moved)| moved.value(*bounds, &found)).collect();
        let missed = self.targets.iter().map(|target| target.excess(&controls));
        Some(Solution {
            excess: over.chain(missed).fold(f64::NEG_INFINITY, f64::max),
            controls,
            begins: vectors(columns.begins, columns.free),
            momentum,
        })
    }

    /// Cost of a unit of every column.
    fn objective(&self, goal: Goal, columns: &Columns<'_>) -> Vec<f64> {
        let mut cost = vec![0.0; columns.count];
        if let Some(excess) = columns.excess {
            cost[excess] = 1.0;
        }
        for (at, (_, weight)) in columns.lengths.1.iter().enumerate() {
            cost[columns.lengths.0 + at] = *weight;
        }
        for (at, (_, weight)) in columns.magnitudes.1.iter().enumerate() {
            cost[columns.magnitudes.0 + at] = *weight;
        }
        if goal == Goal::Farthest {
            columns.entries(&self.gains, 1.0).for_each(|(column, gain)| cost[column] -= gain);
        }
        cost
    }

    /// h_j - h_(j-1) - sum g x = d.
    fn add_equations(&self, rows: &mut Rows, columns: &Columns<'_>) {
        let moved = &columns.moved;
        let mut begins = columns.begins;
        for (index, step) in self.steps.iter().enumerate() {
            let mut known = step.drift;
            let mut before = None;
            match step.begin {
                Begin::At(momentum) => known += momentum,
                Begin::Follows => before = index.checked_sub(1).map(|it| columns.momentum + 3 * it),
                Begin::Free => {
                    before = Some(begins);
                    begins += 3;
                }
            }
            for (control, gain) in &step.terms {
                known += gain * moved[*control].middle;
            }
            for axis in 0..3 {
                let of_before = before.map(|column| (column + axis, -1.0));
                let of_controls =
                    step.terms.iter().filter_map(|(control, gain)| moved[*control].entry(-gain[axis]));
                let own = [(columns.momentum + 3 * index + axis, 1.0)];
                rows.row(own.into_iter().chain(of_before).chain(of_controls), known[axis]);
            }
        }
        rows.cones.push(ZeroConeT(rows.right.len()));
    }

    /// Bounds, sums, magnitudes and targets.
    fn add_inequalities(&self, rows: &mut Rows, columns: &Columns<'_>) {
        let equations = rows.right.len();
        for column in columns.moved.iter().filter_map(|it| it.column) {
            rows.row([(column, 1.0)], 1.0);
            rows.row([(column, -1.0)], 1.0);
        }
        for (terms, most) in &self.sums {
            rows.row(columns.entries(terms, 1.0), most - columns.middles(terms));
        }
        let (first, magnitudes) = &columns.magnitudes;
        for (at, (index, _)) in magnitudes.iter().enumerate() {
            let moved = &columns.moved[*index];
            for sign in [1.0, -1.0] {
                let entries = moved.entry(sign).into_iter().chain([(first + at, -1.0)]);
                rows.row(entries, -sign * moved.middle);
            }
        }
        if let Some(excess) = columns.excess {
            let greatest = self.steps.iter().map(|step| step.limit).fold(0.0, f64::max);
            rows.row([(excess, -1.0)], greatest);
        }
        for target in &self.targets {
            let constant = target.constant + columns.middles(&target.terms);
            // In units of its bound: rows of one size.
            let unit = 1.0 / target.within;
            for sign in [1.0, -1.0] {
                let terms = columns.entries(&target.terms, sign).map(|(column, by)| (column, by * unit));
                let wider = columns.excess.map(|column| (column, -target.per_excess * unit));
                rows.row(terms.chain(wider), 1.0 - sign * constant * unit);
            }
        }
        let inequalities = rows.right.len() - equations;
        if inequalities > 0 {
            rows.cones.push(NonnegativeConeT(inequalities));
        }
    }

    /// Momentum within the limit at every instant, and where a step begins with any.
    fn add_balls(&self, rows: &mut Rows, columns: &Columns<'_>) {
        let excess = columns.excess.map(|column| (column, -1.0));
        let mut ball = |first: usize, limit: f64| match self.size {
            MomentumSize::Length => {
                rows.row(excess, limit);
                for axis in 0..3 {
                    rows.row([(first + axis, -1.0)], 0.0);
                }
                rows.cones.push(SecondOrderConeT(4));
            }
            MomentumSize::LargestComponent => {
                for (axis, sign) in [0, 1, 2].into_iter().flat_map(|axis| [(axis, 1.0), (axis, -1.0)]) {
                    rows.row([(first + axis, sign)].into_iter().chain(excess), limit);
                }
                rows.cones.push(NonnegativeConeT(6));
            }
        };
        let mut begins = columns.begins;
        for (index, step) in self.steps.iter().enumerate() {
            if step.begin == Begin::Free {
                ball(begins, step.limit);
                begins += 3;
            }
            ball(columns.momentum + 3 * index, step.limit);
        }
    }
}

/// min cost.x within the cones.
fn minimised(cost: &[f64], rows: Rows) -> Option<Vec<f64>> {
    let Rows { triplets: (row, column, entry), right, cones } = rows;
    let quadratic = CscMatrix::zeros((cost.len(), cost.len()));
    let matrix = CscMatrix::new_from_triplets(right.len(), cost.len(), row, column, entry);
    let settings = DefaultSettingsBuilder::default().verbose(false).build().ok()?;
    let mut solver = DefaultSolver::new(&quadratic, cost, &matrix, &right, &cones, settings).ok()?;
    solver.solve();
    let is_found = matches!(solver.solution.status, SolverStatus::Solved | SolverStatus::AlmostSolved);
    is_found.then_some(solver.solution.x)
}

#[cfg(test)]
mod tests;

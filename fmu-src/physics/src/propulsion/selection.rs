//! Thruster selection: how long each thruster fires at full thrust to give an angular impulse about each body axis, each way.
//!
//! Equation: minimise t' W t subject to B t = e, t >= 0, for the six unit vectors e = +-X, +-Y, +-Z; B holds the thrusters'
//! torques about the centre of mass, W what is preferred. Any impulse is then the sum of its components' selections.
//! Method: non-negative least squares with the constraint weighted (active set), then the constraint exactly on the thrusters
//! that were chosen.
//! Reference: Lawson and Hanson, Solving Least Squares Problems, ch. 22-23; Wie, Space Vehicle Dynamics and Control, 7.3.

use nalgebra::{Matrix3, Vector3};

use crate::spacecraft::{MOST_THRUSTERS, Thruster};

/// Weight of the torque over what is preferred; the torque is made exact afterwards.
const TORQUE_WEIGHT: f64 = 1e6;
/// Share of the on-time beside the parasitic force.
const ON_TIME_SHARE: f64 = 1e-3;
/// A torque that misses its unit vector by more is none.
const MISS: f64 = 1e-9;
/// Body axes, each way.
const SENSES: [(usize, f64, &str); 6] =
    [(0, 1.0, "+X"), (0, -1.0, "-X"), (1, 1.0, "+Y"), (1, -1.0, "-Y"), (2, 1.0, "+Z"), (2, -1.0, "-Z")];

/// Seconds of full thrust by thruster.
type OnTimes = [f64; MOST_THRUSTERS];

/// Preference among the thrusters that give a torque.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Preference {
    /// The least force beside the torque: couples, where there are some.
    LeastForce,
    /// The shortest on-times: the strongest thrusters.
    LeastOnTime,
}

/// Thrusters that give no torque one way.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "the thrusters that may fire give no torque about {axis} of the centre of mass: none of them has a lever there"
)]
pub struct SelectionError {
    /// The body axis and the way about it.
    pub axis: &'static str,
}

/// On-times of the selected thrusters for torque about each axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ThrusterSelection {
    /// Seconds of full thrust for 1 N m s about each of +X, -X, +Y, -Y, +Z, -Z.
    per_impulse_s: [OnTimes; 6],
    count: usize,
}

impl ThrusterSelection {
    /// Selects among the thrusters that `may_fire` (by index) about a centre of mass, in m.
    ///
    /// # Errors
    /// A way about an axis that none of them gives.
    pub fn new(
        thrusters: &[Thruster],
        may_fire: impl Fn(usize) -> bool,
        center_of_mass_body_m: &Vector3<f64>,
        preference: Preference,
    ) -> Result<Self, SelectionError> {
        let count = thrusters.len().min(MOST_THRUSTERS);
        let mut problem = Problem::new(thrusters, may_fire, center_of_mass_body_m, preference);
        let mut per_impulse_s = [[0.0; MOST_THRUSTERS]; 6];
        for ((axis, sign, name), on_times) in SENSES.into_iter().zip(&mut per_impulse_s) {
            let mut requested = Vector3::zeros();
            requested[axis] = sign;
            *on_times = problem.solve(&requested).ok_or(SelectionError { axis: name })?;
        }
        Ok(Self { per_impulse_s, count })
    }

    /// The same with the least force, of the weakest thrusters that give a torque every way, those of full thrust up to the least
    /// possible: a pulse of theirs is the smallest.
    ///
    /// # Errors
    /// A way about an axis that not even all of them give.
    pub fn of_the_finest(
        thrusters: &[Thruster],
        may_fire: impl Fn(usize) -> bool,
        center_of_mass_body_m: &Vector3<f64>,
    ) -> Result<Self, SelectionError> {
        let preference = Preference::LeastForce;
        let force_n = |k: usize| thrusters[k].force_body_n.norm();
        let mut limit_n = 0.0;
        loop {
            let stronger = (0..thrusters.len()).filter(|k| may_fire(*k) && force_n(*k) > limit_n);
            let Some(next_n) = stronger.map(force_n).reduce(f64::min) else {
                return Self::new(thrusters, may_fire, center_of_mass_body_m, preference);
            };
            // Thrusters of one kind differ by rounding.
            limit_n = next_n * (1.0 + 1e-9);
            let weak = |k: usize| may_fire(k) && force_n(k) <= limit_n;
            let found = Self::new(thrusters, weak, center_of_mass_body_m, preference);
            if found.is_ok() {
                return found;
            }
        }
    }

    /// Seconds of full thrust of each thruster for an angular impulse about the centre of mass, in N m s, body frame.
    pub fn on_times_s(&self, impulse_body_n_m_s: &Vector3<f64>) -> impl Iterator<Item = f64> + Clone + use<> {
        let mut sum = [0.0; MOST_THRUSTERS];
        for ((axis, sign, _), on_times) in SENSES.iter().zip(&self.per_impulse_s) {
            let part = impulse_body_n_m_s[*axis] * sign;
            if part > 0.0 {
                for (total, on_time_s) in sum.iter_mut().zip(on_times) {
                    *total += part * on_time_s;
                }
            }
        }
        sum.into_iter().take(self.count)
    }

    /// Whether it has a part for thruster `k`.
    pub fn uses(&self, k: usize) -> bool {
        self.per_impulse_s.iter().any(|on_times| on_times[k] > 0.0)
    }

    /// The least of the torques about the body axes that full thrust gives, in N m.
    pub fn least_torque_n_m(&self) -> f64 {
        let longest = |on_times: &OnTimes| on_times.iter().fold(0.0_f64, |most, it| most.max(*it));
        self.per_impulse_s.iter().map(|on_times| longest(on_times).recip()).fold(f64::INFINITY, f64::min)
    }
}

/// The least-squares problem: thrusters that may fire, their torques and what is preferred.
struct Problem {
    /// Number among all thrusters, and torque in N m.
    candidates: [(usize, Vector3<f64>); MOST_THRUSTERS],
    count: usize,
    /// W over the candidates.
    weight: [[f64; MOST_THRUSTERS]; MOST_THRUSTERS],
    /// Weight of the torque in W's units.
    torque_weight: f64,
}

impl Problem {
    fn new(
        thrusters: &[Thruster],
        may_fire: impl Fn(usize) -> bool,
        center_of_mass_body_m: &Vector3<f64>,
        preference: Preference,
    ) -> Self {
        let mut candidates = [(0, Vector3::zeros()); MOST_THRUSTERS];
        let mut count = 0;
        for (k, thruster) in thrusters.iter().enumerate().take(MOST_THRUSTERS).filter(|(k, _)| may_fire(*k)) {
            candidates[count] = (k, thruster.torque_about_n_m(center_of_mass_body_m));
            count += 1;
        }
        let force = |i: usize| &thrusters[candidates[i].0].force_body_n;
        let mut weight = [[0.0; MOST_THRUSTERS]; MOST_THRUSTERS];
        let mut largest = 0.0_f64;
        for (i, row) in weight.iter_mut().enumerate().take(count) {
            for (j, weight) in row.iter_mut().enumerate().take(count) {
                *weight = match preference {
                    Preference::LeastForce => force(i).dot(force(j)),
                    Preference::LeastOnTime => 0.0,
                };
            }
            row[i] += match preference {
                Preference::LeastForce => ON_TIME_SHARE * force(i).norm_squared(),
                Preference::LeastOnTime => 1.0,
            };
            largest = largest.max(row[i]);
        }
        let arm_n_m = candidates[..count].iter().map(|(_, torque)| torque.norm()).fold(0.0, f64::max);
        let torque_weight = if arm_n_m > 0.0 { TORQUE_WEIGHT * largest / (arm_n_m * arm_n_m) } else { 0.0 };
        Self { candidates, count, weight, torque_weight }
    }

    fn torque(&self, i: usize) -> &Vector3<f64> {
        &self.candidates[i].1
    }

    /// On-times of all thrusters that give `requested`; none where nothing does.
    fn solve(&mut self, requested: &Vector3<f64>) -> Option<OnTimes> {
        let (mut times, mut chosen) = ([0.0; MOST_THRUSTERS], [false; MOST_THRUSTERS]);
        // Every thruster comes in and goes out a few times at most.
        for _ in 0..4 * MOST_THRUSTERS {
            let next = (0..self.count).filter(|i| !chosen[*i]).map(|i| (i, self.gain(i, &times, requested)));
            let threshold = 1e-9 * self.torque_weight * self.torque_scale();
            let Some((best, _)) =
                next.filter(|(_, gain)| *gain > threshold).max_by(|(_, a), (_, b)| a.total_cmp(b))
            else {
                break;
            };
            chosen[best] = true;
            while let Some(found) = self.unconstrained(&chosen, requested) {
                let falls = |i: usize| chosen[i] && found[i] <= 0.0;
                let part = (0..self.count)
                    .filter(|i| falls(*i))
                    .map(|i| times[i] / (times[i] - found[i]))
                    .fold(1.0_f64, f64::min);
                for i in 0..self.count {
                    times[i] += part * (found[i] - times[i]);
                }
                if part == 1.0 {
                    break;
                }
                for i in 0..self.count {
                    if chosen[i] && times[i] <= 1e-14 {
                        (chosen[i], times[i]) = (false, 0.0);
                    }
                }
            }
        }
        let least = self.exact(&chosen, [0.0; MOST_THRUSTERS], requested);
        // Where more thrusters were chosen than the torque needs, rounding may ask for less than nothing.
        let times =
            if least.iter().all(|it| *it >= 0.0) { least } else { self.exact(&chosen, times, requested) };
        let given = (0..self.count).map(|i| self.torque(i) * times[i]).sum::<Vector3<f64>>();
        if (given - requested).norm() > MISS || times.iter().any(|it| *it < 0.0) {
            return None;
        }
        let mut all = [0.0; MOST_THRUSTERS];
        for i in 0..self.count {
            all[self.candidates[i].0] = times[i];
        }
        Some(all)
    }

    fn torque_scale(&self) -> f64 {
        (0..self.count).map(|i| self.torque(i).norm()).fold(0.0, f64::max)
    }

    /// By how much the sum of squares falls per second more of candidate `i`, halved.
    fn gain(&self, i: usize, times: &OnTimes, requested: &Vector3<f64>) -> f64 {
        let given = (0..self.count).map(|j| self.torque(j) * times[j]).sum::<Vector3<f64>>();
        let preferred: f64 = (0..self.count).map(|j| self.weight[i][j] * times[j]).sum();
        self.torque_weight * self.torque(i).dot(&(requested - given)) - preferred
    }

    /// The least squares without regard to signs over the chosen ones, by Cholesky's decomposition.
    fn unconstrained(&self, chosen: &[bool; MOST_THRUSTERS], requested: &Vector3<f64>) -> Option<OnTimes> {
        self.solve_chosen(chosen, |i| self.torque_weight * self.torque(i).dot(requested), self.torque_weight)
    }

    /// (W + torque_weight B'B) x = right over the chosen ones.
    fn solve_chosen(
        &self,
        chosen: &[bool; MOST_THRUSTERS],
        right: impl Fn(usize) -> f64,
        torque_weight: f64,
    ) -> Option<OnTimes> {
        let mut lower = [[0.0; MOST_THRUSTERS]; MOST_THRUSTERS];
        let mut x = [0.0; MOST_THRUSTERS];
        let of = |i: usize, j: usize| self.weight[i][j] + torque_weight * self.torque(i).dot(self.torque(j));
        for i in (0..self.count).filter(|i| chosen[*i]) {
            for j in (0..=i).filter(|j| chosen[*j]) {
                let sum: f64 = (0..j).filter(|k| chosen[*k]).map(|k| lower[i][k] * lower[j][k]).sum();
                let rest = of(i, j) - sum;
                if i == j {
                    if rest <= 0.0 {
                        return None;
                    }
                    lower[i][i] = rest.sqrt();
                } else {
                    lower[i][j] = rest / lower[j][j];
                }
            }
            let sum: f64 = (0..i).filter(|k| chosen[*k]).map(|k| lower[i][k] * x[k]).sum();
            x[i] = (right(i) - sum) / lower[i][i];
        }
        for i in (0..self.count).rev().filter(|i| chosen[*i]) {
            let sum: f64 = (i + 1..self.count).filter(|k| chosen[*k]).map(|k| lower[k][i] * x[k]).sum();
            x[i] = (x[i] - sum) / lower[i][i];
        }
        Some(x)
    }

    /// Adds what the weighted constraint left of the torque: dt = W^-1 B' (B W^-1 B')^-1 (commanded - B t), over the chosen ones.
    fn exact(
        &self,
        chosen: &[bool; MOST_THRUSTERS],
        mut times: OnTimes,
        requested: &Vector3<f64>,
    ) -> OnTimes {
        let mut columns = [[0.0; MOST_THRUSTERS]; 3];
        for (axis, column) in columns.iter_mut().enumerate() {
            let Some(found) = self.solve_chosen(chosen, |i| self.torque(i)[axis], 0.0) else { return times };
            *column = found;
        }
        let gram = Matrix3::from_fn(|row, axis| {
            (0..self.count).map(|i| self.torque(i)[row] * columns[axis][i]).sum::<f64>()
        });
        // Thrusters that give one torque only span no more than it.
        let Ok(inverse) = gram.pseudo_inverse(1e-12 * gram.norm()) else { return times };
        for _ in 0..2 {
            let given = (0..self.count).map(|i| self.torque(i) * times[i]).sum::<Vector3<f64>>();
            let multiplier = inverse * (requested - given);
            for i in 0..self.count {
                times[i] += (0..3).map(|axis| columns[axis][i] * multiplier[axis]).sum::<f64>();
            }
        }
        times
    }
}

#[cfg(test)]
mod tests;

//! A recorded mission: the momentum that its disturbance gathers, and until when downlinks can hold it without a dump.

use std::path::Path;

use nalgebra::Vector3;
use physics::constants::DAY_S;

use super::region::{Point, Region};

/// X and Z among the axes.
const HELD: [usize; 2] = [0, 2];
/// Columns that are read.
const TORQUE: [&str; 3] = ["torque.total[1]", "torque.total[2]", "torque.total[3]"];
const MOMENTUM: [&str; 3] = ["momentum.body[1]", "momentum.body[2]", "momentum.body[3]"];
const DUMPS: &str = "dump.count";
const DISTANCE: &str = "sun.distance";

/// Recording of a mission's flight.
pub struct Mission {
    /// The columns the disturbance is from.
    pub from: &'static str,
    times_s: Vec<f64>,
    /// Gathered by the disturbance since the first row, with the momentum there, body components.
    gathered_n_m_s: Vec<Vector3<f64>>,
    /// From the Sun, in m, if it was recorded.
    distances_m: Option<Vec<f64>>,
    /// Dumps that were simulated, if they were recorded.
    pub dumps: Option<f64>,
}

/// Days after the first row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HoldableDays {
    /// No choice of downlinks keeps X and Z within the thresholds from here on; `None` if one does to the end.
    pub managed_d: Option<f64>,
    /// X or Z leaves them without managed downlinks.
    pub unmanaged_d: Option<f64>,
    /// Y leaves its own, which downlinks do not manage.
    pub y_d: Option<f64>,
}

struct Table {
    file: String,
    names: Vec<String>,
    /// By column.
    values: Vec<Vec<f64>>,
}

impl Table {
    fn read(path: &Path) -> Result<Self, String> {
        let file = path.display().to_string();
        let failed = |error: &dyn std::fmt::Display| format!("{file}: {error}: see --recording");
        let text = files::open_at_most(path, files::MAX_TABLE_BYTES).map_err(|error| failed(&error))?;
        let mut reader = csv::Reader::from_reader(text);
        let names: Vec<String> = reader
            .headers()
            .map_err(|error| failed(&error))?
            .iter()
            .map(|name| name.trim().to_owned())
            .collect();
        if let Some((_, twice)) = names.iter().enumerate().find(|(at, name)| names[..*at].contains(name)) {
            return Err(failed(&format!("found the column {twice:?} twice, allowed: once")));
        }
        let is_read = |name: &String| {
            name == "time"
                || name == DUMPS
                || name == DISTANCE
                || TORQUE.contains(&name.as_str())
                || MOMENTUM.contains(&name.as_str())
        };
        let mut values = vec![Vec::new(); names.len()];
        for (row, record) in reader.records().enumerate() {
            let record = record.map_err(|error| failed(&error))?;
            for (column, cell) in record.iter().enumerate().filter(|(column, _)| is_read(&names[*column])) {
                let value = cell.trim().parse::<f64>().ok().filter(|value| value.is_finite());
                values[column].push(value.ok_or_else(|| {
                    format!(
                        "{file}:{}: {}: found {cell:?}, allowed: a finite number: see --recording",
                        row + 2,
                        names[column]
                    )
                })?);
            }
        }
        Ok(Self { file, names, values })
    }

    fn column(&self, name: &str) -> Option<&Vec<f64>> {
        self.names.iter().position(|candidate| candidate == name).map(|index| &self.values[index])
    }

    fn vectors(&self, names: [&str; 3]) -> Option<Vec<Vector3<f64>>> {
        let [x, y, z] = names.map(|name| self.column(name));
        let (x, y, z) = (x?, y?, z?);
        Some((0..x.len()).map(|row| Vector3::new(x[row], y[row], z[row])).collect())
    }

    fn misses(&self, what: &str) -> String {
        format!("{}: found no {what}: see --recording", self.file)
    }
}

impl Mission {
    /// Reads a recording.
    ///
    /// # Errors
    /// Missing columns, cells that are no numbers, times that do not rise, distances not above 0.
    pub fn read(path: &Path) -> Result<Self, String> {
        let table = Table::read(path)?;
        let times_s =
            table.column("time").ok_or_else(|| table.misses("column time, allowed: a recording of `run`"))?;
        if times_s.len() < 2
            || times_s.windows(2).any(|pair| pair[1] < pair[0])
            || times_s.first() == times_s.last()
        {
            return Err(table.misses("two rows whose times rise, allowed: a recording of `run`"));
        }
        let dumps = table.column(DUMPS);
        let momentum = table.vectors(MOMENTUM);
        let (from, gathered_n_m_s) = match (table.vectors(TORQUE), momentum, dumps) {
            (Some(torque), momentum, _) => {
                let start_n_m_s = momentum.map_or_else(Vector3::zeros, |rows| rows[0]);
                ("torque.total", summed(times_s, &torque, start_n_m_s))
            }
            (None, Some(momentum), Some(dumps)) => {
                ("momentum.body and dump.count", without_dumps(&momentum, dumps))
            }
            _ => {
                return Err(table.misses(
                    "torque.total[1] to [3], nor momentum.body[1] to [3] with dump.count, allowed: a recording with the one \
                     or the other",
                ));
            }
        };
        let distances_m = table.column(DISTANCE).cloned();
        if distances_m.iter().flatten().any(|distance_m| *distance_m <= 0.0) {
            return Err(table.misses("sun.distance above 0 in every row"));
        }
        let dumps = dumps.map(|dumps| dumps[dumps.len() - 1] - dumps[0]);
        Ok(Self { from, times_s: times_s.clone(), gathered_n_m_s, distances_m, dumps })
    }

    /// Its length in days.
    pub fn length_d(&self) -> f64 {
        (self.times_s[self.times_s.len() - 1] - self.times_s[0]) / DAY_S
    }

    /// Mean torque of the disturbance, X and Z, in N m.
    pub fn mean_torque_n_m(&self) -> Point {
        let (first, last) = (&self.gathered_n_m_s[0], &self.gathered_n_m_s[self.gathered_n_m_s.len() - 1]);
        HELD.map(|axis| (last[axis] - first[axis]) / (self.length_d() * DAY_S))
    }

    /// Mean of the factor by which sunlight differs from that at a distance; 1 where no distance was recorded.
    pub fn mean_light(&self, at_m: f64) -> f64 {
        if self.distances_m.is_none() {
            return 1.0;
        }
        let steps = 1..self.times_s.len();
        steps.map(|k| self.light(k, at_m) * (self.times_s[k] - self.times_s[k - 1])).sum::<f64>()
            / (self.length_d() * DAY_S)
    }

    /// Factor of sunlight over the step that ends with a row.
    fn light(&self, row: usize, at_m: f64) -> f64 {
        self.distances_m.as_ref().map_or(1.0, |distances_m| {
            [distances_m[row - 1], distances_m[row]]
                .map(|distance_m| 0.5 * (at_m / distance_m).powi(2))
                .iter()
                .sum()
        })
    }

    /// How long momentum stays within thresholds. `added_n_m` is what downlinks can add to the mean torque about X and Z at the
    /// distance `at_m`.
    ///
    /// Momenta that downlinks can bring about without a dump are a convex set R: from row to row
    /// R' = (R + gained momentum + dt added) within the thresholds. The first day on which it is empty is the answer.
    pub fn held(&self, added_n_m: &Region, at_m: f64, threshold_n_m_s: [f64; 3]) -> HoldableDays {
        let limits = HELD.map(|axis| threshold_n_m_s[axis]);
        let day = |row: usize| (self.times_s[row] - self.times_s[0]) / DAY_S;
        let leaves = |axis: usize| {
            let out = |gathered: &Vector3<f64>| gathered[axis].abs() > threshold_n_m_s[axis];
            self.gathered_n_m_s.iter().position(out)
        };
        let unmanaged = HELD.into_iter().filter_map(leaves).min();
        let mut reached = Region::hull([HELD.map(|axis| self.gathered_n_m_s[0][axis])]).within(limits);
        let mut managed_d = reached.corners.is_empty().then_some(0.0);
        for row in 1..self.times_s.len() {
            if managed_d.is_some() {
                break;
            }
            let change_n_m_s = self.gathered_n_m_s[row] - self.gathered_n_m_s[row - 1];
            let gained = HELD.map(|axis| change_n_m_s[axis]);
            let step_s = self.times_s[row] - self.times_s[row - 1];
            let added = added_n_m.scaled(self.light(row, at_m) * step_s, gained);
            reached = reached.plus(&added).within(limits);
            if reached.corners.is_empty() {
                managed_d = Some(day(row));
            }
        }
        HoldableDays { managed_d, unmanaged_d: unmanaged.map(day), y_d: leaves(1).map(day) }
    }
}

/// Torque over time by the trapezoid rule.
fn summed(times_s: &[f64], torque_n_m: &[Vector3<f64>], start_n_m_s: Vector3<f64>) -> Vec<Vector3<f64>> {
    let mut at = start_n_m_s;
    let mut gathered = vec![at];
    for row in 1..times_s.len() {
        let mean_n_m = (torque_n_m[row - 1] + torque_n_m[row]) * 0.5;
        at += mean_n_m * (times_s[row] - times_s[row - 1]);
        gathered.push(at);
    }
    gathered
}

/// Momentum with the change of a row with a dump replaced by the mean of its neighbours' without one.
fn without_dumps(momentum_n_m_s: &[Vector3<f64>], dumps: &[f64]) -> Vec<Vector3<f64>> {
    let has_dump = |row: usize| dumps[row] != dumps[row - 1];
    let change = |row: usize| momentum_n_m_s[row] - momentum_n_m_s[row - 1];
    let rows = dumps.len();
    let mut at = momentum_n_m_s[0];
    let mut gathered = vec![at];
    for row in 1..rows {
        let gained = if has_dump(row) {
            let before = (1..row).rev().find(|row| !has_dump(*row)).map(change);
            let after = (row + 1..rows).find(|row| !has_dump(*row)).map(change);
            (before.or(after).unwrap_or_default() + after.or(before).unwrap_or_default()) * 0.5
        } else {
            change(row)
        };
        at += gained;
        gathered.push(at);
    }
    gathered
}

#[cfg(test)]
mod tests;

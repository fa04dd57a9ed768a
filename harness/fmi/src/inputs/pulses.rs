//! Pulses of held inputs that come and go between two communication points.

use model_description::Description;

use super::{InputColumn, InputTable, Interpolation};
use crate::{Times, Value};

impl InputTable {
    /// A line for each held column with values that no communication point of a run has, the ones before and behind them being equal:
    /// with the first of them and the step that has them all.
    pub fn lost_pulses(&self, description: &Description, times: &Times) -> Vec<String> {
        let columns = 0..self.columns.len();
        columns.filter_map(|column| self.lost_in(column, description, times)).collect()
    }

    fn lost_in(&self, column: usize, description: &Description, times: &Times) -> Option<String> {
        let InputColumn { interpolation, times_s, values, position } = &self.columns[column];
        if *interpolation != Interpolation::Held {
            return None;
        }
        let (mut lost, mut narrowest_s) = (Vec::new(), f64::INFINITY);
        let changes = (1..values.len()).filter(|row| values[*row] != values[row - 1]);
        let starts: Vec<usize> = changes.collect();
        for pair in starts.windows(2) {
            let [from_s, to_s] = [times_s[pair[0]], times_s[pair[1]]];
            let behind = first_from(times, from_s);
            // Two rows at one time make a jump, and what the run begins with is before none.
            if to_s <= from_s || behind == 0 || to_s > times.stop_s || times.point_s(behind) < to_s {
                continue;
            }
            let points_s = [times.point_s(behind - 1), times.point_s(behind)];
            let [before, after] = points_s.map(|point_s| self.value(column, point_s));
            if before == after {
                narrowest_s = narrowest_s.min(to_s - from_s);
                lost.push((&values[pair[0]], [from_s, to_s], points_s));
            }
        }
        let (value, [from_s, to_s], [before_s, after_s]) = lost.first()?;
        let name = &description.variables[*position].name;
        let value =
            if let Value::Boolean(is_on) = value { is_on.to_string() } else { value.to_f64().to_string() };
        let more = match lost.len() - 1 {
            0 => String::new(),
            more => format!(", and {more} more like it"),
        };
        Some(format!(
            "{name} is {value} from {from_s} s to {to_s} s alone, between the communication points at {before_s} s and {after_s} s{more}: \
             the FMU never sees it; a step of at most {narrowest_s} s does (now {} s)",
            times.step_s
        ))
    }
}

/// The first communication point at a time or behind it.
fn first_from(times: &Times, time_s: f64) -> u64 {
    let mut point = ((time_s - times.start_s) / times.step_s).floor().max(0.0) as u64;
    while point < times.steps() && times.point_s(point) < time_s {
        point += 1;
    }
    point
}

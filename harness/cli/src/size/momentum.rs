//! Secular and cyclic momentum of a recorded flight.
//!
//! Over a span the secular part is the slope of the straight line from its first to its last value, the cyclic part the
//! greatest distance of the values from that line. Of an orbit it is the mean slope, and the greatest distance in any orbit.

use loader::Recording;

/// Momentum by source and axis, in N m s.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct SourceRow {
    /// Of `momentum.*`.
    pub source: String,
    /// Gathered in an orbit in the mean, by axis.
    pub secular_per_orbit_n_m_s: [f64; 3],
    /// Greatest swing within an orbit.
    pub cyclic_per_orbit_n_m_s: [f64; 3],
    /// Gathered in a year.
    pub secular_per_year_n_m_s: [f64; 3],
    /// Greatest swing within the whole flight.
    pub cyclic_per_year_n_m_s: [f64; 3],
}

/// What each source gathers; `period_s` is an orbit's, `years` the length of the flight.
pub(super) fn by_source(simulated: &Recording, period_s: f64, years: f64) -> Vec<SourceRow> {
    let sources =
        simulated.names.iter().filter_map(|name| name.strip_prefix("momentum.")?.strip_suffix("[1]"));
    let rows = sources.map(|source| {
        let mut row = SourceRow { source: source.to_owned(), ..SourceRow::default() };
        for axis in 0..3 {
            let Some(column) = simulated.column(&format!("momentum.{source}[{}]", axis + 1)) else {
                continue;
            };
            let values = column.numbers();
            let span_s = simulated.times_s.last().zip(simulated.times_s.first()).map_or(0.0, |(a, b)| a - b);
            let (gathered, swing) = parts(&simulated.times_s, &values);
            row.secular_per_orbit_n_m_s[axis] = gathered * period_s / span_s;
            row.cyclic_per_orbit_n_m_s[axis] = greatest_of_orbits(&simulated.times_s, &values, period_s);
            row.secular_per_year_n_m_s[axis] = gathered / years;
            row.cyclic_per_year_n_m_s[axis] = swing;
        }
        row
    });
    rows.collect()
}

/// The change from end to end, and the greatest distance from the line through both ends.
fn parts(times_s: &[f64], values: &[f64]) -> (f64, f64) {
    let (Some((first_s, last_s)), Some((first, last))) =
        (times_s.first().zip(times_s.last()), values.first().zip(values.last()))
    else {
        return (0.0, 0.0);
    };
    let slope = if last_s > first_s { (last - first) / (last_s - first_s) } else { 0.0 };
    let off =
        times_s.iter().zip(values).map(|(time_s, value)| (value - first - slope * (time_s - first_s)).abs());
    (last - first, off.fold(0.0, f64::max))
}

fn greatest_of_orbits(times_s: &[f64], values: &[f64], period_s: f64) -> f64 {
    let mut greatest = 0.0_f64;
    for window in windows(times_s, period_s) {
        greatest = greatest.max(parts(&times_s[window.clone()], &values[window]).1);
    }
    greatest
}

/// Rows of one whole span after another; all rows where there is no whole one.
fn windows(times_s: &[f64], span_s: f64) -> Vec<core::ops::Range<usize>> {
    let mut windows = Vec::new();
    let mut begin = 0;
    for end in 0..times_s.len() {
        // Times are rounded.
        if times_s[end] - times_s[begin] >= span_s * (1.0 - 1e-9) {
            windows.push(begin..end + 1);
            begin = end;
        }
    }
    let whole = 0..times_s.len();
    if windows.is_empty() { Vec::from([whole]) } else { windows }
}

/// The greatest range that a component of the body's momentum has within any time of this length, by axis, in N m s.
pub(super) fn greatest_range_n_m_s(simulated: &Recording, span_s: f64) -> [f64; 3] {
    [1, 2, 3].map(|axis| {
        let values =
            simulated.column(&format!("momentum.body[{axis}]")).map(|it| it.numbers()).unwrap_or_default();
        range_within(&simulated.times_s, &values, span_s)
    })
}

/// By two queues of candidates for least and greatest: each row enters and leaves once.
fn range_within(times_s: &[f64], values: &[f64], span_s: f64) -> f64 {
    let mut queues = [std::collections::VecDeque::new(), std::collections::VecDeque::new()];
    let mut greatest = 0.0_f64;
    for (row, value) in values.iter().enumerate() {
        for (queue, sign) in queues.iter_mut().zip([1.0, -1.0]) {
            while queue.back().is_some_and(|last: &usize| sign * values[*last] <= sign * value) {
                queue.pop_back();
            }
            queue.push_back(row);
            while queue.front().is_some_and(|first| times_s[row] - times_s[*first] > span_s) {
                queue.pop_front();
            }
        }
        let [most, least] = [0, 1].map(|k: usize| queues[k].front().map_or(0.0, |first| values[*first]));
        greatest = greatest.max(most - least);
    }
    greatest
}

#[cfg(test)]
mod tests {
    //! A line with a swing on it comes apart again.
    use core::f64::consts::TAU;

    use loader::Column;

    use super::*;

    #[test]
    fn a_line_and_a_swing_come_apart() {
        let period_s = 100.0;
        let times_s: Vec<f64> = (0..=4000).map(f64::from).collect();
        let line = times_s.iter().map(|t| 0.02 * t + 0.3 * (TAU * t / period_s).sin()).collect();
        let simulated = Recording {
            times_s,
            names: vec!["momentum.solar[1]".to_owned()],
            units: vec![String::new()],
            columns: vec![Column::Real(line)],
        };
        let row = by_source(&simulated, period_s, 0.5).remove(0);
        assert_eq!(row.source, "solar");
        assert!((row.secular_per_orbit_n_m_s[0] - 2.0).abs() < 1e-9);
        assert!((row.cyclic_per_orbit_n_m_s[0] - 0.3).abs() < 1e-9);
        assert!((row.secular_per_year_n_m_s[0] - 160.0).abs() < 1e-9);
        assert!((row.cyclic_per_year_n_m_s[0] - 0.3).abs() < 1e-9);
    }

    #[test]
    fn the_range_of_a_window_is_that_of_all_pairs() {
        let times_s: Vec<f64> = (0..400).map(f64::from).collect();
        let values: Vec<f64> = times_s.iter().map(|t| (0.37 * t).sin() * (1.0 + 0.01 * t)).collect();
        for span_s in [0.0, 1.0, 7.5, 60.0, 1e4] {
            let pairs = (0..400).flat_map(|a| (a..400).map(move |b| (a, b)));
            let within = pairs.filter(|(a, b)| times_s[*b] - times_s[*a] <= span_s);
            let expected = within.map(|(a, b)| (values[a] - values[b]).abs()).fold(0.0, f64::max);
            assert_eq!(range_within(&times_s, &values, span_s), expected, "{span_s}");
        }
    }
}

//! Compares a recording with a table of what was recorded before.

use loader::{Column, Recording, Value};

/// Where a column deviates most.
#[derive(Clone, Debug, PartialEq)]
pub struct Deviation {
    /// Name of the variable.
    pub name: String,
    /// Time in s.
    pub time_s: f64,
    /// What the table has.
    pub expected: String,
    /// What was found.
    pub found: String,
    /// For a Real as a fraction of the largest magnitude of the column or the vector it belongs to, infinite for others.
    pub deviation: f64,
}

/// The largest deviation of every column that is not the same, by name; `rows` of the table belong to `lines` of the recording.
pub(crate) fn deviations(
    header: &[String],
    rows: &[Vec<String>],
    recording: &Recording,
    lines: &[usize],
) -> Vec<Deviation> {
    let largest_of = |vector: &str| {
        let columns = header.iter().enumerate().skip(1).filter(|(_, name)| vector_of(name) == vector);
        let cells = columns.flat_map(|(index, _)| rows.iter().filter_map(move |row| row.get(index)));
        cells
            .filter_map(|cell| cell.parse().ok())
            .fold(0.0_f64, |largest, value: f64| largest.max(value.abs()))
    };
    let column_of = |(index, name): (usize, &String)| {
        let column = recording.column(name)?;
        let largest = largest_of(vector_of(name));
        let cells: Vec<&str> = rows.iter().map(|row| row.get(index).map_or("", String::as_str)).collect();
        worst(column, &cells, lines, largest).map(|(row, deviation)| Deviation {
            name: name.clone(),
            time_s: recording.times_s.get(lines[row]).copied().unwrap_or(f64::NAN),
            expected: cells[row].to_owned(),
            found: column.value(lines[row]).as_ref().map_or(String::new(), shown),
            deviation,
        })
    };
    header.iter().enumerate().skip(1).filter_map(column_of).collect()
}

/// The vector that a variable is a component of, or the variable.
fn vector_of(name: &str) -> &str {
    name.strip_suffix(']').and_then(|name| name.rsplit_once('[')).map_or(name, |(vector, _)| vector)
}

/// The row that deviates most and by how much; `None` where all are the same.
fn worst(column: &Column, cells: &[&str], lines: &[usize], largest: f64) -> Option<(usize, f64)> {
    let deviation: Vec<f64> = match column {
        Column::Real(values) => {
            let expected: Vec<f64> = cells.iter().map(|cell| cell.parse().unwrap_or(f64::NAN)).collect();
            let of_row = |(expected, &line): (&f64, &usize)| {
                let error = (expected - values[line]).abs();
                // What is no number is as far off as can be; a column of zeros is met by zeros.
                if error == 0.0 {
                    0.0
                } else if error.is_nan() {
                    f64::INFINITY
                } else {
                    error / largest
                }
            };
            expected.iter().zip(lines).map(of_row).collect()
        }
        _ => {
            let same = |(cell, &line): (&&str, &usize)| is_same(column, cell, line);
            cells.iter().zip(lines).map(|pair| if same(pair) { 0.0 } else { f64::INFINITY }).collect()
        }
    };
    let (row, largest) = deviation.into_iter().enumerate().max_by(|a, b| a.1.total_cmp(&b.1))?;
    (largest > 0.0).then_some((row, largest))
}

fn is_same(column: &Column, cell: &str, line: usize) -> bool {
    match column {
        Column::Real(_) => false,
        Column::Integer(values) => cell.parse() == Ok(values[line]),
        // Others write the words.
        Column::Boolean(values) => {
            matches!((cell, values[line]), ("1" | "true", true) | ("0" | "false", false))
        }
        Column::Text(values) => values[line] == cell,
    }
}

fn shown(value: &Value) -> String {
    match value {
        Value::Boolean(truth) => u8::from(*truth).to_string(),
        other => other.to_string(),
    }
}

#[cfg(test)]
mod tests {
    //! Deviations against what was written by hand.

    use super::*;

    fn recording() -> Recording {
        Recording {
            times_s: vec![0.0, 1.0, 2.0],
            names: ["x", "zero", "n", "b", "s"].map(str::to_owned).to_vec(),
            units: vec![String::new(); 5],
            columns: vec![
                Column::Real(vec![1.0, 2.0, 4.0]),
                Column::Real(vec![0.0, 0.0, 0.0]),
                Column::Integer(vec![1, 2, 3]),
                Column::Boolean(vec![true, false, true]),
                Column::Text(vec!["a".to_owned(), "b".to_owned(), "c".to_owned()]),
            ],
        }
    }

    fn found(cells: [[&str; 6]; 3]) -> Vec<(String, f64)> {
        let header = ["time", "x", "zero", "n", "b", "s"].map(str::to_owned);
        let rows: Vec<Vec<String>> = cells.iter().map(|row| row.map(str::to_owned).to_vec()).collect();
        let found = deviations(&header, &rows, &recording(), &[0, 1, 2]);
        found.into_iter().map(|it| (it.name, it.deviation)).collect()
    }

    #[test]
    fn what_is_the_same_deviates_by_nothing() {
        let same = [
            ["0", "1", "0", "1", "1", "a"],
            ["1", "2", "-0", "2", "false", "b"],
            ["2", "4.0", "0", "3", "true", "c"],
        ];
        assert_eq!(found(same), []);
    }

    #[test]
    fn each_kind_of_column_is_judged() {
        let other = [
            ["0", "1.5", "0", "1", "1", "a"],
            ["1", "2", "1e-300", "7", "1", "b"],
            ["2", "5", "0", "3", "1", "x"],
        ];
        let expected =
            [("x", 0.2), ("zero", 1.0), ("n", f64::INFINITY), ("b", f64::INFINITY), ("s", f64::INFINITY)];
        assert_eq!(found(other), expected.map(|(name, deviation)| (name.to_owned(), deviation)));
    }

    #[test]
    fn what_is_no_number_is_as_far_off_as_can_be() {
        let torn =
            [["0", "1", "0", "1", "1", "a"], ["1", "", "0", "2", "0", "b"], ["2", "4", "0", "3", "1", "c"]];
        assert_eq!(found(torn), [("x".to_owned(), f64::INFINITY)]);
    }
}

//! Rows and columns that two tables have in common, and what only one has.

use std::collections::BTreeMap;

use fmi::reference::Compared;

use crate::table::Table;

/// Numbers of the first column that differ by less, as a fraction of themselves, are one: what multiples of a step differ by.
const ROUNDING: f64 = 1e-12;

/// Two tables by what they have in common.
pub struct Pairing {
    /// Rows that belong together, of the first and the second table.
    pub rows: Vec<(usize, usize)>,
    /// The columns of both in these rows, in the order of the first table.
    pub columns: Vec<Compared>,
    /// Rows that only the first table has, and those that only the second has.
    pub lone_rows: [Vec<usize>; 2],
    /// Likewise the names of columns.
    pub lone_names: [Vec<String>; 2],
}

impl Pairing {
    /// Pairs the columns of two tables.
    ///
    /// # Errors
    /// Tables that have another first column, no row or no column in common.
    pub fn new(first: &Table, second: &Table) -> Result<Self, String> {
        let [one, other] = [first, second].map(|table| table.path.display());
        let key = &first.key;
        if *key != second.key {
            let found = &second.key;
            return Err(format!(
                "{other}:1: found the first column {found:?}, allowed: {key:?}, as {one} has"
            ));
        }
        let (rows, lone_rows) = rows(&first.keys, &second.keys);
        if rows.is_empty() {
            let span = |keys: &[f64]| match keys {
                [only] => only.to_string(),
                [from, .., to] => format!("{from} to {to}"),
                [] => "none".to_owned(),
            };
            return Err(format!(
                "{other}: {key}: found {}, allowed: at least one of {one}, which has {}",
                span(&second.keys),
                span(&first.keys)
            ));
        }
        let mut columns = Vec::new();
        let [in_first, in_second] = [first, second].map(|table| {
            table.names.iter().map(String::as_str).zip(&table.columns).collect::<BTreeMap<_, _>>()
        });
        for (name, expected) in first.names.iter().zip(&first.columns) {
            let Some(found) = in_second.get(name.as_str()) else { continue };
            columns.push(Compared {
                name: name.clone(),
                expected: rows.iter().map(|(row, _)| expected[*row].clone()).collect(),
                found: rows.iter().map(|(_, row)| found[*row].clone()).collect(),
            });
        }
        if columns.is_empty() {
            let example = |table: &Table| table.names.first().cloned().unwrap_or_default();
            return Err(format!(
                "{other}:1: found {:?} and no column of {one}, allowed: at least one, as {:?}",
                example(second),
                example(first)
            ));
        }
        let lone = |table: &Table, in_other: &BTreeMap<&str, _>| {
            table.names.iter().filter(|name| !in_other.contains_key(name.as_str())).cloned().collect()
        };
        let lone_names = [lone(first, &in_second), lone(second, &in_first)];
        Ok(Self { rows, columns, lone_rows, lone_names })
    }
}

/// Rows that belong together, and those that stand alone in the one and in the other; neither column falls.
fn rows(first: &[f64], second: &[f64]) -> (Vec<(usize, usize)>, [Vec<usize>; 2]) {
    let (mut pairs, mut lone) = (Vec::new(), [Vec::new(), Vec::new()]);
    let (mut row, mut other) = (0, 0);
    while let (Some(a), Some(b)) = (first.get(row), second.get(other)) {
        if (a - b).abs() <= ROUNDING * a.abs().max(b.abs()) {
            pairs.push((row, other));
            row += 1;
            other += 1;
        } else if a < b {
            lone[0].push(row);
            row += 1;
        } else {
            lone[1].push(other);
            other += 1;
        }
    }
    lone[0].extend(row..first.len());
    lone[1].extend(other..second.len());
    (pairs, lone)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_belong_together_by_their_number() {
        let tenths: Vec<f64> = (0..1000).map(|k| f64::from(k) * 0.1).collect();
        let sums = tenths.iter().scan(0.0, |sum, _| Some(std::mem::replace(sum, *sum + 0.1)));
        let summed: Vec<f64> = sums.collect();
        assert_ne!(tenths, summed);
        let (pairs, lone) = rows(&tenths, &summed);
        assert!(pairs.len() == 1000 && pairs.iter().all(|(a, b)| a == b) && lone.iter().all(Vec::is_empty));
    }

    #[test]
    fn lone_rows_and_rows_at_one_time_are_kept_apart() {
        // An event at 2: rows before and after it; the second table has the row before alone.
        let (pairs, lone) = rows(&[0.0, 1.0, 2.0, 2.0, 3.0], &[-1.0, 0.0, 2.0, 3.0, 4.0, 5.0]);
        assert_eq!(pairs, [(0, 1), (2, 2), (4, 3)]);
        assert_eq!(lone, [vec![1, 3], vec![0, 4, 5]]);
    }
}

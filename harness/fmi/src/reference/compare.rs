//! The measure of two tables: how far each column of one is from the same column of the other.
//!
//! Real: max over rows of |found - expected|, and that as a fraction of the largest |expected| of the vector or scalar over all rows.
//! Any other cell is the same or not: a difference is infinite.

use std::collections::BTreeMap;

use model_description::names;

/// A cell of a table.
#[derive(Clone, Debug, PartialEq)]
pub enum Cell {
    /// A number that may be a little off.
    Real(f64),
    /// Text that is the same or not.
    Exact(String),
}

impl Cell {
    /// A cell of a file without types: a number is a Real, a truth the number that others write for it.
    pub fn of_text(text: &str) -> Self {
        match text {
            "true" => Self::Real(1.0),
            "false" => Self::Real(0.0),
            _ => text.parse().map_or_else(|_| Self::Exact(text.to_owned()), Self::Real),
        }
    }

    /// Its magnitude; 0 of what has none.
    fn magnitude(&self) -> f64 {
        match self {
            Self::Real(value) if value.is_finite() => value.abs(),
            _ => 0.0,
        }
    }

    /// How far another one is off; NaN is NaN.
    fn difference(&self, found: &Self) -> f64 {
        match (self, found) {
            (Self::Real(expected), Self::Real(found)) => {
                let is_same = expected == found || expected.is_nan() && found.is_nan();
                let difference = (found - expected).abs();
                // What is no number is as far off as can be.
                if is_same {
                    0.0
                } else if difference.is_nan() {
                    f64::INFINITY
                } else {
                    difference
                }
            }
            (expected, found) if expected == found => 0.0,
            _ => f64::INFINITY,
        }
    }
}

impl std::fmt::Display for Cell {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Real(value) => write!(f, "{}", crate::csv::Real(*value)),
            Self::Exact(text) => f.write_str(text),
        }
    }
}

/// A column that two tables have, in the rows that both have.
#[derive(Clone, Debug, PartialEq)]
pub struct Compared {
    /// Name of the variable.
    pub name: String,
    /// Cells of the first table.
    pub expected: Vec<Cell>,
    /// Cells of the second table.
    pub found: Vec<Cell>,
}

/// Row in which a column differs most.
#[derive(Clone, Debug, PartialEq)]
pub struct Difference {
    /// Name of the variable.
    pub name: String,
    /// The row.
    pub row: usize,
    /// Cell of the first table there.
    pub expected: Cell,
    /// Cell of the second table there.
    pub found: Cell,
    /// In the variable's unit, infinite where a cell is no number.
    pub absolute: f64,
    /// As a fraction of the largest magnitude that the first table has of the vector or scalar.
    pub fraction: f64,
}

/// The largest difference of every column that is not the same, in the order of the columns.
pub fn differences(columns: &[Compared]) -> Vec<Difference> {
    let mut largest_of: BTreeMap<(&str, &str), f64> = BTreeMap::new();
    for column in columns {
        let largest = largest_of.entry(vector_of(&column.name)).or_default();
        *largest = column.expected.iter().map(Cell::magnitude).fold(*largest, f64::max);
    }
    let worst_of = |column: &Compared| {
        let pairs = column.expected.iter().zip(&column.found);
        let absolutes = pairs.map(|(expected, found)| expected.difference(found)).enumerate();
        let (row, absolute) =
            absolutes.rev().max_by(|a, b| a.1.total_cmp(&b.1)).filter(|(_, it)| *it > 0.0)?;
        Some(Difference {
            name: column.name.clone(),
            row,
            expected: column.expected[row].clone(),
            found: column.found[row].clone(),
            absolute,
            fraction: absolute / largest_of[&vector_of(&column.name)],
        })
    };
    columns.iter().filter_map(worst_of).collect()
}

/// Statistics that a campaign keeps of a variable, appended to its name.
const KEPT: [&str; 12] = [
    ".final",
    ".min",
    ".max",
    ".largest",
    ".timeOfLargest",
    ".p1",
    ".p5",
    ".p25",
    ".p50",
    ".p75",
    ".p95",
    ".p99",
];

/// The vector that a variable is a component of, or the variable; and what is kept of it.
fn vector_of(name: &str) -> (&str, &str) {
    let kept = KEPT.into_iter().find(|kept| name.ends_with(kept)).unwrap_or_default();
    let name = name.strip_suffix(kept).unwrap_or(name);
    (names::element(name).map_or(name, |(vector, _)| vector), kept)
}

#[cfg(test)]
mod tests;

//! Cells of a table: numbers with all their digits, and texts.

use crate::attitude::{Attitude, Vector};

/// What fills a cell, or several beside each other.
pub(crate) trait Cells {
    /// Their texts.
    fn cells(&self) -> Vec<String>;
}

/// Numbers with seven digits.
pub(crate) fn scientific(numbers: impl IntoIterator<Item = f64>) -> Vec<String> {
    numbers.into_iter().map(|number| format!("{number:.6e}")).collect()
}

/// A row of cells.
macro_rules! row {
    ($($cell:expr),+ $(,)?) => {
        [$($crate::cells::Cells::cells(&$cell)),+].concat()
    };
}
pub(crate) use row;

macro_rules! shown {
    ($($type:ty)+) => {$(
        impl Cells for $type {
            fn cells(&self) -> Vec<String> {
                vec![self.to_string()]
            }
        }
    )+};
}

shown!(bool i32 usize &str);

impl Cells for f64 {
    fn cells(&self) -> Vec<String> {
        vec![format!("{self:?}")]
    }
}

impl<T: Cells, const N: usize> Cells for [T; N] {
    fn cells(&self) -> Vec<String> {
        self.iter().flat_map(Cells::cells).collect()
    }
}

impl Cells for Vector {
    fn cells(&self) -> Vec<String> {
        self.iter().flat_map(Cells::cells).collect()
    }
}

impl Cells for Attitude {
    fn cells(&self) -> Vec<String> {
        self.coords.iter().flat_map(Cells::cells).collect()
    }
}

impl Cells for Vec<String> {
    fn cells(&self) -> Vec<String> {
        self.clone()
    }
}

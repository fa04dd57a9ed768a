//! The values of one instance: one flat table a type.

use model_description::value::Value;
use serde::{Deserialize, Serialize};

use super::handle::{Boolean, Choice, Enumeration, Integer, Real, RealMatrix, RealVector, Text};

/// The values of every variable of one instance, by type and place.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Values {
    pub(crate) reals: Vec<f64>,
    pub(crate) integers: Vec<i32>,
    pub(crate) booleans: Vec<bool>,
    pub(crate) strings: Vec<String>,
}

impl Values {
    /// Writes the value at a place in the table of its type.
    pub(crate) fn set(&mut self, position: usize, value: Value) {
        match value {
            Value::Real(value) => self.reals[position] = value,
            Value::Integer(value) => self.integers[position] = value,
            Value::Boolean(value) => self.booleans[position] = value,
            Value::Text(value) => self.strings[position] = value,
        }
    }

    /// Value of a Real.
    pub fn real(&self, handle: Real) -> f64 {
        self.reals[handle.0 as usize]
    }

    /// Writes a Real.
    pub fn set_real(&mut self, handle: Real, value: f64) {
        self.reals[handle.0 as usize] = value;
    }

    /// Value of a vector.
    pub fn vector<const N: usize>(&self, handle: RealVector<N>) -> [f64; N] {
        let first = handle.0 as usize;
        core::array::from_fn(|i| self.reals[first + i])
    }

    /// Writes a vector.
    pub fn set_vector<const N: usize>(&mut self, handle: RealVector<N>, value: [f64; N]) {
        let first = handle.0 as usize;
        self.reals[first..first + N].copy_from_slice(&value);
    }

    /// Value of a matrix, row by row.
    pub fn matrix<const R: usize, const C: usize>(&self, handle: RealMatrix<R, C>) -> [[f64; C]; R] {
        let first = handle.0 as usize;
        core::array::from_fn(|r| core::array::from_fn(|c| self.reals[first + r * C + c]))
    }

    /// Writes a matrix, row by row.
    pub fn set_matrix<const R: usize, const C: usize>(
        &mut self,
        handle: RealMatrix<R, C>,
        value: [[f64; C]; R],
    ) {
        for (r, row) in value.iter().enumerate() {
            let first = handle.0 as usize + r * C;
            self.reals[first..first + C].copy_from_slice(row);
        }
    }

    /// Value of an Integer.
    pub fn integer(&self, handle: Integer) -> i32 {
        self.integers[handle.0 as usize]
    }

    /// Writes an Integer.
    pub fn set_integer(&mut self, handle: Integer, value: i32) {
        self.integers[handle.0 as usize] = value;
    }

    /// Value of a Boolean.
    pub fn boolean(&self, handle: Boolean) -> bool {
        self.booleans[handle.0 as usize]
    }

    /// Writes a Boolean.
    pub fn set_boolean(&mut self, handle: Boolean, value: bool) {
        self.booleans[handle.0 as usize] = value;
    }

    /// Value of a String.
    pub fn text(&self, handle: Text) -> &str {
        &self.strings[handle.0 as usize]
    }

    /// Writes a String.
    pub fn set_text(&mut self, handle: Text, value: &str) {
        value.clone_into(&mut self.strings[handle.0 as usize]);
    }

    /// The chosen item; `None` cannot happen through the interface, which admits only known items.
    pub fn choice<E: Enumeration>(&self, handle: Choice<E>) -> Option<E> {
        E::from_value(self.integers[handle.0 as usize])
    }

    /// Writes a choice.
    pub fn set_choice<E: Enumeration>(&mut self, handle: Choice<E>, value: E) {
        self.integers[handle.0 as usize] = value.value();
    }
}

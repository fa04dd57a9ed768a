//! Variables: typed handles into flat tables, one table a base type.
//!
//! A value reference is the index into its table beyond the type's first reference, so a get or set is a subtraction and
//! one bounds-checked array access.

mod check;
mod declare;
mod handle;
mod values;

pub use declare::{Declare, DeclareError, RealSpec, Role, ScalarSpec, Table};
/// Names of `model-description` that a declaration uses.
pub use model_description::{Causality, EnumerationItem, Initial, Variability};

pub use handle::{Boolean, Choice, Enumeration, Integer, Real, RealMatrix, RealVector, Text};
pub use values::Values;

/// A group of declared variables; derived with `#[derive(Variables)]`.
pub trait Variables<Setup>: Sized {
    /// Declares the group's variables, in field order, under the scope's current prefix.
    ///
    /// `index` is the 0-based position in the innermost `Vec` of groups around this one, 0 outside of any.
    fn declare(scope: &mut Declare, setup: &Setup, index: usize) -> Result<Self, DeclareError>;
}

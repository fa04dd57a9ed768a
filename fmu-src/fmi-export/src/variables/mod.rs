//! Variables: what is declared of them, typed handles to them, and the flat tables of their values.
//!
//! A handle is a place in the table of its type, so reading and writing a value is one bounds-checked array access.

mod check;
mod declare;
mod handle;
mod interface;
mod values;
mod variable;

/// The standard's words for roles, which are the same in FMI 2.0 and 3.0.
pub use model_description::{Causality, Initial, Variability};

/// Annotations of variables for tools, without a version of FMI too.
pub use model_description::{Annotation, InterpolationKind, ReadWhere, VariableRole};

pub use declare::{Declare, DeclareError, GREATEST_SET, RealSpec, ScalarSpec};
pub use handle::{Boolean, Choice, Elements, Enumeration, Integer, Real, RealMatrix, RealVector, Text};
pub use interface::Interface;
pub(crate) use values::SetBits;
pub use values::{Given, Values};
pub use variable::{
    DeclaredEnumeration, DeclaredItem, DeclaredType, Element, EnumerationType, Item, Role, Variable,
};

/// A group of declared variables; derived with `#[derive(Variables)]`.
pub trait Variables<Setup>: Sized {
    /// Declares the group's variables, in field order, under the scope's current prefix.
    ///
    /// `index` is the 0-based position in the innermost `Vec` of groups around this one, 0 outside of any.
    fn declare(scope: &mut Declare, setup: &Setup, index: usize) -> Result<Self, DeclareError>;
}

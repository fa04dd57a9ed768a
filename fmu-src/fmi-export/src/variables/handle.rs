//! Handles: what a declared variable is to the model's code. Each holds the index into the table of its type.

use core::marker::PhantomData;

use model_description::{BaseType, EnumerationItem};

use crate::fmi2::references;

macro_rules! scalar_handle {
    ($(#[$doc:meta])* $name:ident, $base:ident) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub struct $name(pub(super) u32);

        impl $name {
            /// The FMI value reference.
            pub fn reference(self) -> u32 {
                references::first(BaseType::$base) + self.0
            }
        }
    };
}

scalar_handle!(
    /// A Real variable.
    Real,
    Real
);
scalar_handle!(
    /// An Integer variable.
    Integer,
    Integer
);
scalar_handle!(
    /// A Boolean variable.
    Boolean,
    Boolean
);
scalar_handle!(
    /// A String variable.
    Text,
    String
);

impl Real {
    /// The handle of a value reference, for code that walks references.
    pub fn from_reference(reference: u32) -> Self {
        Self(reference.wrapping_sub(references::first(BaseType::Real)))
    }
}

/// `N` Real variables `x[1]`..`x[N]` with consecutive references.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct RealVector<const N: usize>(pub(super) u32);

impl<const N: usize> RealVector<N> {
    /// Reference of the first element.
    pub fn reference(self) -> u32 {
        references::first(BaseType::Real) + self.0
    }

    /// Element `index`, 0-based, below `N`.
    pub fn element(self, index: usize) -> Real {
        debug_assert!(index < N);
        Real(self.0 + index as u32)
    }
}

/// `R * C` Real variables `x[1,1]`..`x[R,C]`, row by row.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct RealMatrix<const R: usize, const C: usize>(pub(super) u32);

impl<const R: usize, const C: usize> RealMatrix<R, C> {
    /// Reference of element (1,1).
    pub fn reference(self) -> u32 {
        references::first(BaseType::Real) + self.0
    }

    /// Element at 0-based `row` and `column`.
    pub fn element(self, row: usize, column: usize) -> Real {
        debug_assert!(row < R && column < C);
        Real(self.0 + (row * C + column) as u32)
    }
}

/// An Enumeration variable whose items are the variants of `E`.
#[derive(Debug)]
pub struct Choice<E>(pub(super) u32, pub(super) PhantomData<fn() -> E>);

impl<E> Clone for Choice<E> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<E> Copy for Choice<E> {}

impl<E> Choice<E> {
    /// The FMI value reference, one of the Integers'.
    pub fn reference(self) -> u32 {
        references::first(BaseType::Integer) + self.0
    }
}

/// A Rust enum offered as an FMI enumeration; derived with `#[derive(Enumeration)]`.
pub trait Enumeration: Copy + 'static {
    /// Name of the type definition.
    const TYPE_NAME: &'static str;
    /// What the choice is about.
    const DESCRIPTION: &'static str;
    /// The items in declaration order.
    fn items() -> Vec<EnumerationItem>;
    /// The variant of an item value.
    fn from_value(value: i32) -> Option<Self>;
    /// The item value of a variant.
    fn value(self) -> i32;
}

//! Handles: what a declared variable is to the model's code. Each holds the place of its first element in the table of its
//! type.

use core::marker::PhantomData;

use serde::{Deserialize, Serialize};

use super::variable::{Element, EnumerationType};

/// Scalars that follow one another in the table of their type: what a handle stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Elements {
    pub(crate) first: Element,
    pub(crate) count: usize,
}

impl Elements {
    /// Their places in the table.
    pub(crate) fn places(self) -> core::ops::Range<usize> {
        let first = self.first.place() as usize;
        first..first + self.count
    }
}

macro_rules! scalar_handle {
    ($(#[$doc:meta])* $name:ident) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
        pub struct $name(pub(crate) u32);

        impl From<$name> for Element {
            fn from(handle: $name) -> Self {
                Self::$name(handle.0)
            }
        }

        impl From<$name> for Elements {
            fn from(handle: $name) -> Self {
                Self { first: handle.into(), count: 1 }
            }
        }
    };
}

scalar_handle!(
    /// A Real variable.
    Real
);
scalar_handle!(
    /// An Integer variable.
    Integer
);
scalar_handle!(
    /// A Boolean variable.
    Boolean
);
scalar_handle!(
    /// A String variable.
    Text
);

/// `N` Real variables `x[1]`..`x[N]`, one after the other.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct RealVector<const N: usize>(pub(crate) u32);

impl<const N: usize> RealVector<N> {
    /// Element `index`, 0-based, below `N`.
    pub fn element(self, index: usize) -> Real {
        debug_assert!(index < N);
        Real(self.0 + index as u32)
    }

    /// The 0-based index of an element of this vector; `None` for any other Real.
    pub fn index_of(self, element: Real) -> Option<usize> {
        element.0.checked_sub(self.0).map(|index| index as usize).filter(|index| *index < N)
    }
}

/// `R * C` Real variables `x[1,1]`..`x[R,C]`, row by row.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct RealMatrix<const R: usize, const C: usize>(pub(crate) u32);

impl<const R: usize, const C: usize> RealMatrix<R, C> {
    /// Element at 0-based `row` and `column`.
    pub fn element(self, row: usize, column: usize) -> Real {
        debug_assert!(row < R && column < C);
        Real(self.0 + (row * C + column) as u32)
    }

    /// The 0-based row and column of an element of this matrix; `None` for any other Real.
    pub fn index_of(self, element: Real) -> Option<(usize, usize)> {
        let index = element.0.checked_sub(self.0)? as usize;
        (index < R * C).then(|| (index / C, index % C))
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

impl<E> From<Choice<E>> for Element {
    fn from(handle: Choice<E>) -> Self {
        Self::Integer(handle.0)
    }
}

impl<E> From<Choice<E>> for Elements {
    fn from(handle: Choice<E>) -> Self {
        Self { first: handle.into(), count: 1 }
    }
}

impl<const N: usize> From<RealVector<N>> for Elements {
    fn from(handle: RealVector<N>) -> Self {
        Self { first: Element::Real(handle.0), count: N }
    }
}

impl<const R: usize, const C: usize> From<RealMatrix<R, C>> for Elements {
    fn from(handle: RealMatrix<R, C>) -> Self {
        Self { first: Element::Real(handle.0), count: R * C }
    }
}

/// A Rust enum offered as an enumeration; derived with `#[derive(Enumeration)]`.
pub trait Enumeration: Copy + 'static {
    /// The type with its items.
    const TYPE: EnumerationType;
    /// The variant of the first item.
    const FIRST: Self;
    /// The variant of an item value.
    fn from_value(value: i32) -> Option<Self>;
    /// The item value of a variant.
    fn value(self) -> i32;
}

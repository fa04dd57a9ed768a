//! Handles: what a declared variable is to the model's code. Each holds the place of its first element in the table of its
//! type.

use core::marker::PhantomData;

use model_description::BaseType;
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
        let first = self.first.place as usize;
        first..first + self.count
    }
}

/// Declares base type and number of elements of each type of handle.
macro_rules! elements {
    ($([$($generics:tt)*] $handle:ty: $base:ident $count:expr;)*) => { $(
        impl<$($generics)*> From<$handle> for Elements {
            fn from(handle: $handle) -> Self {
                Self { first: Element { base: BaseType::$base, place: handle.0 }, count: $count }
            }
        }
    )* };
}

elements! {
    [] Real: Real 1;
    [] Integer: Integer 1;
    [] Boolean: Boolean 1;
    [] Text: String 1;
    [E] Choice<E>: Integer 1;
    [const N: usize] RealVector<N>: Real N;
    [const R: usize, const C: usize] RealMatrix<R, C>: Real R * C;
}

impl From<Element> for Elements {
    fn from(first: Element) -> Self {
        Self { first, count: 1 }
    }
}

/// A Real variable.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct Real(pub(crate) u32);

/// An Integer variable.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Integer(pub(crate) u32);

/// A Boolean variable.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Boolean(pub(crate) u32);

/// A String variable.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Text(pub(crate) u32);

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

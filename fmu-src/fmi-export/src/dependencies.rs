//! Dependencies of outputs and unknowns of initialization, by handles.
//!
//! A model writes one row a group of unknowns; whole sections of variables may stand on either side:
//!
//! ```ignore
//! table.output(&v.attitude, &v.command, knowns![&v.start, &v.orbit]);
//! ```

use std::collections::BTreeMap;

use model_description::BaseType;
use serde::Serialize;

use crate::variables::{Boolean, Choice, Element, Elements, Integer, Real, RealMatrix, RealVector, Text};

/// A set of scalar variables of any type: for each table of values one bit a place, in words up to the last that is not
/// zero.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Knowns([Vec<u64>; Element::TABLES]);

/// The union of any number of handles, vectors, matrices and sets as [`Knowns`].
#[macro_export]
macro_rules! knowns {
    ($($part:expr),* $(,)?) => {
        $crate::Knowns::default()$(.and($part))*
    };
}

impl Knowns {
    /// No variable.
    pub(crate) const NONE: Self = Self([const { Vec::new() }; Element::TABLES]);

    /// With `other` as well.
    #[must_use]
    pub fn and(mut self, other: impl Into<Self>) -> Self {
        self.extend(&other.into());
        self
    }

    /// `self` where `condition` holds, else nothing.
    #[must_use]
    pub fn only_if(self, condition: bool) -> Self {
        if condition { self } else { Self::default() }
    }

    /// The elements in ascending order.
    pub(crate) fn elements(&self) -> impl Iterator<Item = Element> + '_ {
        let bits = |word: u64| (0..u64::BITS).filter(move |bit| word >> bit & 1 == 1);
        BaseType::ALL.into_iter().zip(&self.0).flat_map(move |(base, words)| {
            let places =
                (0..).zip(words).flat_map(move |(at, &word)| bits(word).map(move |bit| at * u64::BITS + bit));
            places.map(move |place| Element { base, place })
        })
    }

    /// How many there are.
    pub(crate) fn len(&self) -> usize {
        self.0.iter().flatten().map(|word| word.count_ones() as usize).sum()
    }

    fn extend(&mut self, other: &Self) {
        for (words, others) in self.0.iter_mut().zip(&other.0) {
            if words.len() < others.len() {
                words.resize(others.len(), 0);
            }
            for (word, other) in words.iter_mut().zip(others) {
                *word |= other;
            }
        }
    }

    pub(crate) fn span(Elements { first, count }: Elements) -> Self {
        let mut set = Self::default();
        let words = &mut set.0[first.table()];
        for place in (first.place..).take(count) {
            let at = (place / u64::BITS) as usize;
            if words.len() <= at {
                words.resize(at + 1, 0);
            }
            words[at] |= 1 << (place % u64::BITS);
        }
        set
    }
}

impl<T: Into<Knowns>> FromIterator<T> for Knowns {
    fn from_iter<I: IntoIterator<Item = T>>(parts: I) -> Self {
        parts.into_iter().fold(Self::default(), Self::and)
    }
}

/// Every handle is a set.
macro_rules! handles {
    ($([$($generics:tt)*] $handle:ty;)*) => { $(
        impl<$($generics)*> From<$handle> for Knowns {
            fn from(handle: $handle) -> Self {
                Self::span(handle.into())
            }
        }
    )* };
}

handles! {
    [] Real;
    [] Integer;
    [] Boolean;
    [] Text;
    [E] Choice<E>;
    [const N: usize] RealVector<N>;
    [const R: usize, const C: usize] RealMatrix<R, C>;
}

impl From<&Knowns> for Knowns {
    fn from(set: &Knowns) -> Self {
        set.clone()
    }
}

/// A group of declared variables as a set; derived with `#[derive(Variables)]`.
pub trait Section {
    /// All its variables, whatever their causality.
    fn section(&self) -> Knowns;
}

impl<T: Section> Section for Vec<T> {
    fn section(&self) -> Knowns {
        self.iter().map(Section::section).collect()
    }
}

impl<T: Section> From<&T> for Knowns {
    fn from(group: &T) -> Self {
        group.section()
    }
}

/// The two lists of a model. Every output that is not constant has a row, and so has every calculated parameter. Sections may
/// stand on either side: of unknowns the outputs and calculated parameters count, of `at_steps` the inputs, of `at_start` the
/// parameters with `initial="exact"`.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Dependencies {
    /// Inputs that count for each output.
    pub(crate) at_steps: BTreeMap<Element, Knowns>,
    /// Parameters that count for each output and calculated parameter after initialization.
    pub(crate) at_start: BTreeMap<Element, Knowns>,
    /// Further inputs that count for an output after initialization.
    pub(crate) inputs_at_start: BTreeMap<Element, Knowns>,
}

impl Dependencies {
    /// An empty table.
    pub fn new() -> Self {
        Self::default()
    }

    /// Outputs, every element alike. `at_steps` are the inputs whose change at a communication point tc can change an output
    /// at tc + h by something that does not vanish as h goes to 0; what acts through an integrated state is left out. The same
    /// inputs and the parameters `at_start` can change the value after initialization.
    pub fn output(
        &mut self,
        outputs: impl Into<Knowns>,
        at_steps: impl Into<Knowns>,
        at_start: impl Into<Knowns>,
    ) {
        let outputs = outputs.into();
        insert(&mut self.at_steps, &outputs, &at_steps.into());
        insert(&mut self.at_start, &outputs, &at_start.into());
    }

    /// Outputs whose value after initialization these inputs can change too, though in steps they do not at once.
    pub fn begins(&mut self, outputs: impl Into<Knowns>, inputs: impl Into<Knowns>) {
        insert(&mut self.inputs_at_start, &outputs.into(), &inputs.into());
    }

    /// Calculated parameters, every element alike, and the parameters they are calculated from.
    pub fn calculated(&mut self, parameters: impl Into<Knowns>, at_start: impl Into<Knowns>) {
        insert(&mut self.at_start, &parameters.into(), &at_start.into());
    }
}

/// Rows given twice add up: an element may have more than its group.
fn insert(rows: &mut BTreeMap<Element, Knowns>, unknowns: &Knowns, knowns: &Knowns) {
    for unknown in unknowns.elements() {
        rows.entry(unknown).or_default().extend(knowns);
    }
}

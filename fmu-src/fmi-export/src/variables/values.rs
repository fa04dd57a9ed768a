//! The values of one instance: one flat table a type.

use model_description::{BaseType, value::Value};
use serde::{Deserialize, Serialize};

use super::handle::{Boolean, Choice, Elements, Enumeration, Integer, Real, RealMatrix, RealVector, Text};
use super::variable::Element;

/// The values of every variable of one instance, by type and index, and which of them somebody set.
#[derive(Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Values {
    pub(crate) reals: Vec<f64>,
    pub(crate) integers: Vec<i32>,
    pub(crate) booleans: Vec<bool>,
    pub(crate) strings: Vec<String>,
    /// By the order of these tables.
    pub(crate) set: [SetBits; Element::TABLES],
}

/// A copy takes no new memory where the lengths agree, and writes no marks that agree.
impl Clone for Values {
    fn clone(&self) -> Self {
        let mut copy = Self::default();
        copy.clone_from(self);
        copy
    }

    fn clone_from(&mut self, other: &Self) {
        self.reals.clone_from(&other.reals);
        self.integers.clone_from(&other.integers);
        self.booleans.clone_from(&other.booleans);
        self.strings.clone_from(&other.strings);
        for (mine, theirs) in self.set.iter_mut().zip(&other.set).filter(|(mine, theirs)| mine != theirs) {
            mine.0.clone_from(&theirs.0);
        }
    }
}

/// One bit for every index of a table: whether its value was set.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct SetBits(Vec<u64>);

impl SetBits {
    /// Words for a table of this length.
    pub(crate) const fn words(length: usize) -> usize {
        length.div_ceil(u64::BITS as usize)
    }

    /// Makes a set from one truth value a place.
    pub(crate) fn new(places: impl ExactSizeIterator<Item = bool>) -> Self {
        let mut bits = Self(vec![0; Self::words(places.len())]);
        places.enumerate().filter(|(_, holds)| *holds).for_each(|(place, _)| bits.mark(place));
        bits
    }

    pub(crate) fn len(&self) -> usize {
        self.0.len()
    }

    #[inline]
    pub(crate) fn is_set(&self, place: usize) -> bool {
        let word = self.0.get(place / u64::BITS as usize).copied().unwrap_or(0);
        word >> (place % u64::BITS as usize) & 1 == 1
    }

    /// Indices of the values that are set.
    fn indices(&self) -> impl Iterator<Item = usize> {
        bits_of(self.0.iter().copied())
    }

    /// The words, with the bits that `among` has as well.
    fn words_within(&self, among: &Self) -> impl Iterator<Item = u64> {
        self.0.iter().zip(&among.0).map(|(word, among)| word & among)
    }

    #[inline]
    pub(crate) fn mark(&mut self, place: usize) {
        if let Some(word) = self.0.get_mut(place / u64::BITS as usize) {
            *word |= 1 << (place % u64::BITS as usize);
        }
    }
}

/// Places of the bits of words.
fn bits_of(words: impl Iterator<Item = u64>) -> impl Iterator<Item = usize> {
    words.enumerate().flat_map(|(word, bits)| {
        let left = core::iter::successors(Some(bits), |bits| bits.checked_sub(1).map(|less| bits & less));
        left.take_while(|bits| *bits != 0)
            .map(move |bits| word * u64::BITS as usize + bits.trailing_zeros() as usize)
    })
}

impl Values {
    /// The number of values of each table.
    pub(crate) fn lengths(&self) -> [usize; Element::TABLES] {
        [self.reals.len(), self.integers.len(), self.booleans.len(), self.strings.len()]
    }

    /// Marks every value as not set.
    pub(crate) fn mark_none(&mut self) {
        let lengths = self.lengths();
        for (bits, length) in self.set.iter_mut().zip(lengths) {
            bits.0.clear();
            bits.0.resize(SetBits::words(length), 0);
        }
    }

    /// Whether the importer set the variable, of an array any element, be it to the value it had. Of the start values: whether
    /// the setup gave it.
    pub fn is_set(&self, variable: impl Into<Elements>) -> bool {
        let elements = variable.into();
        elements.places().any(|place| self.set[elements.first.table()].is_set(place))
    }

    /// Whether all of these places were set.
    pub(crate) fn are_all_set(&self, places: &[SetBits; Element::TABLES]) -> bool {
        self.set.iter().zip(places).all(|(set, places)| places.indices().all(|place| set.is_set(place)))
    }

    /// Whether the importer set every element of the variable to what it is in `start`.
    fn repeats(&self, start: &Self, elements: Elements) -> bool {
        let (base, table) = (elements.first.base, elements.first.table());
        elements.places().all(|place| self.set[table].is_set(place) && self.is_same(start, base, place))
    }

    /// Whether two values are equal bit by bit.
    pub(crate) fn is_same(&self, other: &Self, base: BaseType, place: usize) -> bool {
        match base {
            BaseType::Real => {
                let bits = |values: &Self| values.reals.get(place).map(|value| value.to_bits());
                bits(self) == bits(other)
            }
            BaseType::Integer => self.integers.get(place) == other.integers.get(place),
            BaseType::Boolean => self.booleans.get(place) == other.booleans.get(place),
            BaseType::String => self.strings.get(place) == other.strings.get(place),
        }
    }

    /// Takes over one value.
    pub(crate) fn copy_value(&mut self, from: &Self, base: BaseType, place: usize) {
        match base {
            BaseType::Real => self.reals[place] = from.reals[place],
            BaseType::Integer => self.integers[place] = from.integers[place],
            BaseType::Boolean => self.booleans[place] = from.booleans[place],
            BaseType::String => self.strings[place].clone_from(&from.strings[place]),
        }
    }

    /// A value as text.
    pub(crate) fn shown(&self, base: BaseType, place: usize) -> String {
        match base {
            BaseType::Real => self.reals.get(place).map(|it| format!("{it:?}")),
            BaseType::Integer => self.integers.get(place).map(i32::to_string),
            BaseType::Boolean => self.booleans.get(place).map(bool::to_string),
            BaseType::String => self.strings.get(place).map(|it| format!("{it:?}")),
        }
        .unwrap_or_default()
    }

    /// Whether one of these variables was set to another value than in `before`, or for the first time.
    pub(crate) fn differ_among(&self, before: &Self, among: &[SetBits; Element::TABLES]) -> bool {
        let mut tables = BaseType::ALL.into_iter().zip(&self.set).zip(before.set.iter().zip(among));
        tables.any(|((base, set), (set_before, among))| {
            let is_new = set.words_within(among).ne(set_before.words_within(among));
            is_new || bits_of(set.words_within(among)).any(|place| !self.is_same(before, base, place))
        })
    }

    /// Whether all values that the importer set equal those of `before`, bit by bit. No others change between steps.
    pub(crate) fn set_values_equal(&self, before: &Self) -> bool {
        let mut tables = BaseType::ALL.into_iter().zip(&self.set);
        tables.all(|(base, set)| set.indices().all(|index| self.is_same(before, base, index)))
    }

    /// Writes the value that a setup gives at a place in the table of its type.
    pub(crate) fn give(&mut self, position: usize, value: Value) {
        self.set[value.base_type() as usize].mark(position);
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

    /// The chosen item. Declaration, sets and restored states admit no other values than items'.
    pub fn choice<E: Enumeration>(&self, handle: Choice<E>) -> E {
        E::from_value(self.integers[handle.0 as usize]).unwrap_or(E::FIRST)
    }

    /// Writes a choice.
    pub fn set_choice<E: Enumeration>(&mut self, handle: Choice<E>, value: E) {
        self.integers[handle.0 as usize] = value.value();
    }
}

/// The variables of a group that the user gave a value, be it the start value: in the setup or by a set. Where the importer set every
/// variable of the group to its start value, as tools do that write all of them, its sets say nothing.
#[derive(Clone, Copy, Debug)]
pub struct Given<'a> {
    values: &'a Values,
    start: &'a Values,
    by_importer: bool,
}

impl<'a> Given<'a> {
    /// Looks at the variables of `group`; `start` are the start values.
    pub fn among(values: &'a Values, start: &'a Values, group: &[Elements]) -> Self {
        let by_importer = !group.iter().all(|&elements| values.repeats(start, elements));
        Self { values, start, by_importer }
    }

    /// The same, but where the importer did not set every parameter of the FMU each of its sets counts.
    pub(crate) fn deliberately(self, sets_all_parameters: bool) -> Self {
        Self { by_importer: self.by_importer || !sets_all_parameters, ..self }
    }

    /// Whether the user gave this one, of an array any element.
    pub fn has(&self, variable: impl Into<Elements>) -> bool {
        let elements = variable.into();
        self.start.is_set(elements) || (self.by_importer && self.values.is_set(elements))
    }

    /// The value of a Real that the user gave, else `own`.
    pub fn real_or(&self, variable: Real, own: f64) -> f64 {
        if self.has(variable) { self.values.real(variable) } else { own }
    }

    /// The item that the user gave, else `own`.
    pub fn choice_or<E: Enumeration>(&self, variable: Choice<E>, own: E) -> E {
        if self.has(variable) { self.values.choice(variable) } else { own }
    }
}

#[cfg(test)]
mod tests;

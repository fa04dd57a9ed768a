//! Value references: an element's place in the table of its base type, counted on from the type's first reference.
//!
//! No reference means two variables, for tools store results by reference alone; a get or set is a subtraction and one
//! bounds-checked array access.

use model_description::{BaseType, ScalarVariable};

use crate::variables::{Element, Elements};

/// Most elements of one base type.
pub const MOST: u32 = 1_000_000;

/// The value reference of the first element of a base type.
pub const fn first(base: BaseType) -> u32 {
    base as u32 * MOST
}

/// The base type whose elements have references like this one.
pub fn base_type(reference: u32) -> Option<BaseType> {
    BaseType::ALL.get((reference / MOST) as usize).copied()
}

/// The index of a reference in the table of a base type; beyond the table's end for another type's reference.
#[inline]
pub const fn index(base: BaseType, reference: u32) -> usize {
    reference.wrapping_sub(first(base)) as usize
}

/// The value reference of a variable, of an array that of its first element.
pub fn for_variable(variable: impl Into<Elements>) -> u32 {
    let Element { base, place } = variable.into().first;
    first(base) + place
}

/// The element of a value reference, whether a model has it or not.
pub fn element(reference: u32) -> Option<Element> {
    let base = base_type(reference)?;
    Some(Element { base, place: reference - first(base) })
}

/// Checks that the references of each base type count on from [`first`]; the error names a variable out of order.
pub(crate) fn check_dense(variables: &[ScalarVariable]) -> Result<(), String> {
    let mut counts = [0_usize; 4];
    for ScalarVariable { name, value_reference, kind, .. } in variables {
        let base = kind.base_type();
        let count = counts[base as usize];
        if index(base, *value_reference) != count || count >= MOST as usize {
            let first = first(base);
            return Err(format!(
                "variable `{name}` has value reference {value_reference}, expected {} of at most {MOST} from {first}",
                first as usize + count,
            ));
        }
        counts[base as usize] += 1;
    }
    Ok(())
}

//! From C arguments to Rust values. `n == 0` never touches a pointer; NULL is an error that names the argument.

use core::ffi::{CStr, c_char, c_int};

use super::problem::Problem;

/// For an argument that must not be NULL.
pub(super) fn null(name: &str) -> Problem {
    Problem::argument(name, "is NULL")
}

fn check<T>(pointer: *const T, length: usize, name: &str) -> Result<(), Problem> {
    if pointer.is_null() {
        return Err(null(name));
    }
    // No array is larger than half the address space; a length that says so is a negative number.
    if length > isize::MAX as usize / size_of::<T>() {
        return Err(Problem::argument(name, format_args!("cannot have {length} elements")));
    }
    Ok(())
}

/// The `length` elements at `pointer`.
///
/// # Safety
/// A `pointer` that is not NULL points to `length` readable elements for the time of the call.
#[inline]
pub(super) unsafe fn slice<'a, T>(pointer: *const T, length: usize, name: &str) -> Result<&'a [T], Problem> {
    if length == 0 {
        return Ok(&[]);
    }
    check(pointer, length, name)?;
    // SAFETY: not NULL, of a possible length; the rest is the caller's promise.
    Ok(unsafe { core::slice::from_raw_parts(pointer, length) })
}

/// The `length` elements at `pointer`, to be written.
///
/// # Safety
/// A `pointer` that is not NULL points to `length` writable elements for the time of the call.
#[inline]
pub(super) unsafe fn slice_mut<'a, T>(
    pointer: *mut T,
    length: usize,
    name: &str,
) -> Result<&'a mut [T], Problem> {
    if length == 0 {
        return Ok(&mut []);
    }
    check(pointer, length, name)?;
    // SAFETY: not NULL, of a possible length; the rest is the caller's promise.
    Ok(unsafe { core::slice::from_raw_parts_mut(pointer, length) })
}

/// The one value at `pointer`, to be written.
///
/// # Safety
/// As [`slice_mut`], for one element.
pub(super) unsafe fn place<'a, T>(pointer: *mut T, name: &str) -> Result<&'a mut T, Problem> {
    // SAFETY: the caller's promise.
    unsafe { pointer.as_mut() }.ok_or_else(|| null(name))
}

/// The C string at `pointer`.
///
/// # Safety
/// A `pointer` that is not NULL points to a NUL-terminated string that is valid during the call.
pub(super) unsafe fn text<'a>(pointer: *const c_char, name: &str) -> Result<&'a CStr, Problem> {
    if pointer.is_null() {
        return Err(null(name));
    }
    // SAFETY: not NULL; the rest is the caller's promise.
    Ok(unsafe { CStr::from_ptr(pointer) })
}

/// A `fmi2Boolean`.
#[inline]
pub(super) fn flag(value: c_int, name: &str) -> Result<bool, Problem> {
    match value {
        0 => Ok(false),
        1 => Ok(true),
        other => Err(Problem::argument(
            name,
            format_args!("is {other}, allowed are 0 (fmi2False) and 1 (fmi2True)"),
        )),
    }
}

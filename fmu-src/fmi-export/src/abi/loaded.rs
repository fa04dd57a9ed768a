//! The two functions through which everything in a shared library begins: they quieten its panics first.
//!
//! In a program that links this crate, panics are the program's affair.

use core::ffi::{c_char, c_int, c_void};

use super::{CallbackFunctions, Receive};
use crate::library::Library;
use crate::panics::keep_quiet;

/// [`super::instantiate`] in a shared library.
///
/// # Safety
/// As there.
#[allow(clippy::too_many_arguments, reason = "the standard's signature")]
pub unsafe fn instantiate(
    library: &Library,
    instance_name: *const c_char,
    fmu_type: c_int,
    guid: *const c_char,
    resource_location: *const c_char,
    functions: *const CallbackFunctions,
    visible: c_int,
    logging_on: c_int,
) -> *mut c_void {
    keep_quiet();
    // SAFETY: the caller's promise.
    unsafe {
        super::instantiate(
            library,
            instance_name,
            fmu_type,
            guid,
            resource_location,
            functions,
            visible,
            logging_on,
        )
    }
}

/// [`super::describe`] in a shared library.
///
/// # Safety
/// As there.
pub unsafe fn describe(
    library: &Library,
    model: *const c_char,
    setup_file: *const c_char,
    setup_text: *const c_char,
    context: *mut c_void,
    receive: Option<Receive>,
) -> c_int {
    keep_quiet();
    // SAFETY: the caller's promise.
    unsafe { super::describe(library, model, setup_file, setup_text, context, receive) }
}

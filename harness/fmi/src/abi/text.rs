//! Texts of the C interface.

use std::ffi::{CStr, c_char};

/// Copies a C text; `None` for NULL.
///
/// # Safety
/// `pointer` is NULL or points to bytes that end with zero.
pub(super) unsafe fn text(pointer: *const c_char) -> Option<String> {
    // SAFETY: the caller's promise.
    (!pointer.is_null()).then(|| unsafe { CStr::from_ptr(pointer) }.to_string_lossy().into_owned())
}

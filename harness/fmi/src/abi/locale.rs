//! The locale of the C library.

use std::ffi::{CString, c_char, c_int};

unsafe extern "C" {
    fn setlocale(category: c_int, locale: *const c_char) -> *const c_char;
}

/// Puts the whole process under a locale of the C library, as some simulation tools do; false if the computer
/// does not have it. Call it while no other thread runs.
pub fn set_locale(name: &str) -> bool {
    // `LC_ALL` is 6 in glibc and musl, 0 elsewhere.
    let all = if cfg!(target_os = "linux") { 6 } else { 0 };
    let Ok(name) = CString::new(name) else { return false };
    // SAFETY: the name is valid during the call; the answer is only compared with NULL.
    !unsafe { setlocale(all, name.as_ptr()) }.is_null()
}

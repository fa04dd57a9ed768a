//! Path of this shared library, as the system's loader has it.
#![allow(unsafe_code, reason = "the loader is asked through C functions")]

use std::path::PathBuf;

/// The path of the file that this code was loaded from; absent where the loader does not tell it.
#[cfg(unix)]
pub(super) fn of_library() -> Option<PathBuf> {
    use core::ffi::{CStr, c_char, c_int, c_void};
    use std::os::unix::ffi::OsStrExt;

    /// `Dl_info` of `dlfcn.h`.
    #[repr(C)]
    struct LoadedObject {
        file_name: *const c_char,
        base: *mut c_void,
        symbol_name: *const c_char,
        symbol: *mut c_void,
    }

    unsafe extern "C" {
        /// Writes what was loaded at an address; 0 where nothing was.
        fn dladdr(address: *const c_void, object: *mut LoadedObject) -> c_int;
    }

    let mut object = LoadedObject {
        file_name: core::ptr::null(),
        base: core::ptr::null_mut(),
        symbol_name: core::ptr::null(),
        symbol: core::ptr::null_mut(),
    };
    // SAFETY: the address is that of a function, and `object` has the layout of `Dl_info`.
    if unsafe { dladdr(of_library as *const c_void, &raw mut object) } == 0 || object.file_name.is_null() {
        return None;
    }
    // SAFETY: the name is the loader's and stays while the library is loaded.
    let name = unsafe { CStr::from_ptr(object.file_name) };
    std::fs::canonicalize(std::ffi::OsStr::from_bytes(name.to_bytes())).ok()
}

/// The path of the file that this code was loaded from; absent where the loader does not tell it.
#[cfg(windows)]
pub(super) fn of_library() -> Option<PathBuf> {
    use core::ffi::c_void;
    use std::os::windows::ffi::OsStringExt;

    /// By an address within, and without counting as a user of it.
    const FROM_ADDRESS_UNCOUNTED: u32 = 0x4 | 0x2;

    #[link(name = "kernel32")]
    unsafe extern "system" {
        fn GetModuleHandleExW(flags: u32, address: *const c_void, module: *mut *mut c_void) -> i32;
        fn GetModuleFileNameW(module: *mut c_void, name: *mut u16, capacity: u32) -> u32;
    }

    let mut module = core::ptr::null_mut();
    // SAFETY: the address is that of a function of this library.
    if unsafe { GetModuleHandleExW(FROM_ADDRESS_UNCOUNTED, of_library as *const c_void, &raw mut module) }
        == 0
    {
        return None;
    }
    // The longest path of Windows.
    let mut name = vec![0_u16; 32_768];
    // SAFETY: `name` has the announced capacity, and the module is loaded, for this code is its.
    let length = unsafe { GetModuleFileNameW(module, name.as_mut_ptr(), name.len() as u32) } as usize;
    (length > 0 && length < name.len()).then(|| std::ffi::OsString::from_wide(&name[..length]).into())
}

/// The path of the file that this code was loaded from; absent where the loader does not tell it.
#[cfg(not(any(unix, windows)))]
pub(super) fn of_library() -> Option<PathBuf> {
    None
}

//! `_dl_find_object` for the unwinder that is linked into the shared library.
//!
//! The static libgcc of a new compiler finds unwind tables by this function of glibc 2.35. Defined here and hidden,
//! over `dl_iterate_phdr`, it lets the library load on older systems. Only a panic calls it.

use core::{
    arch::global_asm,
    ffi::{c_char, c_int, c_void},
    mem::offset_of,
};

#[cfg(target_arch = "x86_64")]
global_asm!(
    ".globl _dl_find_object",
    ".hidden _dl_find_object",
    ".type _dl_find_object, @function",
    "_dl_find_object:",
    "jmp {find}",
    find = sym find_object,
);
#[cfg(target_arch = "aarch64")]
global_asm!(
    ".globl _dl_find_object",
    ".hidden _dl_find_object",
    ".type _dl_find_object, @function",
    "_dl_find_object:",
    "b {find}",
    find = sym find_object,
);

/// `struct dl_find_object` of `<dlfcn.h>`.
#[repr(C)]
#[derive(Debug)]
struct FoundObject {
    flags: u64,
    map_start: *mut c_void,
    map_end: *mut c_void,
    link_map: *mut c_void,
    eh_frame: *mut c_void,
    reserved: [u64; 7],
}

/// `Elf64_Phdr`.
#[repr(C)]
struct ProgramHeader {
    kind: u32,
    flags: u32,
    offset: u64,
    virtual_address: usize,
    physical_address: usize,
    file_size: u64,
    memory_size: usize,
    alignment: u64,
}

/// The beginning of `struct dl_phdr_info`.
#[repr(C)]
struct LoadedObject {
    base: usize,
    name: *const c_char,
    headers: *const ProgramHeader,
    header_count: u16,
}

/// Kinds of program headers: a mapped segment, and the table of unwind information.
const PT_LOAD: u32 = 1;
const PT_GNU_EH_FRAME: u32 = 0x6474_e550;

unsafe extern "C" {
    fn dl_iterate_phdr(
        visit: unsafe extern "C" fn(*const LoadedObject, usize, *mut c_void) -> c_int,
        data: *mut c_void,
    ) -> c_int;
}

struct Search {
    address: usize,
    found: Option<FoundObject>,
}

/// Finds the loaded object whose code holds `address`: 0 and the object, or -1.
///
/// # Safety
/// `result` is a place for a [`FoundObject`].
unsafe extern "C" fn find_object(address: *mut c_void, result: *mut FoundObject) -> c_int {
    let mut search = Search { address: address as usize, found: None };
    // SAFETY: `visit` is called with the pointer to `search`, before this call returns.
    unsafe { dl_iterate_phdr(visit, (&raw mut search).cast()) };
    let Some(found) = search.found else { return -1 };
    // SAFETY: the caller's promise.
    unsafe { result.write(found) };
    0
}

/// Looks at one loaded object; 1 ends the iteration.
///
/// # Safety
/// `data` is the [`Search`] of [`find_object`].
unsafe extern "C" fn visit(object: *const LoadedObject, size: usize, data: *mut c_void) -> c_int {
    if size < offset_of!(LoadedObject, header_count) + size_of::<u16>() {
        return 0;
    }
    // SAFETY: the C library hands out a valid object and its headers; `data` is what `find_object` passed.
    let (object, search) = unsafe { (&*object, &mut *data.cast::<Search>()) };
    if object.headers.is_null() {
        return 0;
    }
    // SAFETY: as above.
    let headers = unsafe { core::slice::from_raw_parts(object.headers, object.header_count.into()) };
    let start = |header: &ProgramHeader| object.base.wrapping_add(header.virtual_address);
    let segment = headers.iter().find(|header| {
        header.kind == PT_LOAD && search.address.wrapping_sub(start(header)) < header.memory_size
    });
    let (Some(segment), Some(table)) =
        (segment, headers.iter().find(|header| header.kind == PT_GNU_EH_FRAME))
    else {
        return 0;
    };
    search.found = Some(FoundObject {
        flags: 0,
        map_start: start(segment) as *mut c_void,
        map_end: start(segment).wrapping_add(segment.memory_size) as *mut c_void,
        link_map: core::ptr::null_mut(),
        eh_frame: start(table) as *mut c_void,
        reserved: [0; 7],
    });
    1
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_object_of_a_function_of_this_program_is_found_and_null_is_in_none() {
        let address = visit as *mut c_void;
        let mut found = core::mem::MaybeUninit::<FoundObject>::uninit();
        // SAFETY: `found` is a place for the answer.
        let answer = unsafe { find_object(address, found.as_mut_ptr()) };
        assert_eq!(answer, 0);
        // SAFETY: written, as the answer is 0.
        let found = unsafe { found.assume_init() };
        assert!(found.map_start <= address && address < found.map_end, "{found:?}");
        // SAFETY: the header of the table begins with its version, 1.
        assert_eq!(unsafe { found.eh_frame.cast::<u8>().read() }, 1);
        let mut nothing = core::mem::MaybeUninit::<FoundObject>::uninit();
        // SAFETY: as above.
        assert_eq!(unsafe { find_object(core::ptr::null_mut(), nothing.as_mut_ptr()) }, -1);
    }
}

//! The C interface: every function of FMI 2.0 co-simulation, over any [`crate::Library`].
//!
//! Here, and nowhere else in this crate, pointers are followed. [`boundary`] is the panic boundary and guards
//! handles, [`arguments`] turns pointers into slices and texts, [`functions`] is one thin function a symbol,
//! [`crate::export!`] emits the symbols into a cdylib. [`InProcess`] drives the same functions from safe Rust.
#![allow(unsafe_code, reason = "the C interface takes raw pointers")]

mod arguments;
mod boundary;
mod describe;
mod export;
#[cfg(all(target_os = "linux", target_env = "gnu", any(target_arch = "x86_64", target_arch = "aarch64")))]
mod find_object;
mod functions;
mod in_process;
pub mod loaded;

pub use describe::{Receive, describe, kind};
pub use functions::*;
pub use in_process::{InProcess, Message, StatePointer};

use core::ffi::{c_char, c_int, c_void};

use crate::call_table::Function;

/// Name of the one symbol that is not FMI's.
pub const DESCRIBE_SYMBOL: &str = "fmi_export_describe";

/// Every symbol that a library made by [`crate::export!`] exports.
pub fn symbols() -> impl Iterator<Item = &'static str> {
    Function::ALL.iter().map(|function| function.symbol()).chain([DESCRIBE_SYMBOL])
}

/// `fmi2CallbackLogger`.
pub type LoggerCallback =
    unsafe extern "C" fn(*mut c_void, *const c_char, c_int, *const c_char, *const c_char, ...);

/// `fmi2CallbackFunctions`; read once during `fmi2Instantiate`, by value.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
#[allow(missing_docs, reason = "the fields are the standard's own")]
pub struct CallbackFunctions {
    pub logger: Option<LoggerCallback>,
    pub allocate_memory: Option<unsafe extern "C" fn(usize, usize) -> *mut c_void>,
    pub free_memory: Option<unsafe extern "C" fn(*mut c_void)>,
    pub step_finished: Option<unsafe extern "C" fn(*mut c_void, c_int)>,
    pub component_environment: *mut c_void,
}

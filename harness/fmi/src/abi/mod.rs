//! The C interface of FMI 2.0, seen from the importer: the only unsafe code of the harness beside the program's calls of Win32.
//!
//! [`Binary`] is a loaded shared library with its functions bound to their types; [`Component`] is one instance
//! in it; [`SharedWords`] is memory shared with another process. All are safe to use from outside this folder: lengths are
//! checked, strings copied, and states freed before their instance.
#![allow(unsafe_code, reason = "this folder is the boundary to the FMU's C interface")]

mod binary;
mod component;
mod describe;
mod locale;
mod logger;
mod shared;
mod states;
mod text;

pub use binary::Binary;
pub use component::Callbacks;
pub(crate) use component::{Answer, Component, Start};
pub use describe::Described;
pub use locale::set_locale;
pub use shared::SharedWords;
pub(crate) use states::StateKey;

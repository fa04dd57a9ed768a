//! Clients of the exported C functions within one process, for the tests of every crate with a model.
#![allow(clippy::panic, reason = "tests fail by panics")]

mod in_process;
mod named;
mod names;

pub use in_process::{InProcess, Message, StatePointer};
pub use named::NamedInstance;
pub use names::Names;

/// How much a test does: the first in every run, the second in `cargo xtask test --long`, which sets the variable.
pub fn routine_or_long<T>(routine: T, long: T) -> T {
    if std::env::var_os("HELIOTORQUE_LONG").is_some() { long } else { routine }
}

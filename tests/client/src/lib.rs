//! Clients of the exported C functions within one process, for the tests of every crate with a model.
#![allow(clippy::panic, reason = "tests fail by panics")]

mod in_process;
mod named;
mod names;

pub use in_process::{InProcess, Message, StatePointer};
pub use named::NamedInstance;
pub use names::Names;

/// Selects the extent of a test: `long` in `cargo xtask test --long`, which sets the variable, else `short`.
pub fn short_or_long<T>(short: T, long: T) -> T {
    if std::env::var_os("HELIOTORQUE_LONG").is_some() { long } else { short }
}

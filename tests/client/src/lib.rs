//! Clients of the exported C functions within one process, for the tests of every crate with a model.
#![allow(clippy::panic, reason = "tests fail by panics")]

mod in_process;
mod named;
mod names;

pub use in_process::{InProcess, Message, StatePointer};
pub use named::NamedInstance;
pub use names::Names;

//! Clients of the exported C functions within one process, for the tests of every crate that has a model at hand.

mod in_process;

pub use in_process::{InProcess, Message, StatePointer};

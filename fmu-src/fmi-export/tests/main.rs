//! The export tooling seen from a model author's crate.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "tests")]
#![allow(clippy::disallowed_methods, reason = "what a test expects may come from the system's functions")]

mod derive;
mod interface;

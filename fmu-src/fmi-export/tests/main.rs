//! The export tooling seen from a model author's crate.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "tests")]

mod derive;
mod interface;

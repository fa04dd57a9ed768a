//! The probes by themselves, and their accidents behind the C functions.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "tests")]

mod accidents;
mod models;

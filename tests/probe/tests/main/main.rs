//! The probes by themselves, and their faults behind the C functions.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "tests")]

mod faults;
mod models;

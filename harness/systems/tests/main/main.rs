//! Systems as they are read, refused and wired; FMUs are descriptions without a library.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::disallowed_methods,
    reason = "tests"
)]

mod loops;
mod mapped;
mod refused;
mod support;
mod wired;

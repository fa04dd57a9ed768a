//! Tables of numbers: written from a recording with a sidecar, read, compared and drawn.
#![cfg_attr(test, allow(clippy::disallowed_methods, reason = "tests make their own files"))]
#![warn(clippy::print_stdout, clippy::print_stderr)]

pub mod compare;
pub mod output;
mod percentiles;
pub mod plot;
pub mod table;

pub use percentiles::percentiles;

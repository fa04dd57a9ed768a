//! Tests of the model description crate.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "tests")]

mod arbitrary;
mod corpus;
mod faults;
mod names;
mod reader;
mod rules;
mod samples;
mod validate;
mod writer;

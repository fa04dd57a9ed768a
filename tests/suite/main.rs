//! Conformance: what the exported functions promise, checked from outside through those functions.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "tests")]
#![allow(missing_docs, reason = "tests")]

mod allocations;
mod arithmetic;
mod bad_input;
mod blobs;
mod calls;
mod conformance;
mod foreign;
mod golden;
mod imports;
mod instances;
mod layout;
mod limits;
mod neutral;
mod plant;
mod prose;
mod public_names;
mod reference;
mod scenarios;
mod set_values;
mod shared_library;
mod sources;
mod states;
mod statics;
mod support;

#[global_allocator]
static ALLOCATOR: heliotorque_tests::counting::Counting = heliotorque_tests::counting::Counting;

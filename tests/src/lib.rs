//! Tools of the conformance suite (`suite/`), which drives the exported functions within one process.

pub mod counting;

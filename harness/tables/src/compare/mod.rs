//! Comparison of two tables, variable by variable.

pub mod pairing;
pub mod picture;
pub mod report;

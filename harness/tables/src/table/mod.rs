//! Tables of numbers, as `run` and campaigns write them, and what stands beside them.

pub mod described;
pub mod reading;
pub mod sidecar;

pub use described::Described;
pub use reading::{TIME, Table};
#[cfg(test)]
pub use sidecar::Quantity;
pub use sidecar::Sidecar;

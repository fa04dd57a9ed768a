//! Tables of numbers, as `run` and campaigns write them, and what stands beside them.

mod described;
mod reading;
mod sidecar;

pub(crate) use described::Described;
pub(crate) use reading::{TIME, Table};
#[cfg(test)]
pub(crate) use sidecar::Quantity;
pub(crate) use sidecar::Sidecar;

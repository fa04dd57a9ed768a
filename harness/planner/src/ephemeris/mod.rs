//! Ephemerides that spacecraft carry: Chebyshev fits and coarse elements of what a source places, SPICE kernels as one.

mod fit;
mod source;
#[cfg(feature = "spk")]
pub mod spk;

pub use fit::{Requested, coarse, precise};
pub use source::{Failure, Source, utc_date};

//! SPICE kernels as the source of an ephemeris: segments of SPK files, and the bodies they place.

mod chain;
mod coverage;
mod kernels;
mod naif;
mod spk_file;

pub use kernels::Kernels;
pub use naif::{Center, center, spacecraft};

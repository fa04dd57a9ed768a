//! SPICE kernels as the source of an ephemeris: segments of SPK files, and the bodies they place.

mod chain;
mod coverage;
mod naif;
mod options;
mod source;
mod spk_file;

pub use options::KernelOptions;
pub use source::Kernels;

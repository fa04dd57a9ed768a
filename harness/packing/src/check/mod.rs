//! Check of a spacecraft's file: whether it can be packed, its figures and its warnings.

mod figures;
mod spacecraft;

pub use spacecraft::{DEFAULT_SPACECRAFT, Judged, judged};

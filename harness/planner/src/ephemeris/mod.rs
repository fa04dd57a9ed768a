//! Ephemerides that spacecraft carry: Chebyshev fits and coarse elements of what a source places, SPICE kernels as one.

mod coarse;
mod fit;
mod flight;
mod onboard;
mod source;
pub mod spk;

pub use crate::Failure;
pub use fit::{Requested, coarse, precise};
pub use onboard::{EphemerisRequest, fit};
pub use physics::environment::onboard::OnboardTarget;
pub use source::Source;

//! Ephemerides that spacecraft carry: Chebyshev fits and coarse elements of what a source places, SPICE kernels as one.

mod coarse;
mod fit;
mod flight;
mod onboard;
mod request;
mod source;
pub mod spk;

pub use crate::Failure;
pub use fit::{coarse, precise};
pub use onboard::fit;
pub use physics::environment::onboard::OnboardTarget;
pub use request::EphemerisRequest;
pub use source::Source;

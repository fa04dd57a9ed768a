//! Air on surfaces in free molecular flow: force and torque of a drifting Maxwellian gas on every face.
//!
//! The air that arrives ([`AirFlow`]), the surface that meets it ([`crate::spacecraft::GasSurface`]) and the law that turns one
//! into force ([`AerodynamicLaw`]) are separate ideas. Everything is generic over [`crate::numerics::scalar::Scalar`], in the body
//! frame, SI. Molecules meet the spacecraft once: none that a face sends out meets another face.

mod flow;
mod law;
mod model;

#[cfg(test)]
mod tests;

pub use flow::AirFlow;
pub use law::{AerodynamicLaw, Reemission};
pub use model::{AerodynamicModel, AerodynamicOptions, AerodynamicWorkspace};

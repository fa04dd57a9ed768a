//! Aerodynamic force and torque in free molecular flow of a drifting Maxwellian gas, face by face.
//!
//! The flow ([`AirFlow`]), the surface ([`crate::spacecraft::GasSurface`]) and the law of the force ([`AerodynamicLaw`]) are
//! separate types. Everything is generic over [`crate::numerics::scalar::Scalar`], in the body
//! frame, SI. No multiple reflections: re-emitted molecules leave the spacecraft.

mod flow;
mod law;
mod model;

#[cfg(test)]
mod tests;

pub use flow::AirFlow;
pub use law::{AerodynamicLaw, Reemission};
pub use model::{AerodynamicModel, AerodynamicOptions, AerodynamicWorkspace, Walls};

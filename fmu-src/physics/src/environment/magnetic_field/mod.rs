//! A planet's magnetic field where a spacecraft is: of a dipole, or the Earth's reference field.
//!
//! Equation: B = (3 (m.u) u - m) / r^3 of a dipole, u and r from its place.
//! Reference: Wertz, Spacecraft Attitude Determination and Control, appendix H; [`igrf14`].

mod field;
mod igrf14;

#[cfg(test)]
mod tests;

pub use field::{MagneticField, MagneticFieldError, check_igrf14};

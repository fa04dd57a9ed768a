//! Spacecraft disturbance physics: what sunlight, planet light, heat, wheels and thrusters do to force, torque
//! and stored momentum. Knows nothing of FMI.
//!
//! A module uses only modules listed before it, and no file uses one that uses it. All quantities are SI, angles in
//! radians; frames and units stand in the identifiers.

#![forbid(unsafe_code)]
#![cfg_attr(
    test,
    allow(clippy::disallowed_methods, reason = "what a test expects may come from the system's functions")
)]

pub mod constants;
pub mod enumeration;
pub mod math;
pub mod refusal;

pub mod numerics;

pub mod bodies;

pub mod attitude;

pub mod toml;

pub mod spacecraft;

pub mod propulsion;

pub mod environment;

pub mod loads;

pub mod radiation;

pub mod aerodynamics;

pub mod guidance;

pub mod momentum;

pub mod plant;

pub mod management;

pub mod spin;

pub mod plausibility;

#[cfg(test)]
mod tests;

//! What a spacecraft's file comes to, for a person to judge: extents, areas, gyration, torque, and what cannot belong
//! together.

mod figures;
mod hull;
mod surfaces;
mod thrusters;
mod warnings;

#[cfg(test)]
mod tests;

pub use figures::Figures;
pub use hull::is_outside;
pub use thrusters::{ThrusterFigures, TorqueBothWays};
pub use warnings::{defaults_at_their_bounds, warnings};

//! Searches on orbits: Lambert's arcs between two positions, and partials of a path by earlier states.

mod lambert;
mod transition;

pub use lambert::{LambertArc, LambertError, LambertVelocities};
pub use transition::{Partials, partials_over, transition};

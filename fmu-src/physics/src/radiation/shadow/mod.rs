//! Self-shadowing: which part of each surface the Sun lights past the others, for any direction and angle of the panels.
//!
//! Every outline is a set of convex parts. A part of another surface that lies between a surface and the Sun is projected
//! along the light onto the surface's plane and cut out of what is still lit; what is left is a set of convex pieces,
//! whose area and centre follow. The cuts are plain arithmetic on vertices, so dual numbers carry exact derivatives
//! along: comparisons fix which vertices there are, the vertices themselves move.
//!
//! A general polygon library does the same on an integer grid, without derivatives and several times slower
//! (`examples/bench_radiation.rs` measures it); the tests use it as an independent judge.

mod clip;
mod convex;
mod scene;

#[cfg(test)]
mod tests;

pub use scene::{Hinge, Outline, ShadowScene, ShadowWorkspace};

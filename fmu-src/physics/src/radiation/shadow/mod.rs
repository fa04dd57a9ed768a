//! Self-shadowing: which part of each surface the Sun lights past the others, for any direction and angle of the panels.
//!
//! Equation: the lit part of a surface is its outline less the projections, along the light, of what stands before it; its
//! area and centroid are what the force needs.
//! Method: every outline is a set of convex parts. A part of another surface that lies between a surface and the Sun is
//! projected along the light onto the surface's plane and cut out of what is still lit, by half-planes; what is left is a
//! set of convex pieces, whose area and centre follow. The cuts are plain arithmetic on vertices, so dual numbers carry
//! exact derivatives along: comparisons fix which vertices there are, the vertices themselves move.
//! Order: exact for plane polygons under parallel light; [`SunDisc`] says how well a disc's mean is met.
//! Error measure: rounding of a vertex, relative to the outline's size; corners that rounding cannot resolve are dropped.
//! Reference: Sutherland and Hodgman, Reentrant polygon clipping, CACM 17, 1974 (the cut by a line); Ericson, Real-Time
//! Collision Detection, 5.2.1 (separating axes, which exclude pieces that do not meet).
//!
//! A general polygon library does the same on an integer grid, without derivatives and several times slower
//! (`examples/bench_radiation.rs` measures it); the tests use it as an independent judge.

mod clip;
mod convex;
mod disc;
mod scene;

#[cfg(test)]
mod disc_tests;
#[cfg(test)]
mod tests;

pub use disc::{DIRECTIONS, SunDisc};
pub use scene::{Hinge, Outline, ShadowScene, ShadowWorkspace};

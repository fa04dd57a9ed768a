//! The method by which orbits are integrated.

use crate::numerics::collocation::Collocation;

/// Nodes of a segment.
const NODES: usize = 8;
/// Coefficients of a segment's dense output.
pub const TERMS: usize = NODES + 1;

/// Integration method of a [`DisturbedOrbit`](super::DisturbedOrbit): computed once, shared, no state.
pub type OrbitMethod = Collocation<NODES, TERMS>;

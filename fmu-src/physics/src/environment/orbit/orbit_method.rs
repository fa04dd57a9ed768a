//! The method by which orbits are integrated.

use crate::numerics::collocation::Collocation;

/// Nodes of a segment.
const NODES: usize = 8;
/// Coefficients of a segment's dense output.
pub(super) const TERMS: usize = NODES + 1;

/// The integration method of a [`DisturbedOrbit`](super::DisturbedOrbit): computed once, shared, no state.
#[derive(Clone, Debug, Default)]
pub struct OrbitMethod(pub(super) Collocation<NODES, TERMS>);

//! Planet light on a plate by rings around nadir: a one-dimensional quadrature, the azimuth in closed form.
//!
//! Equation: received light is (1/c) int L (n.s) dOmega, and the same weighed with s, over the directions s in which the
//! plate sees the planet (paper 004 eqs 33-36, 39-41 in the limit of infinitely many planet cells); L is the exitance of
//! the surface there over pi.
//! Method: seen from the spacecraft, the points of the planet at one distance form a ring around nadir. A plate sees an
//! arc of it, the Sun lights another, and over the common arc the integrals of exitance times cosine times direction are
//! closed forms (`arcs`). What remains is one integral over the rings by Gauss-Legendre nodes (`rule`), split where an
//! arc is born (`segments`). The rings are counted by the logarithm of their distance t, from the altitude to the limb:
//! with cos(eta) = (t2 + L2) / (2 d t), L the limb's distance, the solid angle is (L2 - t2) / (2 d t) d(ln t) d(psi), so
//! that neither a low orbit nor the limb is steep. An arc is born as a square root; substituting x = a + (b - a) y2 there
//! makes the integrand smooth again.
//! Order: spectral; `n` nodes a segment integrate polynomials of degree 2 n - 1 in y, and the error falls by a constant
//! factor a node until the nearest remaining singularity (an earlier birth of an arc) is felt, before which the segment
//! is split.
//! Error measure: the difference to many nodes: 6 nodes give 1e-4, 16 nodes 1e-5 of the light
//! (`tests/suite/planet_nodes.rs` measures the force on a spacecraft).
//! Reference: Cunningham, NASA TN D-710, 1961 (closed view factor of a sphere, which the tests compare with); Davis and
//! Rabinowitz, Methods of Numerical Integration, 2.12 (square-root singularities at an end).

mod arcs;
mod rule;
mod segments;
mod sums;
mod view;

pub use rule::RingRule;
pub use view::PlanetView;

#[cfg(test)]
mod degenerate_tests;
#[cfg(test)]
mod tests;

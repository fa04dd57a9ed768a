//! Planet light on a plate by rings around nadir: a one-dimensional quadrature, the azimuth in closed form.
//!
//! Seen from the spacecraft, the points of the planet at one distance form a ring around nadir. A plate sees an
//! arc of it, the Sun lights another, and over the common arc the integrals of exitance times cosine times
//! direction are closed forms. What remains is one integral over the rings, split where an arc is born.
//!
//! The rings are counted by the logarithm of their distance t, from the altitude to the limb: with
//! cos(eta) = (t2 + L2) / (2 d t), L the limb's distance, the solid angle is (L2 - t2) / (2 d t) d(ln t) d(psi),
//! so that neither a low orbit nor the limb is steep. An arc is born as a square root; substituting
//! x = a + (b - a) y2 there makes the integrand smooth again.

mod arcs;
mod rule;
mod segments;
mod sums;
mod view;

pub use rule::{NodesError, RingRule};
pub use view::{PlanetView, ViewError};

#[cfg(test)]
mod degenerate_tests;
#[cfg(test)]
mod tests;

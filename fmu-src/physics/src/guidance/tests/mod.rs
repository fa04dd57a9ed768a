//! Motions, orbits and burns that the tests of guidance share.

pub(crate) mod burn;
pub(crate) mod geometry;
pub(crate) mod orbit;

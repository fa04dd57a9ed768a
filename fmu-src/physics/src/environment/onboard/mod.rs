//! Ephemerides as a spacecraft carries them (paper 001): Chebyshev segments made on the ground, and coarse polynomials of
//! Keplerian elements.
//!
//! One TOML file holds both ([`OnboardEphemeris::from_toml`]). The precise model of a body are its segments: polynomials of its
//! position about a centre, whose derivative is its velocity. The coarse model are polynomials of fourth degree of its
//! classical elements. Both carry the greatest error that was found where nothing was fitted.

mod coarse;
mod description;
mod ephemeris;
mod fit;
mod table;
mod target;
mod text;

#[cfg(test)]
mod tests;

pub use coarse::{COARSE_TERMS, CoarseElements, KeplerianElements};
#[cfg(feature = "schema")]
pub use description::schema;
pub use ephemeris::{FittedBody, OnboardEphemeris};
pub use fit::{FitError, FitPlan, GREATEST_DEGREE};
pub use table::{EphemerisSegment, SegmentTable};
pub use target::OnboardTarget;
pub use text::to_toml;

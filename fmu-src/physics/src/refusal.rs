//! Why a value is refused: what was found, and what is allowed.

use core::fmt::Display;

/// A value that cannot be.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{found}{}{allowed}", if allowed.is_empty() { "" } else { ", allowed: " })]
pub struct Refusal {
    /// What it is.
    pub found: String,
    /// What may stand in its place; empty where that is known.
    pub allowed: String,
}

impl Refusal {
    /// From both.
    pub fn new(found: impl Display, allowed: impl Display) -> Self {
        Self { found: found.to_string(), allowed: allowed.to_string() }
    }
}

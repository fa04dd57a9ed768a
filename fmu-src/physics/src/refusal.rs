//! Why a value is refused: what was found, and what is allowed.

use core::fmt::Display;

/// A value that cannot be.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{found}{}{allowed}", if allowed.is_empty() { "" } else { ", allowed: " })]
pub struct Refusal {
    /// Value that was found.
    pub found: String,
    /// Values that are allowed instead; empty where the reader knows them.
    pub allowed: String,
}

impl Refusal {
    /// From both.
    pub fn new(found: impl Display, allowed: impl Display) -> Self {
        Self { found: found.to_string(), allowed: allowed.to_string() }
    }
}

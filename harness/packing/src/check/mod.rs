//! Check of a spacecraft's file: whether it can be packed, its figures and its warnings.

mod figures;
mod spacecraft;

pub use spacecraft::{DEFAULT_SPACECRAFT, judged};

/// Verdict on a file.
#[derive(Debug)]
pub enum Judged {
    /// Taken, with warnings.
    Taken {
        /// Figures, as text.
        summary: String,
        /// Warnings, a sentence each.
        warnings: Vec<String>,
    },
    /// Refused as a file of a kind.
    Refused {
        /// Problems, a line each.
        problems: String,
        /// The kind.
        kind: String,
    },
}

//! Findings of a check.

use serde::{Deserialize, Serialize};

/// Verdict of a check.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub enum Verdict {
    /// As it should be.
    Good,
    /// Not applicable, or not possible on this computer.
    Skipped,
    /// Unusual, but the standard or its users accept it.
    Note,
    /// Wrong.
    Bad,
}

impl Verdict {
    /// All of them, from good to bad.
    pub const ALL: [Self; 4] = [Self::Good, Self::Skipped, Self::Note, Self::Bad];

    /// Word for it in a report.
    pub fn word(self) -> &'static str {
        match self {
            Self::Good => "passed",
            Self::Skipped => "skipped",
            Self::Note => "warning",
            Self::Bad => "failed",
        }
    }
}

/// One line of the report.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Finding {
    /// Good or bad.
    pub verdict: Verdict,
    /// Subject of the check, or the finding.
    pub text: String,
}

impl Finding {
    /// A finding.
    pub fn new(verdict: Verdict, text: impl Into<String>) -> Self {
        Self { verdict, text: text.into() }
    }

    /// As it should be.
    pub fn good(text: impl Into<String>) -> Self {
        Self::new(Verdict::Good, text)
    }

    /// Not applicable.
    pub fn skipped(text: impl Into<String>) -> Self {
        Self::new(Verdict::Skipped, text)
    }

    /// Odd.
    pub fn note(text: impl Into<String>) -> Self {
        Self::new(Verdict::Note, text)
    }

    /// Wrong.
    pub fn bad(text: impl Into<String>) -> Self {
        Self::new(Verdict::Bad, text)
    }
}

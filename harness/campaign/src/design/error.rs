//! Reasons why a campaign has no values.

/// Part of a campaign that a refusal is about.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum DesignPart {
    /// The number of runs.
    Runs,
    /// A variable that varies, by its name.
    Variable(String),
    /// The correlations.
    Correlations,
    /// Everything.
    Campaign,
}

/// Reason why there is no such design.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{what}")]
pub struct DesignError {
    /// Part of the campaign that it is about.
    pub part: DesignPart,
    what: String,
}

impl DesignError {
    /// Refusal of a part, with what was found and what is allowed.
    pub(super) fn new(part: DesignPart, what: impl Into<String>) -> Self {
        Self { part, what: what.into() }
    }
}

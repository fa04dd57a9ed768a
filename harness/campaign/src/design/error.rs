//! Why a campaign has no values.

use sobol_burley::NUM_DIMENSIONS;

/// Why there is no such design.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum DesignError {
    /// The number of runs.
    #[error("found {found} runs, allowed: {allowed}")]
    Runs {
        /// As they were given.
        found: u64,
        /// Numbers of runs that the sampling takes.
        allowed: String,
    },
    /// No variable varies, or a list has no value.
    #[error("found {found}, allowed: {allowed}")]
    Empty {
        /// List that is empty.
        found: String,
        /// Allowed content.
        allowed: &'static str,
    },
    /// A distribution that the sampling does not take.
    #[error("found {name} as {distribution} with sampling {sampling}, allowed: {allowed}")]
    Kind {
        /// The variable.
        name: String,
        /// Its distribution's key.
        distribution: &'static str,
        /// The sampling's key.
        sampling: &'static str,
        /// Values that it takes.
        allowed: &'static str,
    },
    /// A correlation that cannot be.
    #[error("{0}")]
    Correlation(String),
    /// More variables than the Sobol sequence has dimensions.
    #[error("found {found} variables with sampling sobol, allowed: up to {NUM_DIMENSIONS}")]
    Dimensions {
        /// How many there are.
        found: usize,
    },
}

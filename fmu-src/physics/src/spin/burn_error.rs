//! Errors at the start of a flight of the spinner: parameters out of their ranges, burns that cannot be simulated.

use super::train::TrainError;

/// A parameter out of its range.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{name} is {found}; {allowed}")]
pub struct ParameterError {
    /// FMI name.
    pub name: &'static str,
    /// Value that was found.
    pub found: String,
    /// Values that are allowed.
    pub allowed: String,
}

impl ParameterError {
    /// Returns the error of a parameter by its FMI name.
    pub fn new(name: &'static str, found: impl ToString, allowed: impl Into<String>) -> Self {
        Self { name, found: found.to_string(), allowed: allowed.into() }
    }
}

/// Reason why a burn is refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum BurnError {
    /// A parameter out of its range.
    #[error(transparent)]
    Parameter(#[from] ParameterError),
    /// A train that cannot be simulated.
    #[error("the burn cannot be simulated: {0}")]
    Train(#[from] TrainError),
    /// Limits that the plan breaks.
    #[error("the burn does not fit its limits: {what} would be {found}, the limit is {limit}")]
    Limit {
        /// Name of the quantity.
        what: &'static str,
        /// Value it would have.
        found: String,
        /// Limit.
        limit: String,
    },
}

//! Why there is no plan.

/// Why there is no plan.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PlanError {
    /// A flag out of range.
    #[error("{flag} is {found}; allowed is {allowed}")]
    Flag {
        /// Name of the flag.
        flag: &'static str,
        /// Its value.
        found: f64,
        /// The range.
        allowed: String,
    },
    /// A direction that cannot be.
    #[error("{flag}: {what}")]
    Direction {
        /// The flag it comes from, or that mends it.
        flag: &'static str,
        /// Fault, and what is allowed.
        what: String,
    },
    /// Limits that no plan keeps.
    #[error("{0}")]
    Infeasible(String),
    /// A spacecraft or thruster that no plan is for.
    #[error("{0}")]
    Refused(String),
    /// The plan could not be simulated on the plant.
    #[error("the plan could not be simulated pulse by pulse: {0}")]
    Flight(String),
    /// The plan could not be written.
    #[error("the plan could not be written: {0}")]
    Write(String),
    /// The plan could not be simulated through the FMU.
    #[error("the plan could not be simulated through the FMU: {0}")]
    Verify(String),
}

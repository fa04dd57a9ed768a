//! Why there is no refit.

/// Why something could not be done.
pub type Failure = Box<dyn std::error::Error>;

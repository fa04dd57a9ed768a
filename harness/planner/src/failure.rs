//! Why there is no result.

/// Why something could not be done.
pub type Failure = Box<dyn std::error::Error>;

//! Many runs of one FMU: which values each of them has, and what is kept of its time series.
//!
//! A run is a function of the campaign and its number alone, so that order, workers and interruptions change nothing.

mod design;
mod statistics;

pub use design::{Correlation, Design, DesignError, Distribution, MAX_RUNS, Sampling, Varied};
pub use statistics::{Extremes, PERCENTILES, percentiles};

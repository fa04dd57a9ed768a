//! One run of an FMU, a system or a mission ([`run`]), and many runs of one FMU ([`sweep`]): the values of each, and what is kept of
//! its time series.
//!
//! A run is a function of the campaign and its number alone, so that order, workers and interruptions change nothing.

mod design;
pub mod run;
mod statistics;
pub mod sweep;

pub use design::{Correlation, Design, DesignError, DesignPart, Distribution, MAX_RUNS, Sampling, Varied};
pub use statistics::{Extremes, PERCENTILES};

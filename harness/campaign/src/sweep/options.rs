//! Request of a sweep.

use std::path::PathBuf;

use std::ops::Range;

/// Table where none is named.
pub const OUTPUT: &str = "runs.csv";

/// Request of `heliotorque sweep`.
#[derive(Clone, Debug)]
pub struct Sweep {
    /// Campaign file.
    pub campaign: PathBuf,
    /// Range of runs; all where it is none.
    pub runs: Option<Range<u64>>,
    /// Number of processes.
    pub workers: Option<u16>,
    /// File or folder to write.
    pub output: PathBuf,
    /// Whether an interrupted sweep is continued.
    pub resume: bool,
    /// Whether kept runs are dropped.
    pub fresh: bool,
    /// Whether only the values of the runs are written.
    pub dry_run: bool,
    /// FMU whose library reads the files.
    pub template: Option<PathBuf>,
    /// Longest time of a call, in s.
    pub timeout: Option<f64>,
    /// Whether nothing is printed.
    pub quiet: bool,
}

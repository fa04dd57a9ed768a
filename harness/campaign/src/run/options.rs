//! Request of a run.

use std::path::PathBuf;

use inputs::values::Instant;
use systems::{FirstExchange, Master};

/// Endings of the files that a run writes: table, picture.
pub(super) const FORMATS: [&str; 2] = ["csv", "svg"];

/// Request of `heliotorque run`.
#[derive(Clone, Debug, Default)]
pub struct Run {
    /// FMU, system or mission.
    pub fmu: PathBuf,
    /// File that messages name in the place of a mission that was made from it.
    pub origin: Option<PathBuf>,
    /// Start time, in s.
    pub start: Option<f64>,
    /// Stop time or date.
    pub stop: Option<Instant>,
    /// Communication step, in s.
    pub step: Option<f64>,
    /// Start values, written `name=value`.
    pub set: Vec<String>,
    /// Order of exchange in a system.
    pub master: Option<Master>,
    /// Values of connected outputs in the first step of a system.
    pub first_exchange: Option<FirstExchange>,
    /// Table of inputs over time.
    pub input: Option<PathBuf>,
    /// Whether slopes of the inputs are handed to the FMU.
    pub slopes: bool,
    /// Variables to record; all outputs where empty.
    pub record: Vec<String>,
    /// Time between recorded rows, in s.
    pub every: Option<f64>,
    /// Table and picture to write, by their endings.
    pub output: Vec<PathBuf>,
    /// FMU whose library reads the files.
    pub template: Option<PathBuf>,
    /// Longest time of a call, in s.
    pub timeout: Option<f64>,
    /// Tolerance of the experiment; otherwise the FMU's.
    pub tolerance: Option<f64>,
    /// File of the calls.
    pub log_calls: Option<PathBuf>,
    /// Whether the log of the FMU is shown.
    pub log: bool,
    /// Whether nothing is printed.
    pub quiet: bool,
}

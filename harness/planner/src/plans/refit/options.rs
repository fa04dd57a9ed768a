//! Request of a refit.

use std::path::PathBuf;

use crate::refit::Deviations;

/// Request of `heliotorque refit`.
#[derive(Clone, Debug)]
pub struct Refit {
    /// Mission, or its recording.
    pub mission: PathBuf,
    /// History of momentum.
    pub telemetry: PathBuf,
    /// How sure history and mission are.
    pub deviations: Deviations,
    /// File or folder to write.
    pub output: PathBuf,
    /// FMU whose library reads the files.
    pub template: Option<PathBuf>,
    /// Whether nothing is printed.
    pub quiet: bool,
}

//! Request of a refit.

use std::path::PathBuf;

/// Request of `heliotorque refit`.
#[derive(Clone, Debug)]
pub struct Refit {
    /// Mission, or its recording.
    pub mission: PathBuf,
    /// History of momentum.
    pub telemetry: PathBuf,
    /// Standard deviation of each component of momentum, in N m s.
    pub noise: f64,
    /// Standard deviation of the centre of mass, in m.
    pub prior_center: f64,
    /// Standard deviation of `solar.scale`.
    pub prior_scale: f64,
    /// File or folder to write.
    pub output: PathBuf,
    /// FMU whose library reads the files.
    pub template: Option<PathBuf>,
    /// Whether nothing is printed.
    pub quiet: bool,
}

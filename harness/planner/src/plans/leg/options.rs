//! Request of a leg.

use std::path::PathBuf;

/// Request of `heliotorque plan`.
#[derive(Clone, Debug)]
pub struct LegOptions {
    /// Leg file.
    pub leg: PathBuf,
    /// File or folder to write.
    pub output: PathBuf,
    /// FMU whose library reads the files.
    pub template: Option<PathBuf>,
    /// Whether nothing is printed.
    pub quiet: bool,
}

//! Request of a momentum plan.

use std::path::PathBuf;

/// Request of `heliotorque plan`.
#[derive(Clone, Debug)]
pub struct MomentumOptions {
    /// Plan file.
    pub plan: PathBuf,
    /// File or folder to write.
    pub output: PathBuf,
    /// FMU whose library reads the files.
    pub template: Option<PathBuf>,
    /// Longest time of a search, in s.
    pub budget: f64,
    /// Number of flights with other seeds.
    pub seeds: u32,
    /// Whether nothing is printed.
    pub quiet: bool,
}

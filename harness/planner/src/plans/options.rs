//! Request of a plan by its file.

use std::path::PathBuf;

/// Request of `heliotorque plan FILE`.
#[derive(Clone, Debug)]
pub struct FilePlan {
    /// Plan or leg file.
    pub file: PathBuf,
    /// Folder to write.
    pub output: PathBuf,
    /// FMU whose library reads the files.
    pub template: Option<PathBuf>,
    /// Longest time of a search, in s.
    pub budget_s: f64,
    /// Number of flights with other seeds.
    pub seeds: u32,
    /// Whether nothing is printed.
    pub quiet: bool,
}

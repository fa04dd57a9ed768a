//! Options of a study, and why it did not finish.

use std::path::PathBuf;

use loader::Fmu;

/// Where a study finds its FMUs and leaves its files.
#[derive(Clone, Debug)]
pub struct Options {
    /// Folder with the `.fmu` files.
    pub dist: PathBuf,
    /// Folder for CSV files and pictures; created if missing.
    pub output: PathBuf,
    /// Runs only the cases whose label contains this text.
    pub only: Option<String>,
    /// Whether to show progress.
    pub progress: bool,
}

impl Options {
    /// Opens an FMU of the folder.
    pub(crate) fn fmu(&self, file: &str) -> Result<Fmu, StudyError> {
        Fmu::open(self.dist.join(file)).map_err(|error| StudyError::Fmu(Box::new(error)))
    }
}

/// Why a study did not finish.
#[derive(Debug, thiserror::Error)]
pub enum StudyError {
    /// No study of that name.
    #[error("there is no study `{found}`; the studies are {known}")]
    Unknown {
        /// What was requested.
        found: String,
        /// The names there are.
        known: String,
    },
    /// `only` left nothing.
    #[error("no case of {study} contains `{only}`; the cases are\n  {known}")]
    NothingLeft {
        /// The study.
        study: &'static str,
        /// The filter.
        only: String,
        /// The labels there are.
        known: String,
    },
    /// An FMU could not be loaded; the error names its file.
    #[error("{0}: see --dist")]
    Fmu(Box<loader::Error>),
    /// An FMU could not be simulated.
    #[error("{case}: {source}")]
    Simulation {
        /// Which case.
        case: String,
        /// Why.
        source: Box<dyn std::error::Error + Send + Sync>,
    },
    /// A result file could not be written.
    #[error("cannot write {0}")]
    Write(String),
}

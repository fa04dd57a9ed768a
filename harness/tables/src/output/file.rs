//! A file that a run writes, and what named it.

use std::path::{Path, PathBuf};

/// A file that a run writes.
#[derive(Clone, Debug)]
pub struct OutputFile {
    /// Path of the file.
    pub path: PathBuf,
    /// Option that named it.
    pub option: &'static str,
    /// The folder that it may not leave: that of the mission whose file names it.
    pub home: Option<PathBuf>,
}

impl OutputFile {
    /// Given on the command line.
    pub fn of_option(path: &Path, option: &'static str) -> Self {
        Self { path: path.to_owned(), option, home: None }
    }
}

//! Tables over time of single runs, in one folder.

use std::path::{Path, PathBuf};

use files::Destination;

/// Key of the folder of histories.
pub(super) const HISTORIES: &str = "keep.histories";

/// Folder of histories and its rules.
pub(super) struct HistoryPlace {
    pub(super) folder: PathBuf,
    pub(super) inputs: Vec<PathBuf>,
}

impl HistoryPlace {
    /// The table over time of a run.
    pub(super) fn destination(&self, run: u64) -> Result<Destination, String> {
        let inputs: Vec<&Path> = self.inputs.iter().map(PathBuf::as_path).collect();
        Destination::open(&self.folder.join(format!("run-{run}.csv")), HISTORIES, &inputs)
    }
}

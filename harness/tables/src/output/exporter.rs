//! Exporters of a recording, one for each output format of `heliotorque run`.

use std::{
    error::Error,
    path::{Path, PathBuf},
};

use fmi::Recording;
use model_description::Description;

/// An output of a run in one format.
pub(super) trait Exporter {
    /// Takes the recording so far; only rows are added between two calls.
    fn update(&mut self, _recording: &Recording) -> Result<(), String> {
        Ok(())
    }

    /// Whether nobody is there any more to read what it writes.
    fn has_lost_reader(&self) -> bool {
        false
    }

    /// The file that the complete recording would replace.
    fn existing(&self) -> Option<&Path> {
        None
    }

    /// Writes the complete recording and gives the file its name.
    fn finish(self: Box<Self>, described: &Description, recording: &Recording) -> Result<(), Box<dyn Error>>;

    /// After a simulation that failed: keeps the recording so far under the name of a file in progress, and gives that
    /// name if there is one. What cannot be kept is left out: the simulation's own error is the one to report.
    fn leave(self: Box<Self>, _described: &Description, _recording: &Recording) -> Option<PathBuf> {
        None
    }
}

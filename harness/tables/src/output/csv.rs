//! The CSV of `run --output`, which grows during the simulation, and beside it what it comes from.

use std::{
    error::Error,
    io,
    path::{Path, PathBuf},
};

use files::{Destination, Growing};
use fmi::{Recording, csv};
use model_description::Description;

use super::exporter::Exporter;

/// Rows that are written at once.
const ROWS_AT_ONCE: usize = 64;

/// A table that grows.
pub(super) struct Csv {
    file: Growing,
    /// How many of the recording's columns it has, the first ones.
    columns: usize,
    /// Rows in the file; `None` before the header.
    rows: Option<usize>,
    bytes: Vec<u8>,
    /// A file that is written once the table is complete, with its text.
    beside: Option<(Destination, String)>,
}

impl Csv {
    /// Writes the first `columns` into an empty file; what stands `beside` it follows.
    pub(super) fn new(file: Growing, columns: usize, beside: Option<(Destination, String)>) -> Self {
        Self { file, columns, rows: None, bytes: Vec::new(), beside }
    }
}

impl Exporter for Csv {
    fn update(&mut self, recording: &Recording) -> Result<(), String> {
        let rows = recording.times_s.len();
        let text = |error: io::Error| error.to_string();
        if self.rows.is_none() && rows > 0 {
            self.bytes.clear();
            csv::write_header(recording, self.columns, &mut self.bytes).map_err(text)?;
            self.file.append(&self.bytes)?;
            self.rows = Some(0);
        }
        while let Some(from) = self.rows.filter(|from| *from < rows) {
            let to = rows.min(from + ROWS_AT_ONCE);
            self.bytes.clear();
            csv::write_rows(recording, self.columns, from..to, &mut self.bytes).map_err(text)?;
            self.file.append(&self.bytes)?;
            self.rows = Some(to);
        }
        Ok(())
    }

    fn has_lost_reader(&self) -> bool {
        self.file.has_lost_reader()
    }

    fn existing(&self) -> Option<&Path> {
        self.file.existing()
    }

    fn finish(
        mut self: Box<Self>,
        _described: &Description,
        recording: &Recording,
    ) -> Result<(), Box<dyn Error>> {
        self.update(recording)?;
        self.file.finish()?;
        if let Some((file, text)) = self.beside {
            file.fill(|file| file.write_all(text.as_bytes()))?;
        }
        Ok(())
    }

    fn leave(mut self: Box<Self>, _described: &Description, recording: &Recording) -> Option<PathBuf> {
        let _ = self.update(recording);
        self.file.leave()
    }
}

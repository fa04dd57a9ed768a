//! What a study leaves: text for the terminal, and files.

use std::fs;
use std::path::{Path, PathBuf};

use comfy_table::{ContentArrangement, Table, presets};

use crate::chart::Chart;
use crate::{Options, StudyError};

/// The outcome of a study.
#[derive(Clone, Debug, Default)]
pub struct Report {
    /// Tables and remarks, ready to print.
    pub text: String,
    /// Files written, in order.
    pub files: Vec<PathBuf>,
}

impl Report {
    /// Adds a paragraph.
    pub(crate) fn line(&mut self, text: &str) {
        self.text.push_str(text);
        self.text.push('\n');
    }

    /// Adds a table.
    pub(crate) fn table(&mut self, header: &[&str], rows: &[Vec<String>]) {
        let mut table = Table::new();
        table.load_preset(presets::UTF8_FULL_CONDENSED).set_content_arrangement(ContentArrangement::Disabled);
        table.set_header(header);
        for row in rows {
            table.add_row(row);
        }
        self.line(&table.to_string());
    }

    /// Writes rows as CSV below the output folder.
    pub(crate) fn csv(
        &mut self,
        options: &Options,
        file: &str,
        header: &[&str],
        rows: impl IntoIterator<Item = Vec<String>>,
    ) -> Result<(), StudyError> {
        let path = self.prepare(options, file)?;
        let write = || -> Result<(), csv::Error> {
            let mut writer = csv::Writer::from_path(&path)?;
            writer.write_record(header)?;
            for row in rows {
                writer.write_record(row)?;
            }
            Ok(writer.flush()?)
        };
        write().map_err(|error| failed(&path, error))?;
        self.files.push(path);
        Ok(())
    }

    /// Writes a picture below the output folder.
    pub(crate) fn picture(&mut self, options: &Options, file: &str, chart: &Chart) -> Result<(), StudyError> {
        let path = self.prepare(options, file)?;
        chart.write(&path).map_err(|error| failed(&path, error))?;
        self.files.push(path);
        Ok(())
    }

    fn prepare(&self, options: &Options, file: &str) -> Result<PathBuf, StudyError> {
        fs::create_dir_all(&options.output).map_err(|error| failed(&options.output, error))?;
        Ok(options.output.join(file))
    }
}

fn failed(path: &Path, source: impl std::error::Error + Send + Sync + 'static) -> StudyError {
    StudyError::Write { path: path.to_owned(), source: Box::new(source) }
}

//! What a study leaves: text for the terminal, and files.

use std::fs;
use std::path::{Path, PathBuf};

use drawing::Picture;
use files::Destination;

use crate::{Options, StudyError};

fn columns(header: &str) -> Vec<&str> {
    header.split('|').map(str::trim).collect()
}

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

    /// Adds a table; `header` names its columns, with bars between them.
    pub(crate) fn table(&mut self, header: &str, rows: &[Vec<String>]) {
        let mut table = terminal::table(&columns(header));
        for row in rows {
            table.add_row(row);
        }
        self.line(&table.to_string());
    }

    /// Writes rows as CSV below the output folder, with a header as that of a table.
    pub(crate) fn csv(
        &mut self,
        options: &Options,
        file: &str,
        header: &str,
        rows: impl IntoIterator<Item = Vec<String>>,
    ) -> Result<(), StudyError> {
        let table = || -> Result<Vec<u8>, Box<dyn std::error::Error + Send + Sync>> {
            let mut writer = csv::Writer::from_writer(Vec::new());
            writer.write_record(columns(header))?;
            for row in rows {
                writer.write_record(row.iter().map(|cell| terminal::unsigned_zeros(cell).into_owned()))?;
            }
            Ok(writer.into_inner()?)
        };
        let bytes = table().map_err(|error| StudyError::Write(format!("{file}: {error}")))?;
        self.write(options, file, &bytes)
    }

    /// Writes a picture below the output folder.
    pub(crate) fn picture(
        &mut self,
        options: &Options,
        file: &str,
        chart: &dyn Picture,
    ) -> Result<(), StudyError> {
        let svg = drawing::svg(&[chart]);
        let svg = svg.map_err(|error| StudyError::Write(format!("{file}: {error}")))?;
        self.write(options, file, svg.as_bytes())
    }

    fn write(&mut self, options: &Options, file: &str, bytes: &[u8]) -> Result<(), StudyError> {
        let folder = &options.output;
        fs::create_dir_all(folder)
            .map_err(|error| StudyError::Write(format!("{}: {error}", folder.display())))?;
        let path = folder.join(file);
        // An FMU that is simulated is never written over.
        let fmus: Vec<PathBuf> = fs::read_dir(&options.dist)
            .map(|entries| {
                entries.flatten().map(|entry| entry.path()).filter(|path| path.is_file()).collect()
            })
            .unwrap_or_default();
        let fmus: Vec<&Path> = fmus.iter().map(PathBuf::as_path).collect();
        Destination::open(&path, "--output", &fmus)
            .and_then(|destination| destination.fill(|to| to.write_all(bytes)))
            .map_err(StudyError::Write)?;
        self.files.push(path);
        Ok(())
    }
}

//! A study under way: its cases, chosen by their labels and simulated on all cores, and what it leaves: text and files.

use std::fs;
use std::path::PathBuf;

use drawing::Picture;
use files::{Destination, OutputFolder};
use rayon::prelude::*;

use crate::options::Cause;
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

/// What a study ends with.
pub(crate) type Outcome = Result<(), StudyError>;

/// A study under way.
pub(crate) struct Run<'a> {
    /// Its name.
    pub study: &'static str,
    /// What it was called with.
    pub options: &'a Options,
    /// What it leaves so far.
    pub report: Report,
}

impl Run<'_> {
    /// Those of `cases` whose label the options name; an error if none.
    pub(crate) fn chosen<T>(
        &self,
        cases: impl IntoIterator<Item = T>,
        label: impl Fn(&T) -> String,
    ) -> Result<Vec<T>, StudyError> {
        let only = self.options.only.as_deref().unwrap_or_default();
        let (mut chosen, mut known) = (Vec::new(), Vec::new());
        for case in cases {
            known.push(label(&case));
            if known.last().is_some_and(|label| label.contains(only)) {
                chosen.push(case);
            }
        }
        if chosen.is_empty() {
            let only = only.to_owned();
            return Err(StudyError::NothingLeft { study: self.study, only, known: listed(&known) });
        }
        Ok(chosen)
    }

    /// Runs every case on all cores behind a progress bar; the order of results is that of the cases.
    pub(crate) fn all<T: Sync, R: Send>(
        &self,
        cases: &[T],
        run: impl Fn(&T) -> Result<R, StudyError> + Sync + Send,
    ) -> Result<Vec<R>, StudyError> {
        let bar = terminal::progress(cases.len() as u64, "cases", !self.options.progress);
        let results = cases.par_iter().map(run).inspect(|_| bar.inc(1)).collect();
        bar.finish_and_clear();
        results
    }

    /// Adds a paragraph.
    pub(crate) fn line(&mut self, text: &str) {
        self.report.text.push_str(text);
        self.report.text.push('\n');
    }

    /// Adds a table; `header` names its columns, with bars between them.
    pub(crate) fn table(&mut self, header: &str, rows: &[Vec<String>]) {
        let mut table = terminal::table(&columns(header));
        rows.iter().for_each(|row| table.add_row(row));
        self.line(&table.to_string());
    }

    /// Adds a table, and writes it as CSV below the output folder.
    pub(crate) fn table_and_csv(&mut self, file: &str, header: &str, rows: Vec<Vec<String>>) -> Outcome {
        self.table(header, &rows);
        self.csv(file, header, rows)
    }

    /// Writes rows as CSV below the output folder, with a header as that of a table.
    pub(crate) fn csv(
        &mut self,
        file: &str,
        header: &str,
        rows: impl IntoIterator<Item = Vec<String>>,
    ) -> Outcome {
        let table = || -> Result<Vec<u8>, Cause> {
            let mut writer = csv::Writer::from_writer(Vec::new());
            writer.write_record(columns(header))?;
            for row in rows {
                writer.write_record(row.iter().map(|cell| terminal::unsigned_zeros(cell).into_owned()))?;
            }
            Ok(writer.into_inner()?)
        };
        let bytes = table().map_err(|error| StudyError::Write(format!("{file}: {error}")))?;
        self.write(file, &bytes)
    }

    /// Writes a picture below the output folder.
    pub(crate) fn picture(&mut self, file: &str, chart: &dyn Picture) -> Outcome {
        let svg = drawing::svg(&[chart]);
        let svg = svg.map_err(|error| StudyError::Write(format!("{file}: {error}")))?;
        self.write(file, svg.as_bytes())
    }

    fn write(&mut self, file: &str, bytes: &[u8]) -> Outcome {
        let folder = &self.options.output;
        let _folder = OutputFolder::create(folder, "--output").map_err(StudyError::Write)?;
        let path = folder.join(file);
        // An FMU that is simulated is never written over.
        let entries = fs::read_dir(&self.options.dist).into_iter().flatten().flatten();
        let fmus: Vec<PathBuf> = entries.map(|entry| entry.path()).filter(|path| path.is_file()).collect();
        let fmus: Vec<_> = fmus.iter().map(PathBuf::as_path).collect();
        Destination::open(&path, "--output", &fmus)
            .and_then(|destination| destination.fill(|to| to.write_all(bytes)))
            .map_err(StudyError::Write)?;
        self.report.files.push(path);
        Ok(())
    }
}

/// Most labels that are listed one by one.
const MAX_LISTED: usize = 12;

/// The labels one below the other; of many the first and the last.
fn listed(labels: &[String]) -> String {
    if labels.len() <= MAX_LISTED {
        return labels.join("\n  ");
    }
    format!("{}, {}, ..., {} ({} of them)", labels[0], labels[1], labels[labels.len() - 1], labels.len())
}

#[cfg(test)]
mod tests {
    //! The error of a filter that leaves nothing lists the cases, in a few lines.
    use super::*;

    #[test]
    fn many_cases_are_not_listed_one_by_one() {
        assert_eq!(listed(&["a", "b"].map(str::to_owned)), "a\n  b");
        let labels: Vec<String> = (1..=120).map(|n| format!("n = {n}")).collect();
        assert_eq!(listed(&labels), "n = 1, n = 2, ..., n = 120 (120 of them)");
    }
}
